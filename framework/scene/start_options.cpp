#include "framework/scene/start_options.hpp"

namespace sprekk {

Spec StartOptions::spec() {
  Spec spec("start", "The state that the run begins with. Without this section all fields have their initial values.");
  spec.text(
      "from", from,
      {.doc = "Folder of the results of another run, or its checkpoint: the run begins with the state at its end, "
              "on the same mesh. Time, and what has been stored and flowed out, are counted anew. Relative to "
              "the working directory, as results/ is."});
  spec.texts("settle", settle,
             {.doc = "The components whose unknowns are put into equilibrium before the first step, with data as they "
                     "are at its start and everything else held. Changes are counted from there."});
  spec.check([this](const Node& node) {
    origin = node.origin;
    if (from && !settle.empty())
      throw InputError(node.origin, "'from' contradicts 'settle'",
                       "the state of the other run is in equilibrium, and goes on", "remove one of them");
    if (from && from->empty())
      throw InputError(node.origin, "'from' names no folder", "it is empty",
                       "give the folder of the other run's results");
  });
  return spec;
}

}  // namespace sprekk
