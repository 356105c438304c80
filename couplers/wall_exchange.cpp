// wall_exchange: fluid flows between a fracture and the matrix through its walls (Eq. 9 of the paper).
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>

#include "components/capabilities/fracture_fluid.hpp"
#include "components/capabilities/matrix_fluid.hpp"
#include "couplers/passed_amounts.hpp"
#include "couplers/wall_fluxes.hpp"
#include "framework/assembly/balance_rows.hpp"
#include "framework/assembly/counts_from_here.hpp"
#include "framework/assembly/keeps_state.hpp"
#include "framework/assembly/rests_together.hpp"
#include "framework/field/ownership.hpp"
#include "framework/field/units_of_amounts.hpp"
#include "framework/invariants.hpp"
#include "framework/parallel/parallel.hpp"
#include "framework/scene/registry.hpp"

namespace sprekk::couplers {
namespace {

struct WallExchangeOptions {
  Spec spec() {
    Spec spec("wall_exchange",
              "Flux between fractures and matrix through the walls, driven by the difference of their pressures (the "
              "paper's Eq. 9).");
    spec.ignore("type").ignore("between");
    return spec;
  }
};

/// Determines lambda of every wall, from the fracture into the matrix: lambda = kappa (p_i − tr p). Its row is divided
/// by about kappa + 1/r, with r the resistance of the matrix in front of the wall (d tr p / d lambda), and so is well
/// scaled from sealed to wide open walls. The exact divisor leaves a power of two as factor of tr p, so that the
/// products with rows of tr p are only scaled when kappa changes (BulkSchurComplement). lambda leaves the fluid balance
/// of the fracture: Eq. 8 of the paper, with the sign of Eq. 9 changed to that of a flux out of the fracture. What the
/// matrix has received through each wall, the fracture counts when it is solved.
class WallExchange : public Coupler, public KeepsState, public CountsAmounts, public RestsTogether {
 public:
  WallExchange(const CouplerContext& context, const WallExchangeOptions&)
      : Coupler(context.name),
        mesh_(context.mesh),
        walls_(context.the<MatrixWalls>()),
        fluid_(context.find<MatrixFluid>()),
        fracture_(context.the<FractureFluid>()),
        fluxes_(mesh_),
        start_time_(context.start_time),
        passed_(context.fields, mesh_, context.name, Location::wall, walls_.wall_flux(), fracture_.pressure(), "matrix",
                "fracture") {
    context.determine(walls_.wall_flux());
    if (fluid_ && walls_.is_permeable()) fracture_.accept_rock_fluid(*fluid_, walls_);
  }

  bool allows_stages() const override { return true; }
  void begin_step(const StepTime&) override {
    matrix_conductance_ = conductance_in_front(mesh_, walls_.wall_pressure(), walls_.wall_flux());
  }

  void assemble(Assembly& assembly, const StepTime& step) const override {
    const Field& flux = walls_.wall_flux();
    const Field& pressure = fracture_.pressure();
    if (assembly.has_row(pressure)) {
      BalanceRows(assembly, pressure)
          .store(fluxes_.to_walls.transpose() *
                 (assembly.has_row(flux) ? passed_.uncounted_at_start() : passed_.uncounted_now()));
      if (assembly.has_row(flux)) assembly.linear(pressure, fluxes_.outflow, flux, step.dt);
    }
    if (!assembly.has_row(flux)) return;

    const FractureFluid::NormalPermeability kappa = fracture_.normal_permeability();
    const int walls = mesh_.wall_count();
    SPREKK_ASSERT(kappa.value.size() == walls, kappa.value.size(), walls);
    Vector of_flux(walls), of_trace(walls), of_pressure(walls);
    for (int w = 0; w < walls; ++w) {
      const double k = walls_.is_behind_wall(w) ? kappa.value[w] : 0, scale = 1 / (k + matrix_conductance_[w]);
      SPREKK_ASSERT(k >= 0 && std::isfinite(scale) && scale > 0, w, k, matrix_conductance_[w]);
      of_trace[w] = power_of_two_near(scale * k);
      of_flux[w] = of_trace[w] > 0 ? of_trace[w] / k : scale;
      of_pressure[w] = -of_trace[w];
    }
    assembly.add(flux, of_flux.cwiseProduct(flux.now()));
    assembly.diagonal(flux, flux, of_flux);
    const Vector trace = add_trace(assembly, flux, walls_.wall_pressure(), of_trace);
    assembly.add(flux, of_pressure.cwiseProduct(fluxes_.to_walls * pressure.now()));
    if (!assembly.wants_derivatives()) return;
    assembly.derivative(flux, pressure, SparseMatrix(of_pressure.asDiagonal() * fluxes_.to_walls));
    Vector by_aperture(walls);
    for (int w = 0; w < walls; ++w) {
      const double difference = of_trace[w] > 0 ? -flux.now()[w] / kappa.value[w] : trace[w] - pressure.now()[w / 2];
      by_aperture[w] = walls_.is_behind_wall(w) ? of_flux[w] * kappa.by_aperture[w] * difference : 0;
    }
    assembly.derivative(flux, fracture_.aperture(), SparseMatrix(by_aperture.asDiagonal() * fluxes_.to_walls));
  }

