// __type__: how friction changes. A start for a law of your own: here friction that is lost over a path, without end.
#include <cmath>
#include <memory>

#include "components/contact/laws/friction.hpp"

namespace __name__ {

using namespace sprekk;

/// residual + (friction − residual) exp(−path/distance), with the `friction` of the scene.
class __Class__ : public contact::FrictionLaw {
 public:
  __Class__(double residual, double distance) : residual_(residual), distance_(distance) {}
  // The state also has slip_of_walls, slip_rate_of_walls and pressure_of_walls.
  contact::OfWalls at(double friction, const contact::WallState& state) const override {
    const double left = (friction - residual_) * std::exp(-state[contact::path_of_walls] / distance_);
    contact::OfWalls coefficient{residual_ + left};
    coefficient.by[contact::path_of_walls] = -left / distance_;
    return coefficient;
  }
  bool depends_on(contact::WallVariable variable) const override { return variable == contact::path_of_walls; }

 private:
  double residual_, distance_;
};

/// The parameters: what a scene writes under `friction_law: {type: __type__, __type__: {…}}`.
struct Options {
  double residual = 0, distance = 0;
  Spec spec() {
    Spec spec("__type__", "residual + (friction - residual) exp(-path/distance)");
    spec.quantity("residual", residual,
                  {.range = non_negative(), .doc = "Friction after a long path.", .required = true});
    spec.quantity("distance", distance,
                  {.unit = "m", .range = positive(), .doc = "Path over which friction is lost.", .required = true});
    return spec;
  }
  std::unique_ptr<contact::FrictionLaw> build(const contact::NoInput&) const {
    return std::make_unique<__Class__>(residual, distance);
  }
};

const RegisterLaw<Options, contact::FrictionLaw, contact::NoInput> registration(contact::friction_laws(), "__type__");

}  // namespace __name__
