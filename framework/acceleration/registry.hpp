// All accelerators. Each registers itself with one line at the end of its source, also from a plug-in:
//
//   const RegisterAccelerator<AitkenOptions> registration("aitken");
#pragma once

#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "framework/acceleration/accelerator.hpp"
#include "framework/config/spec.hpp"

namespace sprekk {

/// What a scene says of one accelerator, once it has been read.
struct AcceleratorChoice {
  std::string name;
  std::function<bool()> is_chosen;
  std::function<std::unique_ptr<Accelerator>()> build;
};

/// The list of all accelerators, one for the program.
class AcceleratorRegistry {
 public:
  /// An accelerator by its key in a scene; `declare` adds the key to the spec of `accelerate:`.
  struct Type {
    std::string name;
    std::function<AcceleratorChoice(Spec& accelerate)> declare;
  };
  static AcceleratorRegistry& instance();
  void add(Type type);                                       ///< refuses a name that exists (refuse_registration)
  const std::vector<Type>& types() const { return types_; }  ///< sorted by name

 private:
  std::vector<Type> types_;
};

/// Registers an accelerator when it is constructed. Options is a struct with `Spec spec()`, whose targets are its own
/// members and whose text says what the accelerator does, and `std::unique_ptr<Accelerator> build() const`. Its
/// parameters are a section. An accelerator whose key is no section declares the key itself, by `void declare(Spec&,
/// const std::string& name)` and `bool is_chosen() const`.
template <class Options>
struct RegisterAccelerator {
  explicit RegisterAccelerator(const std::string& name) {
    AcceleratorRegistry::instance().add({name, [name](Spec& accelerate) -> AcceleratorChoice {
                                           auto options = std::make_shared<Options>();
                                           const auto build = [options] { return options->build(); };
                                           if constexpr (requires { options->declare(accelerate, name); }) {
                                             options->declare(accelerate, name);
                                             return {name, [options] { return options->is_chosen(); }, build};
                                           } else {
                                             auto is_given = std::make_shared<bool>(false);
                                             Spec spec = options->spec();
                                             const std::string doc = spec.doc();
                                             accelerate.section(name, std::move(spec), {.doc = doc}, is_given.get());
                                             return {name, [options, is_given] { return *is_given; }, build};
                                           }
                                         }});
  }
};

/// Parameters of `accelerate:`.
struct AccelerationOptions {
  std::vector<std::string> over;  ///< names of fields; all if there are none
  Origin over_origin;
  double largest_step = 0;  ///< over the change of the plain pass; 0 for any
  Spec spec();
  /// The accelerator that the scene chooses; nullptr for none.
  std::unique_ptr<Accelerator> build() const;

 private:
  std::vector<AcceleratorChoice> choices_;
};

}  // namespace sprekk