  void after_solve(const std::vector<Field*>& solved, const StepTime& step) override {
    passed_.after_solve(solved, [&] {
      Vector passing(mesh_.wall_count());
      for (int w = 0; w < mesh_.wall_count(); ++w)
        passing[w] = step.dt * mesh_.fracture_cells[w / 2].measure * walls_.wall_flux().now()[w];
      return passing;
    });
  }
  void accepted() override { passed_.accepted(); }
  void count_amounts_from_here(const SettledFields&) override { passed_.begin(); }

  std::vector<Dependence> dependences_at_rest() const override {
    const std::string& matrix = walls_.wall_flux().spec().owner;
    return {{fracture_.pressure().spec().owner, matrix,
             "what flows through the walls is an unknown of '" + matrix + "', which would be held"}};
  }

  /// The amount that the matrix has received and the fracture has not counted yet is stored in both: it is subtracted.
  void balance(std::map<std::string, Balance>& balances) const override {
    balances["fluid"].stored -= passed_.sum_uncounted();
  }

  void note_step(Notes& notes, const StepTime& step) const override {
    if (!fluid_ || step.start != start_time_) return;
    const Field *none_of = &fracture_.pressure(), *other = &fluid_->pressure();
    if (largest(*none_of) > 0) std::swap(none_of, other);
    constexpr double worth_a_note = 1e5;  // Pa, that of the atmosphere
    const double difference = largest(*other);
    if (largest(*none_of) > 0 || difference < worth_a_note) return;
    notes.add(name() + ": a start without pressure",
              fmt::format("{} starts at 0 Pa, and {} at up to {:.3g} Pa (fluid flows fast between rock and fractures "
                          "in the first step) give an 'initial_pressure' to both, unless that is meant",
                          none_of->name(), other->name(), difference));
  }

  static void note_absence(const std::vector<Component*>& components, Notes& notes) {
    for (const Component* rock : components) {
      const auto* walls = dynamic_cast<const MatrixWalls*>(rock);
      if (!walls || !walls->is_permeable()) continue;
      for (const Component* fracture : components) {
        if (!dynamic_cast<const FractureFluid*>(fracture)) continue;
        const std::string both = rock->name() + " and " + fracture->name();
        notes.add("no wall_exchange between " + both,
                  "no fluid flows between " + both +
                      " (the walls of fractures are sealed without a coupler wall_exchange) add '- {type: "
                      "wall_exchange, between: [" +
                      rock->name() + ", " + fracture->name() + "]}' to 'couplers:', unless that is meant");
      }
    }
  }

 private:
  /// The largest size of an accepted value.
  static double largest(const Field& pressure) {
    return parallel::max(pressure.size() > 0 ? pressure.accepted().lpNorm<Eigen::Infinity>() : 0.0);
  }

  static double power_of_two_near(double share) {
    int exponent = 0;
    const double mantissa = std::frexp(share, &exponent);  // 0 or from 1/2 to 1
    return mantissa == 0 ? 0 : std::ldexp(1.0, mantissa < std::numbers::sqrt2 / 2 ? exponent - 1 : exponent);
  }

  const Mesh& mesh_;
  MatrixWalls& walls_;
  MatrixFluid* fluid_;
  FractureFluid& fracture_;
  WallFluxes fluxes_;
  double start_time_;     ///< s
  PassedAmounts passed_;  ///< through each wall
  Vector matrix_conductance_;
};

const RegisterCoupler<WallExchange, WallExchangeOptions> registration("wall_exchange");

}  // namespace
}  // namespace sprekk::couplers
