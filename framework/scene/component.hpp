// The base classes of components and couplers, and the input of their constructors.
#pragma once

#include <algorithm>
#include <memory>
#include <set>
#include <string>
#include <vector>

#include "framework/assembly/part.hpp"
#include "framework/config/input_error.hpp"
#include "framework/mesh/mesh.hpp"

namespace sprekk {

/// The input for building a component, besides its parameters, which have been read before.
struct ComponentContext {
  std::string name;  ///< in the scene
  const Mesh& mesh;
  FieldStore& fields;
  double start_time;  ///< s; initial values are evaluated here
  Origin origin;      ///< of the component in the scene
};

/// A part that owns unknown fields and the balance laws that determine them. It also derives from abstract classes, its
/// capabilities (components/capabilities), by which couplers use it.
class Component : public Part {
 public:
  explicit Component(std::string name) : name_(std::move(name)) {}
  const std::string& name() const { return name_; }

 private:
  std::string name_;
};

/// The input for building a coupler: the components that it couples, which it asks for by capability.
class CouplerContext {
 public:
  /// `between`: the components that the coupler stands between; `scene`: all components of the scene.
  CouplerContext(std::string name, const Mesh& mesh, FieldStore& fields, std::vector<Component*> between,
                 std::vector<Component*> scene, double start_time, Origin origin);

  const std::string name;  ///< its type; "type#2" for a second coupler of that type
  const Mesh& mesh;
  FieldStore& fields;
  const double start_time;  ///< s
  const Origin origin;

  /// The component with this capability, among those that the coupler stands between. Throws InputError when there is
  /// none, or when there are two.
  template <class Capability>
  Capability& the() const {
    auto* found = find<Capability>();
    if (!found) throw missing(Capability::promise);
    return *found;
  }
  /// The component with this capability, or nullptr when there is none.
  template <class Capability>
  Capability* find() const {
    Capability* found = nullptr;
    for (Component* component : between_)
      if (auto* capable = dynamic_cast<Capability*>(component)) {
        if (found && static_cast<const void*>(found) != static_cast<const void*>(capable))
          throw ambiguous(Capability::promise);
        found = capable;
        used_.insert(component);
      }
    return found;
  }
  /// All components with this capability that the coupler stands between, in their order.
  template <class Capability>
  std::vector<Capability*> all() const {
    std::vector<Capability*> found;
    for (Component* component : between_)
      if (auto* capable = dynamic_cast<Capability*>(component)) {
        found.push_back(capable);
        used_.insert(component);
      }
    return found;
  }
  /// The name of a component of the scene that has this capability and that the coupler does not stand between;
  /// empty where there is none. For notes of a coupler on components that it could use.
  template <class Capability>
  std::string left_out() const {
    for (Component* component : scene_)
      if (dynamic_cast<Capability*>(component) && !std::ranges::count(between_, component)) return component->name();
    return {};
  }
  /// Throws InputError if the coupler has not asked for one of the components.
  void check_all_used() const;
  /// Lets the coupler determine an input field; throws InputError if another coupler does.
  void determine(Field& input) const;

 private:
  InputError missing(const std::string& promise) const;
  InputError ambiguous(const std::string& promise) const;
  std::string between_text() const;

  std::vector<Component*> between_, scene_;
  mutable std::set<Component*> used_;
};

/// A part with the terms that couple components. It uses their capabilities only.
class Coupler : public Part {
 public:
  explicit Coupler(std::string name) : name_(std::move(name)) {}
  const std::string& name() const { return name_; }

 private:
  std::string name_;
};

}  // namespace sprekk
