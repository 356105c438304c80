// The types heat_advection and tracer_advection.
#include "couplers/advection/advection.hpp"

#include "components/capabilities/concentration.hpp"
#include "components/capabilities/temperature.hpp"

namespace sprekk::couplers {
namespace {

/// Adds notes on components that no such coupler joins. `Matrix`, `Fracture`: the capabilities of the carried quantity.
template <class Matrix, class Fracture>
void note_not_carried(const Carried& carried, const std::vector<Component*>& components, Notes& notes) {
  const std::string coupler = carried.quantity + "_advection";
  for (const Component* flow : components)
    for (const Component* other : components) {
      const bool in_rock = dynamic_cast<const MatrixFluxes*>(flow) && dynamic_cast<const Matrix*>(other);
      const bool in_fractures = dynamic_cast<const FractureFluxes*>(flow) && dynamic_cast<const Fracture*>(other);
      if (!in_rock && !in_fractures) continue;
      notes.add("no " + coupler + " between " + flow->name() + " and " + other->name(),
                "the fluid of " + flow->name() + " carries no " + carried.quantity + " of " + other->name() +
                    " (no coupler " + coupler +
                    " stands between them) add one, with both in `between`, unless that is meant");
    }
}

/// Flowing fluid carries heat.
class HeatAdvection : public Advection {
 public:
  HeatAdvection(const CouplerContext& context, const HeatAdvectionOptions& options)
      : Advection{context, carried_heat, options, context.find<MatrixTemperature>(),
                  context.find<FractureTemperature>()} {}
  static void note_absence(const std::vector<Component*>& components, Notes& notes) {
    note_not_carried<MatrixTemperature, FractureTemperature>(carried_heat, components, notes);
  }
};

/// Flowing fluid carries a tracer.
class TracerAdvection : public Advection {
 public:
  TracerAdvection(const CouplerContext& context, const TracerAdvectionOptions& options)
      : Advection{context, carried_tracer, options, context.find<MatrixConcentration>(),
                  context.find<FractureConcentration>()} {}
  static void note_absence(const std::vector<Component*>& components, Notes& notes) {
    note_not_carried<MatrixConcentration, FractureConcentration>(carried_tracer, components, notes);
    bool flows = false;
    for (const Component* each : components)
      flows = flows || dynamic_cast<const MatrixFluxes*>(each) || dynamic_cast<const FractureFluxes*>(each);
    for (const Component* each : components)
      if (!flows &&
          (dynamic_cast<const MatrixConcentration*>(each) || dynamic_cast<const FractureConcentration*>(each)))
        notes.add("nothing carries the tracer of " + each->name(),
                  "nothing carries the tracer of '" + each->name() +
                      "' (the scene has no flow) it diffuses alone; add a flow and a coupler tracer_advection, unless "
                      "that is meant");
  }
};

const RegisterCoupler<HeatAdvection, HeatAdvectionOptions> heat_registration("heat_advection");
const RegisterCoupler<TracerAdvection, TracerAdvectionOptions> tracer_registration("tracer_advection");

}  // namespace
}  // namespace sprekk::couplers
