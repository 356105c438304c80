// All types of components and couplers. Each registers itself with one line at the end of its source:
//
//   const RegisterComponent<Mine, MyOptions> registration("role/name");
#pragma once

#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "framework/config/spec.hpp"
#include "framework/scene/component.hpp"

namespace sprekk {

using ComponentBuilder = std::function<std::unique_ptr<Component>(const ComponentContext&)>;
using CouplerBuilder = std::function<std::unique_ptr<Coupler>(const CouplerContext&)>;

/// A registered type of component or coupler. It reads its parameters before there is a mesh, and builds the object
/// later.
template <class Builder>
struct PartType {
  std::string type;
  std::function<Spec()> spec;  ///< with its defaults, for `explain` and the schema
  std::function<Builder(const Node&, const ReadContext&)> read;
  /// For a type of coupler that a scene does not use: adds notes if the user may have forgotten it between these
  /// components.
  std::function<void(const std::vector<Component*>&, Notes&)> note_absence;
};
using ComponentType = PartType<ComponentBuilder>;
using CouplerType = PartType<CouplerBuilder>;

/// The list of all types of components and couplers, one for the program.
class Registry {
 public:
  static Registry& instance();
  void add(ComponentType type);  ///< refuses a type that exists (refuse_registration)
  void add(CouplerType type);
  const std::vector<ComponentType>& components() const { return components_; }  ///< sorted by type
  const std::vector<CouplerType>& couplers() const { return couplers_; }
  /// Throw InputError naming the nearest type.
  const ComponentType& component(const std::string& type, const Origin& where) const;
  const CouplerType& coupler(const std::string& type, const Origin& where) const;

 private:
  std::vector<ComponentType> components_;
  std::vector<CouplerType> couplers_;
};

/// Registers the type T when it is constructed. Options is a struct with `Spec spec()`, whose targets are its own
/// members; T is built from (context, options). A coupler may have a static `note_absence(components, notes)`.
template <class T, class Options, class Context, class Builder>
struct RegisterPart {
  explicit RegisterPart(const std::string& type) {
    PartType<Builder> part;
    part.type = type;
    part.spec = [] {
      static Options example;
      return example.spec();
    };
    part.read = [](const Node& node, const ReadContext& read) {
      auto options = std::make_shared<Options>();
      options->spec().read(node, read);
      return Builder([options](const Context& context) { return std::make_unique<T>(context, *options); });
    };
    if constexpr (requires { &T::note_absence; }) part.note_absence = &T::note_absence;
    Registry::instance().add(std::move(part));
  }
};
template <class T, class Options>
using RegisterComponent = RegisterPart<T, Options, ComponentContext, ComponentBuilder>;
template <class T, class Options>
using RegisterCoupler = RegisterPart<T, Options, CouplerContext, CouplerBuilder>;

}  // namespace sprekk
