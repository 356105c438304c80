// Goal: the first moments of Terzaghi's column, when the drained layer is thinner than a cell.
// Reference: the undrained pressure p0 = alpha q / (M_v S*) everywhere but at the drained end, and the solution after
// one backward-Euler step that is exact in space, p/p0 = 1 - cosh((H-y)/l) / cosh(H/l), l = sqrt(c dt). Limitation: on
// rectangles in a row the discrete response of the rock is local and no pressure exceeds p0. Triangles of one layer
// drain at different rates; the rock's response to that lateral difference reaches the next layer, as it does in exact
// elasticity under a free surface, and raises its pressure by less than a hundredth of what the drained cells lose.
#include <gtest/gtest.h>

#include <cmath>

#include "tests/components/poromechanics/biot_step.hpp"

namespace sprekk {
namespace {

using matrix_flow::FlowCondition;
using poromechanics::MechanicalCondition;

/// Table 1 of the paper, in GPa and with a mobility of 1.
struct Rock {
  double lambda = 11.111, shear = 16.667, alpha = 0.8, storage = 0.03955;
  double p_wave() const { return lambda + 2 * shear; }
  double effective_storage() const { return storage + alpha * alpha / p_wave(); }
  double diffusivity() const { return 1 / effective_storage(); }
  double undrained_pressure(double load) const { return alpha * load / (p_wave() * effective_storage()); }
};

test::BiotStep column(const Mesh& mesh, const Rock& rock, double load) {
  test::BiotStep step(mesh);
  step.alpha = rock.alpha;
  step.storage = rock.storage;
  step.stiffness.assign(mesh.cell_count(), poromechanics::isotropic_stiffness(rock.lambda, rock.shear));
  for (int f = 0; f < mesh.face_count(); ++f) {
    if (!test::is_outer(mesh, f)) continue;
    const std::string& side = mesh.side_names[mesh.face_side[f]];
    const bool is_lateral = side == "left" || side == "right";
    step.flow_conditions[f] = side == "top" ? FlowCondition::pressure : FlowCondition::flux;
    step.mechanical_conditions[f] = {
        is_lateral ? MechanicalCondition::displacement : MechanicalCondition::traction,
        side == "bottom" ? MechanicalCondition::displacement : MechanicalCondition::traction};
    if (side == "top") step.mechanical_boundary[2 * f + 1] = -load * mesh.face_measure[f];
  }
  return step;
}

TEST(TerzaghiStep, UndrainedPressureIsExact) {
  const Rock rock;
  for (const Mesh& mesh : {generate_mesh(test::box(0.2, 1), test::structured(6, 30, 0.3)),
                           generate_mesh(test::box(0.2, 1), test::rectangles(6, 30, 0.3)),
                           generate_mesh(test::box(0.2, 1), test::mixed(0.04)),
                           generate_mesh(test::box(0.2, 1), test::unstructured(0.04))}) {
    auto step = column(mesh, rock, 2);
    step.time_step = 0;
    const auto state = test::BiotSystem(step).solve(step);
    for (int c = 0; c < mesh.cell_count(); ++c) EXPECT_NEAR(state.pressure[c] / rock.undrained_pressure(2), 1, 1e-11);
  }
}

TEST(TerzaghiStep, SmallStepsRaiseThePressureByLessThanAHundredthOfTheLoss) {
  const Rock rock;
  const double h = 1.0 / 30;
  for (const Mesh& mesh : {generate_mesh(test::box(0.2, 1), test::structured(6, 30)),
                           generate_mesh(test::box(0.2, 1), test::structured(6, 30, 0.2)),
                           generate_mesh(test::box(0.2, 1), test::unstructured(h))})
    for (const double number : {1e-6, 1e-4, 1e-2, 1e-1, 1.0}) {
      auto step = column(mesh, rock, 1);
      step.time_step = number * h * h / rock.diffusivity();
      const Vector p = test::BiotSystem(step).solve(step).pressure / rock.undrained_pressure(1);
      EXPECT_LT(p.maxCoeff() - 1, 0.01 * (1 - p.minCoeff())) << "c dt / h^2 = " << number;
      EXPECT_GT(p.minCoeff(), 0);
    }
}

TEST(TerzaghiStep, RectanglesHaveNoOvershoot) {
  const Rock rock;
  const int rows = 40;
  std::vector<double> even, graded, stretched;
  for (int j = 0; j <= rows; ++j) {
    const double y = static_cast<double>(j) / rows;
    even.push_back(y);
    graded.push_back(y * (0.3 + 0.7 * y));                 // finest at the closed end
    stretched.push_back(j % 2 == 0 ? y : y - 0.4 / rows);  // layers of 0.6 and 1.4 in turn
  }
  const std::vector<double> one{0, 0.025}, several{0, 0.02, 0.025, 0.1, 0.11};
  for (const auto& x : {one, several})
    for (const auto& y : {even, graded, stretched}) {
      const Mesh mesh = test::grid_of(x, y);
      const double h = 1.0 / rows;
      for (const double number : {1e-6, 1e-5, 1e-4, 1e-3, 1e-2, 1e-1, 1.0}) {
        auto step = column(mesh, rock, 1);
        step.time_step = number * h * h / rock.diffusivity();
        const Vector p = test::BiotSystem(step).solve(step).pressure / rock.undrained_pressure(1);
        EXPECT_LT(p.maxCoeff() - 1, 1e-10) << "c dt / h^2 = " << number;
        EXPECT_GT(p.minCoeff(), 0) << "c dt / h^2 = " << number;
      }
    }
}

TEST(TerzaghiStep, FlowAloneHasNoOvershoot) {
  Rock rock;
  rock.storage = rock.effective_storage();
  rock.alpha = 0;
  const double h = 1.0 / 30;
  for (const Mesh& mesh : {generate_mesh(test::box(0.2, 1), test::structured(6, 30)),
                           generate_mesh(test::box(0.2, 1), test::unstructured(h))})
    for (const double number : {1e-6, 1e-4, 1e-2, 1e-1, 1.0}) {
      auto step = column(mesh, rock, 1);
      step.time_step = number * h * h / rock.diffusivity();
      for (int c = 0; c < mesh.cell_count(); ++c) step.old_fluid[c] = rock.storage * mesh.cell_measure[c];
      EXPECT_LT(test::BiotSystem(step).solve(step).pressure.maxCoeff() - 1, 1e-12);
    }
}

TEST(TerzaghiStep, ConvergesToTheSolutionThatIsExactInSpace) {
  const Rock rock;
  const double length = 0.1;  // of the drained layer
  std::vector<double> errors;
  for (const int rows : {20, 40, 80}) {
    const Mesh mesh = generate_mesh(test::box(0.1, 1), test::structured(rows / 10, rows));
    auto step = column(mesh, rock, 1);
    step.time_step = length * length / rock.diffusivity();
    const Vector p = test::BiotSystem(step).solve(step).pressure / rock.undrained_pressure(1);
    double error = 0, norm = 0;
    for (int c = 0; c < mesh.cell_count(); ++c) {
      const double exact = 1 - std::cosh(mesh.cell_center[c][1] / length) / std::cosh(1 / length);
      error += mesh.cell_measure[c] * std::pow(p[c] - exact, 2);
      norm += mesh.cell_measure[c] * exact * exact;
    }
    errors.push_back(std::sqrt(error / norm));
  }
  EXPECT_LT(errors.back(), 1e-3);
  EXPECT_GT(std::log2(errors[0] / errors[1]), 1.9);
  EXPECT_GT(std::log2(errors[1] / errors[2]), 1.9);
}

}  // namespace
}  // namespace sprekk
