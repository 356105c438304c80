#include "components/matrix_flow/start_balance.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>

#include "components/capabilities/fluid_at_start.hpp"
#include "framework/mesh/geometry.hpp"
#include "framework/noticeable.hpp"
#include "framework/parallel/parallel.hpp"
#include "framework/round_off.hpp"

namespace sprekk::matrix_flow {
namespace {

/// A cell whose pressure does not fit the weight of its fluid.
struct Misfit {
  double size = 0;                ///< Pa/m
  double growth = 0, weight = 0;  ///< of the pressure along gravity, Pa/m, and of the fluid, N/m^3
  double flow = 0;                ///< that it drives along gravity, m/s
  Point at = Point::Zero(), g = Point::Zero();
};

class Start {
 public:
  explicit Start(const FluidAtStart& start) : of_(start) {}

  Misfit in_cell(int c) const {
    const Point g = gravity(c);
    Misfit misfit{.at = of_.mesh.cell_center[c], .g = g};
    if (g.norm() == 0) return misfit;
    const Point down = g / g.norm();
    misfit.growth = gradient(c).dot(down);
    misfit.weight = of_.density[c] * g.norm();
    if (std::abs(misfit.growth) < rounding::same * misfit.weight) misfit.growth = 0;
    misfit.size = std::abs(misfit.growth - misfit.weight);
    misfit.flow = misfit.size * down.dot(of_.mobility[c] * down);
    return misfit;
  }

  /// Whether some outer face lets through something else than what flows inside of its cell, in parts of the weight.
  bool is_disturbed_by_sides() const {
    const Mesh& mesh = of_.mesh;
    for (int f = 0; f < mesh.face_count(); ++f) {
      const int c = mesh.face_cells[f][0];
      if (mesh.face_side[f] == none || !is_inhabited(c)) continue;
      const Point& normal = mesh.face_normal[f];
      const double weight = of_.density[c] * gravity(c).norm();
      const Point driven = of_.density[c] * gravity(c) - gradient(c);
      const auto found = of_.options.boundary.find(mesh.side_names[mesh.face_side[f]]);
      const SideCondition* side = found == of_.options.boundary.end() ? nullptr : &found->second;
      const Place place = place_of(f, c);
      const double initial = of_.options.initial_pressure.at(place);
      const auto differs = [&](double pressure) {
        const double reach = (mesh.face_center[f] - mesh.cell_center[c]).norm();
        return std::abs(pressure - initial) > noticeable * weight * reach;
      };
      if (side && side->pressure) {
        if (differs(side->pressure->at(place))) return true;
        continue;
      }
      if (side && side->is_leaky()) {
        const double outside = side->outer_pressure->at(place);
        if (differs(outside) && !(side->only_out && outside > initial)) return true;
        continue;
      }
      const double conducts = normal.dot(of_.mobility[c] * normal),
                   given = side && side->flux ? side->flux->at(place) : 0;
      const double flow = normal.dot(of_.mobility[c] * driven);
      if (std::abs(flow - given) > noticeable * conducts * weight) return true;
    }
    return false;
  }

  bool is_inhabited(int c) const { return of_.inhabited.empty() || of_.inhabited[c]; }

 private:
  Point gravity(int c) const {
    return of_.options.gravity.at({of_.mesh.cell_center[c], of_.mesh.cell_region[c], of_.time});
  }
  Place place_of(int face, int cell) const {
    return {of_.mesh.face_center[face], of_.mesh.cell_region[cell], of_.time};
  }
  /// Of the initial pressure, by the divergence theorem: exact for linear ones.
  Point gradient(int c) const {
    Point sum = Point::Zero();
    if (!of_.options.initial_pressure.depends_on_space()) return sum;
    for (const int f : of_.mesh.cell_faces[c]) {
      const double sign = of_.mesh.face_cells[f][0] == c ? 1 : -1;
      const double pressure = of_.options.initial_pressure.at(place_of(f, c));
      sum += sign * pressure * of_.mesh.face_measure[f] / of_.mesh.cell_measure[c] * of_.mesh.face_normal[f];
    }
    return sum;
  }

  const FluidAtStart& of_;
};

/// "(P + 9810*(100 - y)) Pa": the pressure of fluid at rest under gravity along an axis, or "" along no axis.
std::string at_rest(const FluidAtStart& start, const Misfit& worst) {
  for (int axis = 0; axis < dimension; ++axis) {
    if (std::abs(worst.g[axis]) < (1 - rounding::same) * worst.g.norm()) continue;
    const bool is_down_negative = worst.g[axis] < 0;
    double top = is_down_negative ? -std::numeric_limits<double>::infinity() : std::numeric_limits<double>::infinity();
    for (const Point& node : start.mesh.nodes)
      top = is_down_negative ? std::max(top, node[axis]) : std::min(top, node[axis]);
    const char name = "xyz"[axis];
    std::string depth = fmt::format("({:.6g} - {})", top, name);
    if (!is_down_negative) depth = top == 0 ? std::string(1, name) : fmt::format("({} - {:.6g})", name, top);
    return fmt::format("({:.6g}*{}) Pa", worst.weight, depth);
  }
  return "";
}

}  // namespace

void note_start_imbalance(Notes& notes, const FluidAtStart& start, const std::string& name) {
  if (start.options.gravity.is_zero() || start.density.size() == 0) return;
  const Start of(start);
  Misfit worst;
  double flow = 0;
  bool grows = true, has_other_sign = true;
  const double small = start.density_varies ? part_that_may_vary : noticeable;
  for (int c = 0; c < start.mesh.cell_count(); ++c) {
    if (!of.is_inhabited(c)) continue;
    const Misfit misfit = of.in_cell(c);
    if (misfit.weight == 0) continue;
    flow = std::max(flow, misfit.flow);
    grows = grows && misfit.growth > rounding::same * misfit.weight;
    has_other_sign = has_other_sign && std::abs(misfit.growth + misfit.weight) <= small * misfit.weight;
    if (misfit.size > worst.size) worst = misfit;
  }
  const bool is_noted = worst.size > small * worst.weight && flow > 0 && !(grows && !of.is_disturbed_by_sides());
  if (!parallel::any(is_noted) || !is_noted) return;
  std::string remedy = "let 'start: settle' find the equilibrium";
  if (has_other_sign)
    remedy = "let gravity or the pressure act the other way";
  else if (const std::string rest = at_rest(start, worst); !rest.empty() && !start.density_varies)
    remedy += fmt::format(", or give one, such as 'initial_pressure: \"{}\"'", rest);
  notes.add(name + " out of balance at the start",
            fmt::format("the fluid of '{}' is out of balance at the start by {:.3g} Pa/m at {}: along gravity its "
                        "initial_pressure grows by {:.4g} Pa/m, and it weighs {:.4g} N/m^3 (it flows at once, by up to "
                        "{:.2g} m/s, although nothing is injected) {}",
                        name, worst.size, to_text(worst.at), worst.growth, worst.weight, flow, remedy),
            worst.size);
}

}  // namespace sprekk::matrix_flow
