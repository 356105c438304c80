// The derivatives that the rock and its couplers give, against differences of what they add to the equations; and what
// wall_traction takes for the compliance of the walls.
#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "components/capabilities/poroelastic_rock.hpp"
#include "framework/assembly/assembly.hpp"
#include "tests/verification/scene_run.hpp"

namespace sprekk::testing {
namespace {

// Two regions of another stiffness and initial stress, alpha that varies, two fractures one of which ends on a side,
// and a stiffness that is anisotropic in one of the scenes.
std::string scene(const std::string& rock, const std::string& mesh) {
  return "{geometry: {box: {x: [0 m, 1 m], y: [0 m, 1 m]}, fractures: {one: {points: [[0.2 m, 0.3 m], [0.7 m, 0.5 "
         "m]]}, "
         "two: {points: [[0 m, 0.7 m], [0.6 m, 0.8 m]]}}, regions: {low: {polygon: [[0 m, 0 m], [1 m, 0 m], [1 m, 0.25 "
         "m], [0 m, 0.15 m]]}}}, mesh: {" +
         mesh +
         "}, components: {pore: {type: matrix_flow/mpfa, permeability: 1e-14 m^2, viscosity: 1 mPa*s, porosity: 0.1, "
         "fluid_compressibility: 4e-10 1/Pa, boundary: {top: {pressure: 1 MPa}}}, rock: {type: poromechanics/mpsa, " +
         rock +
         ", initial_stress: {xx: {regions: {low: -3 MPa, rock: -1 MPa}}, yy: -2 MPa, xy: 0.3 MPa}, boundary: {bottom: "
         "{displacement: [0 m, 0 m]}, left: {displacement_x: 0 m}, top: {normal_stress: -3 MPa}}}, conduit: {type: "
         "fracture_flow/tpfa, viscosity: 1 mPa*s, fluid_compressibility: 4e-10 1/Pa, initial_aperture: 0.1 mm}, "
         "contact: "
         "{type: contact/coulomb, friction: 0.6}}, couplers: [{type: biot, between: [pore, rock], biot_coefficient: "
         "(0.5+0.4*x)}, {type: wall_exchange, between: [pore, conduit]}, {type: "
         "wall_traction, between: [rock, contact, conduit], fracture_biot_coefficient: 0.9}, {type: aperture, between: "
         "[contact, conduit]}], schedule: [{solve: [pore, rock, conduit, contact]}], time: {end: 1 h, step: 1 h}}";
}
const char* const isotropic = "young_modulus: {regions: {low: 30 GPa, rock: 10 GPa}}, poisson_ratio: 0.2";
const char* const anisotropic =
    "stiffness: {xxxx: 20 GPa, yyyy: 12 GPa, xyxy: 5 GPa, xxyy: 4 GPa, xxxy: 1 GPa, yyxy: -0.5 GPa}, bulk_modulus: 9 "
    "GPa";

Field& field_of(SceneRun& run, const std::string& name) {
  return const_cast<Field&>(static_cast<const Model&>(run.model()).fields().at(name));
}

const Part& part_of(const Model& model, const std::string& name) {
  for (const auto& component : model.components())
    if (component->name() == name) return *component;
  for (const auto& coupler : model.couplers())
    if (coupler->name() == name) return *coupler;
  throw std::logic_error("no part " + name);
}

/// The residuals of all rows, and the whole of the derivatives, of one part.
struct Terms {
  std::vector<Vector> residual;
  std::vector<std::vector<Eigen::MatrixXd>> derivative;
};
Terms terms_of(const Part& part, const std::vector<const Field*>& unknowns, const StepTime& step) {
  Assembly assembly(unknowns, Assembly::Request::residual_and_derivatives);
  part.assemble(assembly, step);
  Terms terms;
  const int count = static_cast<int>(unknowns.size());
  terms.derivative.resize(count);
  for (int r = 0; r < count; ++r) {
    terms.residual.push_back(assembly.residual(r));
    for (int c = 0; c < count; ++c)
      terms.derivative[r].push_back(Eigen::MatrixXd::Zero(unknowns[r]->size(), unknowns[c]->size()));
  }
  for (const Assembly::Block& block : assembly.blocks()) {
    Eigen::MatrixXd dense = block.factor * Eigen::MatrixXd(*block.matrix);
    if (block.weights) dense = block.weights->asDiagonal() * dense;
    terms.derivative[block.row][block.column] += dense;
  }
  return terms;
}

class RockJacobian : public ::testing::TestWithParam<const char*> {};

TEST_P(RockJacobian, IsThatOfTheResidual) {
  SceneRun run = SceneRun::from_text(scene(GetParam(), "size: 0.25 m, fracture_size: 0.12 m"));
  ASSERT_TRUE(run.step());
  const StepTime step{3600, 3600, 7200};
  for (Part* part : run.model().parts()) part->evaluate_data(step);
  for (Part* part : run.model().parts()) part->begin_step(step);
  const std::vector<std::string> names = {"rock.displacement", "rock.wall_traction", "contact.jump",
                                          "contact.traction",  "pore.pressure",      "conduit.pressure"};
  const std::vector<double> sizes = {1e-4, 1e6, 1e-4, 1e6, 1e6, 1e6};
  std::vector<const Field*> unknowns;
  for (const std::string& name : names) unknowns.push_back(&field_of(run, name));
  std::mt19937 random(5);
  std::uniform_real_distribution<double> any(-1, 1);
  int compared = 0;
  for (const char* name : {"rock", "biot", "wall_traction"}) {
    const Part* part = &part_of(run.model(), name);
    const Terms at = terms_of(*part, unknowns, step);
    for (std::size_t c = 0; c < names.size(); ++c) {
      Field& column = field_of(run, names[c]);
      const Vector state = column.now();
      // Every entry of a column enters with a weight of its own.
      for (int direction = 0; direction < 3; ++direction) {
        Vector change(state.size());
        for (double& value : change) value = sizes[c] * any(random);
        column.set(state + change);
        const Terms ahead = terms_of(*part, unknowns, step);
        column.set(state - change);
        const Terms behind = terms_of(*part, unknowns, step);
        column.set(state);
        for (std::size_t r = 0; r < names.size(); ++r) {
          if (at.residual[r].size() == 0) continue;
          const Vector differences = 0.5 * (ahead.residual[r] - behind.residual[r]);
          const Vector derived = at.derivative[r][c] * change;
          const double largest = std::max(derived.lpNorm<Eigen::Infinity>(), differences.lpNorm<Eigen::Infinity>());
          if (largest == 0) continue;
          ++compared;
          const double rounding = 1e-13 * at.residual[r].lpNorm<Eigen::Infinity>();
          EXPECT_LT((differences - derived).lpNorm<Eigen::Infinity>(), 1e-9 * largest + rounding)
              << name << ": row " << names[r] << ", column " << names[c];
        }
      }
    }
  }
  // rock: 3 columns in its own row; biot: 3 in that of the pressure; wall_traction: 3 and 4 in its two rows.
  EXPECT_EQ(compared, 3 * (3 + 3 + 3 + 4));
}

INSTANTIATE_TEST_SUITE_P(Rocks, RockJacobian, ::testing::Values(isotropic, anisotropic));

/// On the diagonal of the rows of wall tractions, by (normal, tangential) of each fracture cell, m/Pa.
struct Compliances {
  Vector used;    ///< by the coupler
  Vector own;     ///< how a unit traction of the cell alone closes its own jump, from the rock's expression
  Vector length;  ///< of the fracture cells, twice each, m
};
Compliances compliances(SceneRun& run) {
  const StepTime step{0, 3600, 3600};
  for (Part* part : run.model().parts()) part->evaluate_data(step);
  for (Part* part : run.model().parts()) part->begin_step(step);
  const Field& traction = field_of(run, "rock.wall_traction");
  Compliances found;
  found.used = terms_of(part_of(run.model(), "wall_traction"), {&traction}, step).derivative[0][0].diagonal();
  found.own.resize(traction.size());
  found.length.resize(traction.size());
  RockWalls* walls = nullptr;
  for (const auto& component : run.model().components())
    if (!walls) walls = dynamic_cast<RockWalls*>(component.get());
  for (int i = 0; i < traction.size(); ++i) {
    const Vector state = traction.now(), before = walls->displacement_jump().now();
    walls->wall_traction().set(state + 1e6 * Vector::Unit(state.size(), i));
    found.own[i] = -1e-6 * (walls->displacement_jump().now() - before)[i];
    walls->wall_traction().set(state);
    found.length[i] = run.mesh().fracture_cells[i / 2].measure;
  }
  return found;
}

TEST(WallCompliance, IsHowATractionClosesItsOwnJump) {
  SceneRun run = SceneRun::from_text(scene(isotropic, "size: 0.1 m"));
  const Compliances c = compliances(run);
  for (int i = 0; i < c.own.size(); ++i) {
    // A cell of the length L opens by about L/E under a unit of traction: E from 10 to 30 GPa.
    EXPECT_GT(c.own[i], 0.02 * c.length[i] / 10e9) << i;
    EXPECT_LT(c.own[i], 5 * c.length[i] / 10e9) << i;
    EXPECT_NEAR(c.used[i], c.own[i], 1e-6 * c.own[i]) << i;
  }
}

}  // namespace
}  // namespace sprekk::testing
