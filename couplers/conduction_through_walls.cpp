// heat_exchange, tracer_exchange: heat, or a tracer, is conducted between a fracture and the matrix through its walls.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "components/capabilities/concentration.hpp"
#include "components/capabilities/temperature.hpp"
#include "couplers/wall_fluxes.hpp"
#include "framework/assembly/property.hpp"
#include "framework/field/ownership.hpp"
#include "framework/invariants.hpp"
#include "framework/mesh/geometry.hpp"
#include "framework/mesh/ridge_distance.hpp"
#include "framework/noticeable.hpp"
#include "framework/round_off.hpp"
#include "framework/scene/registry.hpp"

namespace sprekk::couplers {
namespace {

struct ExchangeOptions {
  std::optional<Data> conductance;
  void declare_conductance(Spec& spec, const char* unit, const std::string& what) {
    spec.ignore("type").ignore("between");
    spec.data("conductance", conductance,
              {.unit = unit,
               .range = non_negative(),
               .doc = "Conductance of each wall, per length (in space, area) of the fracture; without it, twice the " +
                      what + " over the aperture of the fracture.",
               .fixed = "the walls conduct as at the start"});
  }
};

struct HeatExchangeOptions : ExchangeOptions {
  Spec spec() {
    Spec spec("heat_exchange",
              "Heat conducted between fractures and matrix through the walls, driven by the difference of their "
              "temperatures.");
    declare_conductance(spec, "W/(m^2*K)", "conductivity");
    return spec;
  }
};

struct TracerExchangeOptions : ExchangeOptions {
  Spec spec() {
    Spec spec("tracer_exchange",
              "Tracer that diffuses between fractures and matrix through the walls, driven by the difference of their "
              "concentrations.");
    declare_conductance(spec, "m/s", "coefficient of diffusion");
    return spec;
  }
};

/// Notes components between which nothing is conducted.
template <class Walls, class Fracture>
void note_insulated(const Carried& carried, const std::vector<Component*>& components, Notes& notes) {
  const std::string coupler = carried.quantity + "_exchange";
  for (const Component* rock : components)
    for (const Component* fracture : components) {
      if (!dynamic_cast<const Walls*>(rock) || !dynamic_cast<const Fracture*>(fracture)) continue;
      const std::string both = rock->name() + " and " + fracture->name();
      notes.add("no " + coupler + " between " + both, "no " + carried.quantity + " is conducted between " + both +
                                                          " (the walls of fractures are insulated without a coupler " +
                                                          coupler + ") add '- {type: " + coupler + ", between: [" +
                                                          rock->name() + ", " + fracture->name() +
                                                          "]}' to 'couplers:', unless that is meant");
    }
}

/// Determines the conducted flux q of every wall, from the fracture into the matrix: q = h (T_i − tr T), with
/// temperatures or concentrations T. Its row is divided by h plus the conductance of the matrix in front of the wall,
/// and so well scaled for all walls.
class Exchange : public Coupler {
 public:
  Exchange(const CouplerContext& context, const ExchangeOptions& options, MatrixCarried& matrix, CarriedWalls& walls,
           FractureCarried& fracture)
      : Coupler(context.name),
        mesh_(context.mesh),
        matrix_(matrix),
        walls_(walls),
        fracture_(fracture),
        fluxes_(mesh_),
        conductance_(fracture_.wall_conductance()) {
    context.determine(walls_.wall_flux());
    const std::vector<Place> places = fracture_cell_places(mesh_);
    for (int w = 0; options.conductance && w < mesh_.wall_count(); ++w)
      conductance_[w] = options.conductance->at(places[w / 2]);
  }

  /// What passes the walls in a step is that of one flux, for both sides.
  std::vector<Dependence> dependences() const override {
    const std::string matrix = matrix_.value().spec().owner, fracture = fracture_.value().spec().owner;
    const std::string because =
        matrix_.carried().quantity + " that leaves the one through the walls enters the other in the same step";
    return {{matrix, fracture, because}, {fracture, matrix, because}};
  }

  bool allows_stages() const override { return true; }

  void begin_step(const StepTime&) override {
    const Vector in_front = conductance_in_front(mesh_, walls_.wall_value(), walls_.wall_flux());
    find_conduction_along(in_front);
    const Vector scale = (conductance_ + in_front).cwiseInverse();
    of_flux_ = scale;
    of_value_ = scale.cwiseProduct(conductance_);
    SPREKK_ASSERT(is_finite(of_value_) && scale.minCoeff() > 0, scale.minCoeff());
  }

