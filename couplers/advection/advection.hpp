// heat_advection, tracer_advection: flowing fluid carries heat, or a tracer, through the matrix, along fractures and
// through their walls.
#pragma once

#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "components/capabilities/carried.hpp"
#include "components/capabilities/fluid_fluxes.hpp"
#include "components/capabilities/matrix_fluid.hpp"
#include "couplers/advection/fluid_contents.hpp"
#include "couplers/advection/held_flow.hpp"
#include "couplers/advection/limited_values.hpp"
#include "couplers/advection/options.hpp"
#include "couplers/advection/streams.hpp"
#include "couplers/advection/well_mixture.hpp"
#include "framework/assembly/counts_from_here.hpp"
#include "framework/assembly/follows_mesh.hpp"
#include "framework/assembly/heeds_stages.hpp"
#include "framework/assembly/keeps_state.hpp"
#include "framework/assembly/keeps_totals.hpp"
#include "framework/scene/registry.hpp"

namespace sprekk::couplers {

/// Adds the transport by streams of fluid (Stream) to the balance of each cell. With the fluid m that these streams
/// have brought into the cell since the start (m^2, in space m^3), the cell stores c (m T − m_old T_old), and a stream
/// of the rate q brings c dt q T_from, with the value T_from upstream. For heat T is the temperature and c the heat
/// capacity of the fluid, for a tracer T is the concentration and c is 1. Together with m = m_old + dt (sum of q) this
/// is
///   c m_old (T − T_old) + c dt (sum over what enters of q (T − T_from)).
/// With the scheme `limited` a stream between cells has the value T_from + d (LimitedValues): c dt |q| d is added to
/// the balance of the cell that it leaves, and subtracted from that of the cell that it enters. So a uniform value
/// stays uniform with any fluxes, and the amount is conserved with each schedule, also if the flow is solved before or
/// after. What has entered by the start of the step decays at the rate of the cell, c dt r m_old T, which also keeps a
/// uniform value uniform.
class Advection : public Coupler,
                  public KeepsState,
                  public FollowsMesh,
                  public KeepsTotals,
                  public CountsAmounts,
                  public HeedsStages {
 public:
  /// Throws InputError without a flow that carries something, and for wells that the coupler leaves out.
  Advection(const CouplerContext& context, const Carried& carried, const AdvectionOptions& options,
            MatrixCarried* in_rock, FractureCarried* in_fractures);
  /// Both sides of a wall count the same transport through it in a step.
  std::vector<Dependence> dependences() const override;
  bool allows_stages() const override { return true; }
  std::string need_of_one_clock() const override {
    return "what fluid carries needs the flow of its own stages, and substeps have others";
  }
  void evaluate_data(const StepTime& step) override;
  void begin_step(const StepTime& step) override;
  void assemble(Assembly& assembly, const StepTime& step) const override;
  void after_solve(const std::vector<Field*>& solved, const StepTime& step) override;
  void carry_over(const Part& before, const MeshChange&) override {
    flow_->carry_over(*dynamic_cast<const Advection&>(before).flow_);
  }
  void accepted() override { flow_->accepted(); }
  void rewound() override { flow_->rewound(); }
  void save(std::map<std::string, Vector>& state) const override { flow_->save(state); }
  void restore(const std::map<std::string, Vector>& state) override { flow_->restore(state); }
  void begin_totals() override;
  /// The capacity of cells becomes that with the fluid of the settled state.
  void count_amounts_from_here(const SettledFields& settled) override;
  void balance(std::map<std::string, Balance>& balances) const override;
  /// The value of the fluid that leaves or enters at each named place of the flow.
  void report(std::vector<Quantity>& quantities) const override;
  void note_input(Notes& notes) const override;
  void note_step(Notes& notes, const StepTime&) const override;
  std::vector<double> switch_times() const override;

 private:
  /// Updates dispersion, if there is any, by the last solution of the flow.
  void disperse(bool in_rock, bool in_fractures);
  StreamSources sources() const;
  /// Adds a note for each side through which fluid without a given value enters.
  void note_untold_fluid(Notes& notes) const;
  template <class Medium>
  FluidContents contents(const CouplerContext& context, Medium& medium, Location location, const char* where) const {
    return {context, carried_, medium.value(), location, where, options_.per_volume, medium.decay()};
  }
  /// Finds fracture cells in which the carried quantity has another aperture than the fluid; for a note.
  void compare_apertures(const CouplerContext& context);
  void find_wells(const CouplerContext& context);
  /// The values of fluid that enters wells from outside, one a well.
  std::vector<std::optional<double>> injected_by_wells() const;
  /// Throws DataError for a value of a place that the flow does not have.
  void check_names() const;
  const std::optional<LimitedValues>& limited_of(const FluidContents& place) const;
  /// LimitedValues::weights; empty with the scheme `upwind`.
  Vector weights_of(const FluidContents& place, const std::vector<Stream>& streams, const StepTime& step) const;
  /// The value of the fluid that a stream brings, or of the cell that it leaves.
  double value_of(const FluidContents& place, const Stream& stream, const Mixtures& wells) const;
  /// Adds the balance of all cells of a place.
  void add(Assembly& assembly, const FluidContents& place, const std::vector<Stream>& streams, const Mixtures& wells,
           const StepTime& step) const;
  /// Counts the fluid, and what it carries, after a solve.
  void count(FluidContents& place, const std::vector<Stream>& streams, const Mixtures& wells, const StepTime& step);

  const Mesh& mesh_;
  const Carried& carried_;
  AdvectionOptions options_;
  Origin origin_;
  MatrixCarried* in_rock_;
  FractureCarried* in_fractures_;
  MatrixFluxes* matrix_ = nullptr;
  FractureFluxes* fracture_ = nullptr;
  MatrixFluid* flow_in_rock_ = nullptr;
  MatrixWalls* walls_ = nullptr;
  ValuesOfWells wells_;
  std::string other_aperture_;    ///< a note, or ""
  std::vector<Vector> at_start_;  ///< values of the cells that fluid reaches
  FluidContents rock_, fractures_;
  std::optional<LimitedValues> limited_in_rock_, limited_in_fractures_;  ///< empty with the scheme `upwind`
  double begun_with_ = 0;                                                ///< s: the length of the step
  std::optional<HeldFlow> flow_;
  std::vector<std::pair<std::string, double>> injected_;  ///< values in this step
  /// Whether dispersion is that of the step before, because the last solve included the flow.
  bool disperses_late_ = false;
};

}  // namespace sprekk::couplers
