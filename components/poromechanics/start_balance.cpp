#include "components/poromechanics/start_balance.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "components/poromechanics/check_conditions.hpp"
#include "framework/mesh/geometry.hpp"
#include "framework/noticeable.hpp"

namespace sprekk::poromechanics {
namespace {

constexpr double mega = 1e6;

/// What acts on rock at a place and is balanced by nothing before the rock deforms.
struct Imbalance {
  double stress = 0;         ///< Pa
  Point at = Point::Zero();  ///< where it is largest
  std::string because;       ///< what does not fit what, with figures
};

/// The data at the start, with the initial stress and the weight times a sign each.
class Start {
 public:
  Start(const Options& options, const Mesh& mesh, double time, double stress_sign = 1, double weight_sign = 1)
      : options_(options), mesh_(mesh), step_{time, 0, time}, stress_sign_(stress_sign), weight_sign_(weight_sign) {}

  Imbalance largest() const {
    Imbalance worst;
    for (int f = 0; f < mesh_.face_count(); ++f) {
      if (mesh_.face_cells[f][1] != none)
        look_between_regions(f, worst);
      else if (mesh_.face_side[f] != none)
        look_at_side(f, worst);
    }
    look_inside(worst);
    return worst;
  }

  /// The largest of initial stresses and of what sides give, Pa.
  double largest_stress() const {
    double largest = 0;
    for (int f = 0; f < mesh_.face_count(); ++f) {
      largest = std::max(largest, stress_on(f, 0).norm());
      if (const SideCondition* condition = condition_of(options_, mesh_, f))
        largest = std::max(largest, condition->traction_in(step_, place_of(f, 0), mesh_.face_normal[f]).norm());
    }
    return largest;
  }

 private:
  Place place_of(int face, int side) const {
    return {mesh_.face_center[face], mesh_.cell_region[mesh_.face_cells[face][side]], step_.end};
  }
  Point stress_on(int face, int side) const {
    if (options_.initial_stress.is_zero()) return Point::Zero();
    return stress_sign_ * (options_.initial_stress.at(place_of(face, side)) * mesh_.face_normal[face]);
  }

  void look_between_regions(int face, Imbalance& worst) const {
    const auto [one, other] = mesh_.face_cells[face];
    if (mesh_.cell_region[one] == mesh_.cell_region[other]) return;
    const double stress = (stress_on(face, 1) - stress_on(face, 0)).norm();
    if (stress <= worst.stress) return;
    worst = {stress, mesh_.face_center[face],
             fmt::format("the initial stresses of regions '{}' and '{}' differ across their border",
                         mesh_.region_names[mesh_.cell_region[one]], mesh_.region_names[mesh_.cell_region[other]])};
  }

  void look_at_side(int face, Imbalance& worst) const {
    const SideCondition* condition = condition_of(options_, mesh_, face);
    const Point &normal = mesh_.face_normal[face], initial = stress_on(face, 0);
    Tensor axes = Tensor::Identity();
    Point given = Point::Zero();
    if (condition) {
      axes = axes_of(condition->axes(), normal);
      given = condition->traction_in(step_, place_of(face, 0), normal);
    }
    Point difference = axes.transpose() * (given - initial);
    for (int k = 0; k < dimension; ++k) {
      if (!condition || !condition->displacement_of(k)) continue;
      given -= difference[k] * axes.col(k);  // a side that is held bears what the rock presses
      difference[k] = 0;
    }
    if (difference.norm() <= worst.stress) return;
    // + 0.0: no -0 in the text. In space the stress along a side has a direction, too; the difference may be in it.
    const Tensor along = axes_of(ConditionAxes::of_face, normal);
    const auto normal_and_shear = [&](const Point& stress) {
      const Point of_face = along.transpose() * stress;
      return std::array{of_face[0], dimension == 2 ? of_face[1] : of_face.tail<dimension - 1>().norm()};
    };
    const auto of_rock = normal_and_shear(initial), of_side = normal_and_shear(given);
    worst = {
        difference.norm(), mesh_.face_center[face],
        fmt::format("on side '{}' the initial stress is {:.4g} MPa along its normal and {:.4g} MPa along the side, "
                    "and the side gives {:.4g} and {:.4g} MPa",
                    mesh_.side_names[mesh_.face_side[face]], of_rock[0] / mega + 0.0, of_rock[1] / mega + 0.0,
                    of_side[0] / mega + 0.0, of_side[1] / mega + 0.0)};
  }

  void look_inside(Imbalance& worst) const {
    Point lowest = Point::Constant(std::numeric_limits<double>::infinity()), highest = -lowest;
    for (const Point& node : mesh_.nodes) {
      lowest = lowest.cwiseMin(node);
      highest = highest.cwiseMax(node);
    }
    const Point extent = highest - lowest;
    for (int c = 0; c < mesh_.cell_count(); ++c) {
      const Point weight =
          weight_sign_ * options_.body_force_in(step_, {mesh_.cell_center[c], mesh_.cell_region[c], step_.end});
      Point force = weight;
      for (const int face : mesh_.cell_faces[c]) {
        const int side = mesh_.face_cells[face][0] == c ? 0 : 1;
        force += (side == 0 ? 1 : -1) * mesh_.face_measure[face] / mesh_.cell_measure[c] * stress_on(face, side);
      }
      const double size = force.norm(), stress = size > 0 ? force.cwiseAbs().dot(extent) : 0;
      if (stress <= worst.stress) continue;
      worst = {
          stress, mesh_.cell_center[c],
          fmt::format("the weight of the rock is {:.4g} N/m^3 there, of which its initial stress leaves {:.4g} N/m^3",
                      weight.norm(), size)};
    }
  }

  const Options& options_;
  const Mesh& mesh_;
  StepTime step_;
  double stress_sign_, weight_sign_;
};

}  // namespace

void note_start_imbalance(Notes& notes, const Options& options, const Mesh& mesh, const std::string& name,
                          double time) {
  const bool has_weight = !options.rock_density.is_zero() && !options.gravity.is_zero();
  if (options.initial_stress.is_zero() && !has_weight) return;
  const Start start(options, mesh, time);
  const Imbalance worst = start.largest();
  const double scale = start.largest_stress();
  if (worst.stress <= noticeable * scale) return;
  std::string remedy =
      "let 'start: settle' find the equilibrium, or give an initial_stress that balances weight and sides";
  const auto would_fit = [&](double stress_sign, double weight_sign) {
    return Start(options, mesh, time, stress_sign, weight_sign).largest().stress <= noticeable * scale;
  };
  if (!options.initial_stress.is_zero() && would_fit(-1, 1))
    remedy = "give initial_stress the other sign (compression is negative)";
  else if (options.has_body_force() && would_fit(1, -1))
    remedy = "let gravity act the other way";
  notes.add(name + " out of balance at the start",
            fmt::format("'{}' is out of balance at the start by {:.3g} MPa at {}: {} (the difference acts at once, in "
                        "the first step) {}",
                        name, worst.stress / mega, to_text(worst.at), worst.because, remedy),
            worst.stress);
}

}  // namespace sprekk::poromechanics
