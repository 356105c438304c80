// two_level: gives fronts of fractures the jumps of their walls.
#include <stdexcept>

#include "components/capabilities/fracture_fluid.hpp"
#include "components/capabilities/jumps_of_walls.hpp"
#include "components/capabilities/poroelastic_rock.hpp"
#include "couplers/contacts.hpp"
#include "framework/field/ownership.hpp"
#include "framework/scene/registry.hpp"

namespace sprekk::couplers {
namespace {

struct TwoLevelOptions {
  Spec spec() {
    Spec spec("two_level",
              "Between the rock and the fronts of fractures (fine_fracture/jump_fit): the jumps of the walls and the "
              "stiffness of the rock. As in a plane the contact and the fluid in the fractures may stand there, too; "
              "jumps are those of the rock.");
    spec.ignore("type").ignore("between");
    return spec;
  }
};

class TwoLevel : public Coupler, public JumpsOfWalls {
 public:
  TwoLevel(const CouplerContext& context, const TwoLevelOptions&)
      : Coupler(context.name), mesh_(context.mesh), rock_(context.the<RockState>()), walls_(context.the<RockWalls>()) {
    if (!rock_.stiffness(0))
      throw InputError(context.origin, "coupler " + name() + " cannot give the stiffness around fronts",
                       "stress intensity factors are those of an isotropic rock; this one is anisotropic",
                       "give the rock a young_modulus and a poisson_ratio, or remove the fronts");
    if (const auto* whole = dynamic_cast<const PoroelasticRock*>(&rock_); whole && whole->stiffness_follows_state())
      throw InputError(context.origin, "coupler " + name() + " cannot give the stiffness around fronts",
                       "the Young's modulus of the rock follows the state, and stress intensity factors are those of a "
                       "rock with one modulus",
                       "give a young_modulus that does not depend on the state, or remove the fronts");
    context.all<FractureContact>();
    context.find<FractureFluid>();
    context.the<FractureFronts>().accept_jumps(*this);
  }

  void begin_step(const StepTime&) override {}
  void assemble(Assembly&, const StepTime&) const override {}
  bool allows_stages() const override { return true; }

  void update() override {
    jump_ = walls_.displacement_jump().now();
    exchange(mesh_, Location::fracture_cell, dimension, jump_);
  }
  Point jump(int fracture_cell) const override {
    return mesh_.fracture_cells[fracture_cell].to_global(jump_.segment<dimension>(dimension * fracture_cell));
  }
  LameParameters stiffness(int cell) const override {
    const auto stiffness = rock_.stiffness(cell);
    if (!stiffness)
      throw std::runtime_error("stress intensity factors need an isotropic rock; it is anisotropic at a front");
    return *stiffness;
  }
  std::string flaw_of_jumps() const override { return walls_.flaw_of_jumps(); }

 private:
  const Mesh& mesh_;
  RockState& rock_;
  RockWalls& walls_;
  Vector jump_;
};

const RegisterCoupler<TwoLevel, TwoLevelOptions> registration("two_level");

}  // namespace
}  // namespace sprekk::couplers