  void assemble(Assembly& assembly, const StepTime& step) const override {
    const Field &flux = walls_.wall_flux(), &value = fracture_.value();
    if (assembly.has_row(value)) assembly.linear(value, fluxes_.outflow, flux, step.dt);
    if (!assembly.has_row(flux)) return;
    assembly.add(flux, of_flux_.cwiseProduct(flux.now()));
    assembly.diagonal(flux, flux, of_flux_);
    add_trace(assembly, flux, walls_.wall_value(), of_value_);
    assembly.add(flux, -of_value_.cwiseProduct(fluxes_.to_walls * value.now()));
    // Where no wall conducts, fluxes are zero, up to round-off relative to what the rock at the walls would conduct.
    if (of_value_.isZero(0))
      assembly.compare_round_off(
          flux, std::max(matrix_.value().now().lpNorm<Eigen::Infinity>(), value.now().lpNorm<Eigen::Infinity>()));
    if (!assembly.wants_derivatives()) return;
    assembly.derivative(flux, value, SparseMatrix((-of_value_).asDiagonal() * fluxes_.to_walls));
  }

  void note_step(Notes& notes, const StepTime&) const override {
    if (!along_.empty()) notes.add(name() + ": " + carried().quantity + " along cells that are no rectangles", along_);
  }

 private:
  /// Looks for the fracture cell that conducts most along the fracture, relative to a layer of rock as thick as the
  /// cell is long, among the cells in which two-point fluxes are not exact. `in_front`: of each wall, W/(m^2 K).
  void find_conduction_along(const Vector& in_front) {
    along_.clear();
    const Vector* thickness = fracture_.thickness();
    if (dimension == 2 || !thickness) return;
    double largest = noticeable;
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
          "{} that is conducted along the fracture '{}' is not accurate: at {} the fracture conducts {:.2g} times as "
          "much along itself as the rock "
          "beside it (two-point fluxes along fractures are exact in rectangles alone) take a structured mesh of "
          "hexahedra, whose fractures consist "
          "of rectangles",
          carried().quantity, mesh_.fractures[cell.fracture].name, to_text(cell.center), part);
    }
  }

  /// Whether the lines from the centre to the ridges are at right angles to these.
  bool is_exact_by_two_points(int cell) const {
    return std::ranges::all_of(mesh_.fracture_cells[cell].ridges, [&](int ridge) {
      const double apart = (mesh_.ridges[ridge].center - mesh_.fracture_cells[cell].center).norm();
      return apart <= (1 + rounding::same) * distance_to_ridge(mesh_, cell, ridge);
    });
  }

  const Carried& carried() const { return matrix_.carried(); }

  const Mesh& mesh_;
  MatrixCarried& matrix_;
  CarriedWalls& walls_;
  FractureCarried& fracture_;
  WallFluxes fluxes_;
  Vector conductance_;  ///< W/(m^2 K), one a wall
  Vector of_flux_, of_value_;
  std::string along_;  ///< a note, or ""
};

/// Heat that is conducted.
class HeatExchange : public Exchange {
 public:
  HeatExchange(const CouplerContext& context, const HeatExchangeOptions& options)
      : Exchange{context, options, context.the<MatrixTemperature>(), context.the<HeatWalls>(),
                 context.the<FractureTemperature>()} {}
  static void note_absence(const std::vector<Component*>& components, Notes& notes) {
    note_insulated<HeatWalls, FractureTemperature>(carried_heat, components, notes);
  }
};

/// A tracer that diffuses.
class TracerExchange : public Exchange {
 public:
  TracerExchange(const CouplerContext& context, const TracerExchangeOptions& options)
      : Exchange{context, options, context.the<MatrixConcentration>(), context.the<TracerWalls>(),
                 context.the<FractureConcentration>()} {}
  static void note_absence(const std::vector<Component*>& components, Notes& notes) {
    note_insulated<TracerWalls, FractureConcentration>(carried_tracer, components, notes);
  }
};

const RegisterCoupler<HeatExchange, HeatExchangeOptions> heat_registration("heat_exchange");
const RegisterCoupler<TracerExchange, TracerExchangeOptions> tracer_registration("tracer_exchange");

}  // namespace
}  // namespace sprekk::couplers
