#include "framework/acceleration/registry.hpp"

#include "framework/plugin/insert_by_name.hpp"

namespace sprekk {

AcceleratorRegistry& AcceleratorRegistry::instance() {
  static AcceleratorRegistry registry;
  return registry;
}

void AcceleratorRegistry::add(Type type) { insert_by_name(types_, std::move(type), &Type::name); }

Spec AccelerationOptions::spec() {
  Spec spec("accelerate", "Acceleration of the fixed-point iteration, by one of the accelerators.");
  choices_.clear();
  for (const AcceleratorRegistry::Type& type : AcceleratorRegistry::instance().types())
    choices_.push_back(type.declare(spec));
  spec.texts("over", over,
             {.doc = "The fields that are accelerated: all that the first solve of a pass takes from the pass before, "
                     "also its own where it is stabilized. By default all that are solved inside."});
  spec.quantity("largest_step", largest_step,
                {.range = non_negative(),
                 .doc = "Largest change that an accelerated pass makes, over that of the plain pass, both as norms; "
                        "longer ones are shortened. 0 for any."});
  spec.check([this](const Node& node) {
    if (const Node* given = node.find("over")) over_origin = given->origin;
    const AcceleratorChoice* first = nullptr;
    for (const AcceleratorChoice& choice : choices_) {
      if (!choice.is_chosen()) continue;
      if (first)
        throw InputError(node.find(choice.name)->origin,
                         quoted(choice.name) + " and " + quoted(first->name) + " accelerate one iteration",
                         "each would take the iterates of the other for its own", "remove one of them");
      first = &choice;
    }
    for (const char* option : {"over", "largest_step"})
      if (!first && node.find(option))
        throw InputError(node.find(option)->origin, quoted(option) + " has no effect", "no accelerator is chosen",
                         "add one, for example 'anderson: 5'");
  });
  return spec;
}

std::unique_ptr<Accelerator> AccelerationOptions::build() const {
  for (const AcceleratorChoice& choice : choices_)
    if (choice.is_chosen()) return choice.build();
  return nullptr;
}

}  // namespace sprekk
