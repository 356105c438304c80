// heat_exchange: heat is conducted between a fracture and the matrix through its walls.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "components/capabilities/temperature.hpp"
#include "framework/assembly/property.hpp"
#include "framework/field/ownership.hpp"
#include "framework/invariants.hpp"
#include "framework/mesh/geometry.hpp"
#include "framework/mesh/ridge_distance.hpp"
#include "framework/scene/registry.hpp"

namespace sprekk::couplers {
namespace {

constexpr double noticeable_part_along = 1e-2;  // of what the rock beside a fracture conducts along it

struct HeatExchangeOptions {
  std::optional<Data> conductance;
  Spec spec() {
    Spec spec("heat_exchange",
              "Heat conducted between fractures and matrix through the walls, driven by the difference of their "
              "temperatures.");
    spec.ignore("type").ignore("between");
    spec.data("conductance", conductance,
              {.unit = "W/(m^2*K)",
               .range = non_negative(),
               .doc = "Conductance of each wall, per length (in space, area) of the fracture; without it, twice the "
                      "conductivity over "
                      "the aperture of "
                      "the fracture.",
               .fixed = "the walls conduct as at the start"});
    return spec;
  }
};

/// Determines the conducted flux q of every wall, from the fracture into the matrix: q = h (T_i − tr T). Its row is
/// divided by h plus the conductance of the matrix in front of the wall, and so well scaled for all walls.
class HeatExchange : public Coupler {
 public:
  HeatExchange(const CouplerContext& context, const HeatExchangeOptions& options)
      : Coupler(context.name),
        mesh_(context.mesh),
        matrix_(context.the<MatrixTemperature>()),
        walls_(context.the<HeatWalls>()),
        fracture_(context.the<FractureTemperature>()),
        conductance_(fracture_.wall_conductance()) {
    context.determine(walls_.wall_heat_flux());
    std::vector<Triplet> picks, lengths;
    const std::vector<Place> places = fracture_cell_places(mesh_);
    for (int w = 0; w < mesh_.wall_count(); ++w) {
      picks.emplace_back(w, w / 2, 1.0);
      lengths.emplace_back(w / 2, w, mesh_.fracture_cells[w / 2].measure);
      if (options.conductance) conductance_[w] = options.conductance->at(places[w / 2]);
    }
    to_walls_.resize(mesh_.wall_count(), mesh_.fracture_cell_count());
    to_walls_.setFromTriplets(picks.begin(), picks.end());
    SparseMatrix outflow(mesh_.fracture_cell_count(), mesh_.wall_count());
    outflow.setFromTriplets(lengths.begin(), lengths.end());
    outflow_ = Operator(std::move(outflow));
  }

  /// Heat that passes the walls in a step is that of one flux, for both sides.
  std::vector<Dependence> dependences() const override {
    const std::string matrix = matrix_.temperature().spec().owner, fracture = fracture_.temperature().spec().owner;
    const std::string because = "heat that leaves the one through the walls enters the other in the same step";
    return {{matrix, fracture, because}, {fracture, matrix, because}};
  }

  void begin_step(const StepTime&) override {
    const Field& flux = walls_.wall_heat_flux();
    Vector in_front = Vector::Ones(mesh_.wall_count());
    for (const LinearExpression::Term& term : walls_.wall_temperature().terms)
      if (term.field == &flux)
        for (int w = 0; w < mesh_.wall_count(); ++w) {
          const double resistance = term.matrix.entries().coeff(w, w);
          if (resistance > 0) in_front[w] = 1 / resistance;
        }
    exchange(mesh_, Location::wall, 1, in_front);
    find_conduction_along(in_front);
    const Vector scale = (conductance_ + in_front).cwiseInverse();
    of_flux_ = scale;
    of_temperature_ = scale.cwiseProduct(conductance_);
    SPREKK_ASSERT(is_finite(of_temperature_) && scale.minCoeff() > 0, scale.minCoeff());
  }

  void assemble(Assembly& assembly, const StepTime& step) const override {
    const Field &flux = walls_.wall_heat_flux(), &temperature = fracture_.temperature();
    if (assembly.has_row(temperature)) assembly.linear(temperature, outflow_, flux, step.dt);
    if (!assembly.has_row(flux)) return;
    const LinearExpression& trace = walls_.wall_temperature();
    assembly.add(flux, of_flux_.cwiseProduct(flux.now()));
    assembly.add(flux, of_temperature_.cwiseProduct(trace.now()));
    assembly.add(flux, -of_temperature_.cwiseProduct(to_walls_ * temperature.now()));
    // Where no wall conducts, fluxes are zero, up to round-off relative to what the rock at the walls would conduct.
    if (of_temperature_.isZero(0))
      assembly.compare_round_off(flux, std::max(matrix_.temperature().now().lpNorm<Eigen::Infinity>(),
                                                temperature.now().lpNorm<Eigen::Infinity>()));
    for (const LinearExpression::Term& term : trace.terms)
      assembly.compare_round_off(
          flux, of_temperature_.cwiseProduct(term.matrix.entries().cwiseAbs() * term.field->now().cwiseAbs())
                    .lpNorm<Eigen::Infinity>());
    if (!assembly.wants_derivatives()) return;
    assembly.diagonal(flux, flux, of_flux_);
    for (const LinearExpression::Term& term : trace.terms)
      assembly.derivative(flux, *term.field, SparseMatrix(of_temperature_.asDiagonal() * term.matrix.entries()));
    assembly.derivative(flux, temperature, SparseMatrix((-of_temperature_).asDiagonal() * to_walls_));
  }

  void note_step(Notes& notes, const StepTime&) const override {
    if (!along_.empty()) notes.add(name() + ": heat along cells that are no rectangles", along_);
  }

  static void note_absence(const std::vector<Component*>& components, Notes& notes) {
    for (const Component* rock : components)
      for (const Component* fracture : components) {
        if (!dynamic_cast<const HeatWalls*>(rock) || !dynamic_cast<const FractureTemperature*>(fracture)) continue;
        const std::string both = rock->name() + " and " + fracture->name();
        notes.add("no heat_exchange between " + both,
                  "no heat is conducted between " + both +
                      " (the walls of fractures are insulated without a coupler heat_exchange) add '- {type: "
                      "heat_exchange, between: [" +
                      rock->name() + ", " + fracture->name() + "]}' to 'couplers:', unless that is meant");
      }
  }

 private:
  /// Looks for the fracture cell in which two-point fluxes are not exact and that conducts most along the fracture,
  /// over what a layer of rock as thick as the cell is long conducts. `in_front`: of each wall, W/(m^2 K).
  void find_conduction_along(const Vector& in_front) {
    along_.clear();
    const Vector* thickness = fracture_.thickness();
    if (dimension == 2 || !thickness) return;
    double largest = noticeable_part_along;
    for (int i = 0; i < mesh_.fracture_cell_count(); ++i) {
      const FractureCell& cell = mesh_.fracture_cells[i];
      double rock = 0;  // W/(m K), the mean of both sides
      for (const int side : {0, 1}) {
        const int beside = mesh_.face_cells[cell.faces[side]][0];
        rock += 0.5 * in_front[2 * i + side] * std::abs((mesh_.cell_center[beside] - cell.center).dot(cell.normal));
      }
      const double a = (*thickness)[i], water = 0.5 * fracture_.wall_conductance()[2 * i] * a;
      const double part = water * a / (rock * cell.size());
      if (part <= largest || is_exact_by_two_points(i)) continue;
      largest = part;
      along_ = fmt::format(
          "heat that is conducted along the fracture '{}' is not accurate: at {} the fracture conducts {:.2g} times as "
          "much along itself as the rock "
          "beside it (two-point fluxes along fractures are exact in rectangles alone) take a structured mesh of "
          "hexahedra, whose fractures consist "
          "of rectangles",
          mesh_.fractures[cell.fracture].name, to_text(cell.center), part);
    }
  }

  /// Whether the lines from the centre to the ridges are at right angles to these.
  bool is_exact_by_two_points(int cell) const {
    constexpr double round_off = 1e-9;
    return std::ranges::all_of(mesh_.fracture_cells[cell].ridges, [&](int ridge) {
      const double apart = (mesh_.ridges[ridge].center - mesh_.fracture_cells[cell].center).norm();
      return apart <= (1 + round_off) * distance_to_ridge(mesh_, cell, ridge);
    });
  }

  const Mesh& mesh_;
  MatrixTemperature& matrix_;
  HeatWalls& walls_;
  FractureTemperature& fracture_;
  Vector conductance_;     ///< W/(m^2 K), one a wall
  SparseMatrix to_walls_;  ///< walls × fracture cells
  Operator outflow_;       ///< fracture cells × walls: lengths
  Vector of_flux_, of_temperature_;
  std::string along_;  ///< a note, or ""
};

const RegisterCoupler<HeatExchange, HeatExchangeOptions> registration("heat_exchange");

}  // namespace
}  // namespace sprekk::couplers
