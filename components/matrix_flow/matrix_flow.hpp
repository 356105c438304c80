// Flow of a slightly compressible fluid in the matrix (Eq. 6 of the paper), for any discretization of the flux.
#pragma once

#include <array>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "components/capabilities/fluid_density.hpp"
#include "components/capabilities/fluid_fluxes.hpp"
#include "components/capabilities/matrix_border.hpp"
#include "components/capabilities/matrix_fluid.hpp"
#include "components/matrix_flow/flux_derivatives.hpp"
#include "components/matrix_flow/flux_operators.hpp"
#include "components/matrix_flow/open_border.hpp"
#include "components/matrix_flow/rediscretize.hpp"
#include "components/matrix_flow/side_condition.hpp"
#include "framework/assembly/assemble_all.hpp"
#include "framework/assembly/balance_rows.hpp"
#include "framework/assembly/counts_from_here.hpp"
#include "framework/assembly/counts_later.hpp"
#include "framework/assembly/counts_work.hpp"
#include "framework/assembly/follows_mesh.hpp"
#include "framework/assembly/history/history_options.hpp"
#include "framework/assembly/keeps_state.hpp"
#include "framework/assembly/keeps_totals.hpp"
#include "framework/assembly/lives_in_part.hpp"
#include "framework/assembly/may_store_nothing.hpp"
#include "framework/assembly/notes_start.hpp"
#include "framework/assembly/piecewise_smooth.hpp"
#include "framework/assembly/property.hpp"
#include "framework/assembly/state_fields.hpp"
#include "framework/config/spec.hpp"
#include "framework/scene/component.hpp"

namespace sprekk {
class FormulaOfCells;
class StateOfCells;
}  // namespace sprekk

namespace sprekk::matrix_flow {

class Buoyancy;
class HistoryOfCells;
class LeakySides;
class StorageFormula;

/// A point source or sink of fluid.
struct Well {
  Origin origin;
  std::optional<Point> at;    ///< m, or
  std::vector<Point> points;  ///< m, of a line
  Data rate;                  ///< m^2/s, into the rock
  std::vector<Point> path() const { return at ? std::vector{*at} : points; }
};

/// Parameters of the flow in the matrix.
struct Options {
  HistoryOptions history;
  TensorData permeability;      ///< m^2
  Data viscosity;               ///< Pa s
  std::optional<Data> storage;  ///< 1/Pa
  std::optional<Data> porosity;
  std::optional<Data> fluid_compressibility;  ///< 1/Pa
  VectorData gravity;                         ///< m/s^2
  double fluid_density = 1000;                ///< kg/m^3
  Data initial_pressure;                      ///< Pa
  Data source;                                ///< 1/s
  std::map<std::string, SideCondition> boundary;
  std::map<std::string, Well> wells;
  std::vector<std::string> regions;  ///< with flow; all if there are none
  Origin regions_origin;
  std::map<std::string, std::string> without_effect;  ///< keys of the component that have no effect, and why
  /// `takes_formulas`: whether permeability, porosity and storage may follow the state.
  Spec spec(const std::string& type, const std::string& doc, bool takes_formulas = false);

 private:
  void declare_storage(Spec& spec);
};

/// Unknown: the pressure p of every cell. Each row balances the volume of fluid of one cell over the step (m^2):
///   S V (p − p_old) + dt (sum of the fluxes out of it) − dt q V = 0,  flux = −(k/mu)(grad p − rho g).
/// The flux is linear in the pressures of cells, or of cells and faces (which are then unknowns, too), or it has a
/// nonlinear part (FluxOperators). Gravity enters through the potential p − rho g·x, which is exact for a constant
/// density; Buoyancy adds the effect of a varying one. Properties may change with time and are taken at the end of the
/// step. A change of the storage S alone moves no fluid. With Options::regions there is a flow in these regions only,
/// and no flux through their boundary to other rock: the discretization has their cells alone (discretize_inside). All
/// other cells keep their initial pressure (rows p − p_old = 0, times a storage), so they exert no load.
///
/// The permeability may be a formula of the state at the end of the step. Then all operators are
/// computed again before each assembly of these balances, and Newton's method gets the derivatives of fluxes and
/// traces. The porosity may be a formula, too: S V (p − p_old) is then replaced by the change of the pores' content
/// since it was counted last (stored_by_state.cpp), which does not depend on the path of the state.
class MatrixFlow : public Component,
                   public PiecewiseSmooth,
                   public KeepsState,
                   public FollowsMesh,
                   public CountsWork,
                   public MatrixFluid,
                   public MatrixWalls,
                   public MatrixFluxes,
                   public MatrixBorder,
                   public BuoyantMatrix,
                   public KeepsTotals,
                   public LivesInPart,
                   public MayStoreNothing,
                   public NotesStart,
                   public TakesState,
                   public TakesExpressions,
                   public FollowsState,
                   public CountsAmounts,
                   public CountsLater {
 public:
  /// Where the unknowns of the discretization are: also on faces if it has FluxOperators::faces.
  enum class Unknowns { on_cells, on_cells_and_faces };
  /// Whether fluxes are linear in the pressures, or contain FluxOperators::limited.
  enum class Fluxes { linear, two_point, limited };
  MatrixFlow(const ComponentContext& context, const Options& options, Discretize discretize,
             Unknowns unknowns = Unknowns::on_cells, Fluxes fluxes = Fluxes::linear,
             DifferentiateFluxes differentiate = {});
  ~MatrixFlow() override;

  void offer_state(const std::string& variable, const StateField& source) override;
  void offer_expression(const std::string& variable, const StateExpression& source) override;
  void require_state() const override;
  void follow_state(const Assembly& assembly) override;
  bool mobility_follows_state() const override { return by_state_ != nullptr; }

  void evaluate_data(const StepTime& step) override;
  bool allows_stages() const override { return true; }
  void begin_step(const StepTime& step) override;
  /// Discretizes on the new mesh; the unchanged part of the discretization of `before` is kept.
  void carry_over(const Part& before, const MeshChange& change) override;
  /// The pressures at the walls of fractures.
  void add_known_within_cells(const Field& field, KnownWithinCells& known) const override;
  void settled(const MeshChange& change) override;
  void count_amounts_from_here(const SettledFields& settled) override;
  void count_rest_later(const Assembly& assembly) override;
  void assemble(Assembly& assembly, const StepTime& step) const override;
  void after_solve(const std::vector<Field*>& solved, const StepTime& step) override;
  void accepted() override { solved_fluxes_ = {}; }
  void rewound() override { solved_fluxes_ = {}; }
  void balance(std::map<std::string, Balance>& balances) const override;
  void begin_totals() override { cumulative_.set_both(Vector::Zero(cumulative_.size())); }
  /// Limited fluxes are first held at the linear mean of both sides; then they become smooth functions (`rounding` of
  /// `limit`) that approach the limited ones.
  void set_search_mode(SearchMode mode) override;
  void observe_iterate(const std::vector<Field*>& unknowns) override;
  void release_coefficients(double share) override;
  bool is_nonlinear_in_pieces() const override { return by_state_ || (is_limited_ && !is_sealed_); }
  std::uint64_t discrete_state() const override;
  std::vector<double> switch_times() const override;
  bool stores_nothing_somewhere() const override;
  /// The rates of wells, and the outflow through each side with a condition, at the end of the step.
  void report(std::vector<Quantity>& quantities) const override;
  void output(std::vector<OutputField>& fields) const override;
  void note_input(Notes& notes) const override;
  void note_start(Notes& notes) const override;
  void note_step(Notes& notes, const StepTime& step) const override;
  std::map<std::string, long> counts() const override {
    return {{"flux discretizations", discretizations_},
            {"flux discretizations: cells", discretized_cells_},
            {"flux discretizations: regions", discretized_regions_}};
  }

  Field& pressure() override { return pressure_; }
  const Vector& initial_pressure() const override { return initial_pressure_; }
  double largest_given_pressure() const override;
  bool is_open(int side) const override {
    const auto found = options_.boundary.find(mesh_.side_names[side]);
    return found != options_.boundary.end() && (found->second.pressure || found->second.is_leaky());
  }
  std::optional<OutsideOfRock> outside(int side, const Place& place, const StepTime& step) const override;
  const Property* porosity_for_storage() const override { return options_.storage || pores_ ? nullptr : &porosity_; }
  bool has_pores_by_formula() const override { return pores_ != nullptr; }
  bool porosity_depends_on(const std::string& variable) const override;
  void change_viscosity(const Vector& viscosity) override;
  void accept_rock_storage(const Vector& storage) override { rock_storage_ = storage; }
  Field& wall_flux() override { return *wall_flux_; }
  double diffusivity(int cell) const override;
  bool is_in_cell(int cell) const override { return inside_.empty() || inside_[cell]; }
  bool is_behind_wall(int wall) const override { return is_in_cell(mesh_.face_cells[mesh_.wall_face(wall)][0]); }
  const std::vector<char>& inhabited_cells() const override { return inside_; }
  bool is_permeable() const override { return !is_sealed_; }
  const LinearExpression& wall_pressure() const override;
  void open_border(const Field& outflow, double sign, const std::vector<char>& faces) override;
  void share_cells() override { shares_cells_ = true; }
  bool shares_fluid() const override { return shares_cells_ || has_open_border(); }
  const LinearExpression& border_pressure(const Field& outflow) const override;
  bool has_gravity() const override { return !options_.gravity.is_zero(); }
  double weight_between(const Point& from, const Point& to) const override {
    return gravity_potential(to) - gravity_potential(from);
  }
  bool density_varies() const override { return buoyancy_ != nullptr; }
  void accept_density(const FluidDensity& in_rock, const FluidDensity* in_fractures) override;

  double round_off_base_of_fluxes() const override {
    return largest_conductance_ * pressure_.now().lpNorm<Eigen::Infinity>();
  }
  const Vector& face_fluxes() const override;
  std::vector<Derivative> face_flux_derivatives() const override;
  std::vector<FluidSource> fluid_sources() const override { return sources_; }
  const std::vector<Tensor>& mobility() const override { return mobility_; }
  FluxOperators fluxes_around(const std::vector<char>& nodes, const Tensor& mobility) const override;

 protected:
  const Mesh& mesh() const { return mesh_; }
  /// The storage of a cell, with that of the deforming rock, 1/Pa.
  double whole_storage(int cell) const { return storage_[cell] + (rock_storage_.size() > 0 ? rock_storage_[cell] : 0); }
  /// A number that changes with the mobility.
  std::uint64_t mobility_version() const { return mobility_version_; }
  /// Takes another discretization; to be called by the constructor.
  void discretize_with(Discretize discretize) { discretize_ = std::move(discretize); }
  /// Makes begin_step discretize, although mesh and mobility have not changed.
  void discretize_anew() { discretized_mesh_ = 0; }

 private:
  /// The flow at one state of the pressure, without the fluxes through walls.
  struct Flow {
    /// The versions of the fields that it depends on.
    std::uint64_t pressure = 0, face_pressure = 0, wall_flux = 0, side_outflow = 0;
    FluidDensity::Version density = {};  ///< the same
    std::uint64_t used = 0;              ///< when; 0 for never
    Vector fluxes;                       ///< m^2/s, one a face
    Vector outflow;                      ///< m^2/s, one a cell: the sums of the fluxes out of it
    Vector leaving;                      ///< m^2/s, one a cell: the part of the outflow that leaves the rock
    double largest_outflow = 0;
    Vector by_first, by_second;  ///< derivatives of limited fluxes by those of each side
  };

  /// Notes pressures that violate a maximum principle (find_overshoots), and nodes where fluxes are not exact.
  void note_fluxes(Notes& notes, const StepTime& step) const;
  double gravity_potential(const Point& x) const;  ///< rho g·x, Pa
  void find_regions();
  void check_sides() const;
  bool has_open_border() const { return !open_faces_.empty(); }
  std::vector<const Data*> properties() const;
  /// Updates mobility and wells after properties have changed.
  void use_properties();
  void check_mobility();
  /// For a permeability by formulas: declares them, refuses what they exclude, evaluates them, and finds derivatives at
  /// the present state.
  void find_state_permeability();
  void refuse_with_formula(const std::string& what, const std::string& why) const;
  void take_permeability();
  void search_by_state(SearchMode mode);
  void release_by_state(double share);
  void linearize();
  void assemble_by_state(Assembly& assembly, double dt) const;
  /// Spreads each well over the cells around it so that its total rate and its position are kept.
  void place_wells();
  void discretize();
  /// Discretizes, and keeps the unchanged part of the operators that were made for `before`.
  void discretize_from(const FlowInputs& before, const FluxOperators& operators, const MeshChange& change);
  void find_conditions();
  /// Updates the matrices of balances and walls after the operators have changed.
  void use_operators();
  /// Adds the terms of borders that fluid crosses to operators and conditions.
  void use_borders();
  void make_border_traces();
  void apply_boundary_at_borders();
  void open_conditions();
  [[noreturn]] void refuse_density_at_border() const;
  /// Makes the unknown flux through leaky sides, where there are any.
  void open_leaky_sides(const ComponentContext& context);
  /// The pressure at leaky sides, Pa, one a face of the mesh.
  LinearExpression side_pressure() const;
  /// Adds to the balances of cells the change that the equations of linear leaky sides ask for (LeakySides). It
  /// vanishes when these hold, and gives the balances the resistance of the sides, as a prescribed pressure does.
  void assemble_leak(Assembly& assembly, BalanceRows& fluid, double dt) const;
  void correct_leak(Vector& fluxes) const;  ///< adds the same to fluxes, m^2/s, as it has been counted
  Vector leaking() const;                   ///< the size of what leaks out of or into each cell, m^2/s
  void use_storage();
  void find_history(const ComponentContext& context);  ///< the memory of formulas, after all of them
  /// For a porosity or a storage by a formula (stored_by_state.cpp). Throws InputError for what the formula excludes.
  void find_pores(const ComponentContext& context);
  bool stores_by_state() const { return content_ != nullptr; }
  void take_pores(const StepTime& step);  ///< at the present state; throws StateError
  Vector density_ratio() const;           ///< of the fluid, to that at its initial pressure
  Vector content_now() const;             ///< content of the pores at the present state, as content_
  Vector stored_by_state() const;         ///< m^2, what each cell has stored in this step
  void assemble_stored_by_state(Assembly& assembly, BalanceRows& fluid) const;
  void count_content();
  std::vector<StateOfCells*> states() const;  ///< of all formulas
  /// Of the unknowns on faces: start values from the pressures of cells, the matrices, the equations.
  void start_face_pressure();
  void use_face_operators();
  void assemble_face_pressure(Assembly& assembly, const StepTime& step) const;
  /// Takes the matrices of limited fluxes from the operators.
  void use_limited();
  /// `wall_flux`, `side_outflow`: m/s, empty without; `excess`: of the density over the constant one, kg/m^3; empty if
  /// the density is constant.
  void add_limited(Flow& flow, const Vector& potential, const Vector& wall_flux, const Vector& side_outflow,
                   const Vector& excess) const;
  void round_limited(double rounding);
  static SparseMatrix limited_derivative(const Flow& flow, const SparseMatrix& first, const SparseMatrix& second);
  void assemble_limited(Assembly& assembly, const Flow& flow, double dt) const;
  /// Terms of a density that varies: its values in this step, and the derivatives of balances and of the equations on
  /// faces.
  void use_density();
  /// Notes steps in which heavy fluid stays above light fluid because backward Euler damps an instability.
  void note_heavy_above(Notes& notes, const StepTime& step) const;
  void assemble_density(Assembly& assembly, const Flow& flow, double dt) const;
  void assemble_density_on_faces(Assembly& assembly, double dt) const;
  /// Derivatives of the fluxes through faces, faces × values of a field.
  std::vector<std::pair<const Field*, SparseMatrix>> fluxes_by_density(const Flow& flow) const;
  /// Whether operators can be taken over from another mesh or mobility (rediscretize).
  bool keeps_operators() const { return !face_pressure_ && !is_limited_ && inside_.empty(); }
  bool is_discretized() const;  ///< on this mesh, with this mobility
  bool depends_on_time() const;
  void evaluate_sources(const StepTime& step);
  void apply_boundary();

  const Mesh& mesh_;
  Options options_;
  Origin origin_;
  Discretize discretize_;
  Field& pressure_;
  Field* wall_flux_ = nullptr;      ///< exists with fractures only
  Field* face_pressure_ = nullptr;  ///< exists with Unknowns::on_cells_and_faces only
  Field* side_outflow_ = nullptr;   ///< exists with leaky sides only
  Field& cumulative_;               ///< (stored, injected, outflow) of each cell since the start, m^2
  std::vector<char> inside_;       ///< one flag a cell: whether there is a flow; empty where there is a flow everywhere
  std::optional<Mesh> separated_;  ///< the mesh cut around these cells
  std::vector<OpenBorder> borders_;          ///< leaky sides count as one
  std::unique_ptr<LeakySides> leaky_sides_;  ///< nullptr without
  BorderTraces border_traces_;
  bool shares_cells_ = false;
  std::vector<char> open_faces_;  ///< of all of them, one flag a face; empty for none
  Vector initial_pressure_, gravity_potential_cell_, gravity_potential_face_;
  std::array<Property, symmetric_components> permeability_;  ///< as symmetric_axes has them
  Property viscosity_, porosity_, compressibility_;
  Property storage_;                         ///< 1/Pa; of pores by a formula: the derivative of what they hold
  std::unique_ptr<FormulaOfCells> pores_;    ///< nullptr where the porosity does not follow the state
  std::unique_ptr<StorageFormula> stores_;   ///< nullptr where the storage does not follow the state
  Field* content_ = nullptr;                 ///< with one of these only: the fluid that the rock holds, m^2
  Vector uncounted_;                         ///< on a changed mesh: the part of this that a later solve counts
  std::unique_ptr<HistoryOfCells> history_;  ///< nullptr where nothing is remembered
  std::unique_ptr<FormulaOfCells>
      by_state_;  ///< the diagonal; nullptr where the permeability does not follow the state
  DifferentiateFluxes differentiate_;
  std::uint64_t viscosity_of_mobility_ = 0;  ///< version, with by_state_
  /// Derivatives of fluxes and traces by a field, where the permeability follows it: faces × values of the field.
  struct ByState {
    const Field* field;
    SparseMatrix flux, trace;
  };
  bool is_first_attempt_ = true, takes_derivatives_ = true;
  std::vector<Tensor> observed_mobility_;  ///< at the last iterate; empty before the first
  std::vector<Tensor> held_mobility_;      ///< c_0 of release_coefficients; empty where it is not held
  double released_share_ = 1;              ///< with it
  std::vector<ByState> linearized_;  ///< about the state of the last assembly; empty where it needed no derivatives
  LinearExpression wall_pressure_by_state_;  ///< wall_pressure_, linearized about the same state
  LinearExpression wall_pressure_before_;    ///< the one before, to which another assembly of the same state may refer
  Vector rock_storage_;                      ///< see accept_rock_storage; empty if no coupler has told it
  bool properties_change_ = false;
  bool viscosity_is_given_ = false;            ///< by a coupler
  std::vector<Tensor> mobility_;               ///< m^2/(Pa s), one a cell
  std::vector<Tensor> mobility_of_operators_;  ///< of operators_; only if properties change, in one process
  std::uint64_t mobility_version_ = 0;
  const Fluxes kind_of_fluxes_;
  const bool is_limited_;
  bool is_sealed_ = false;  ///< the mobility is zero: no flux exists, and none is discretized

  std::uint64_t discretized_mesh_ = 0, discretized_mobility_ = 0, capacity_version_ = 0;
  bool data_evaluated_ = false, boundary_applied_ = false;
  StepTime evaluated_for_;
  long discretizations_ = 0, discretized_cells_ = 0, discretized_regions_ = 0;
  FluxOperators operators_;
  std::vector<FlowCondition> conditions_;
  std::vector<std::pair<int, int>> outer_faces_;                           ///< faces on the sides, with their cells
  std::map<std::string, std::vector<std::pair<int, double>>> well_cells_;  ///< cells and weights by well
  Vector capacity_;                                                        ///< storage times area, m^2/Pa
  Operator capacity_of_pressure_;                                          ///< the same as a diagonal
  Operator outflow_of_pressure_;       ///< cells × cells: sum of fluxes out of each cell, an exchange
  Operator outflow_of_face_pressure_;  ///< cells × faces, an exchange
  double largest_conductance_ = 0;     ///< largest sum of absolute entries of a row of both, m^2/(Pa s)
  /// The equations of the face pressures: faces × cells, faces × faces, faces × walls.
  Operator continuity_of_pressure_, continuity_of_face_pressure_, continuity_of_wall_flux_;
  Vector continuity_constant_;           ///< m^2/s, one a face: from boundary values and gravity
  double largest_face_conductance_ = 0;  ///< largest sum of absolute entries of one of these rows, m^2/(Pa s)
  SparseMatrix boundary_of_wall_flux_;   ///< faces × walls: the boundary value that is the flux through a wall
  SparseMatrix flux_of_wall_flux_;       ///< faces × walls
  Operator outflow_of_wall_flux_;        ///< cells × walls, an exchange
  Vector boundary_values_;               ///< one a face, see FluxOperators
  Vector boundary_changes_;              ///< of the prescribed pressures, one a face, see FluxOperators
  Vector boundary_fluxes_;               ///< the flux through each face by boundary values alone, m^2/s
  std::array<SparseMatrix, 2> limited_of_wall_flux_;  ///< faces × walls, one for each side
  std::array<Vector, 2> limited_constant_;            ///< m^2/s, one a face: from boundary values
  double rounding_ = 0, rounding_at_first_ = 0;       ///< m^2/s, see `limit`; 0 but in last attempts of Newton's method
  mutable double largest_limited_ = 0;                ///< m^2/s, of both sides, at the flow that was found last
  LinearExpression wall_pressure_;
  Vector source_;                     ///< m^2/s, one a cell
  std::vector<FluidSource> sources_;  ///< the same by name

  enum class State { accepted, now };
  const Flow& flow(State state) const;
  void forget_flow();
  /// The flux through each face, m^2/s, of the last solve in this step (of the last substep or stage). It is kept,
  /// since with data of the whole step (a viscosity that follows the temperature at its start) the same pressures would
  /// give fluxes that do not balance.
  const Vector& fluxes_of_step() const { return solved_fluxes_.size() > 0 ? solved_fluxes_ : face_fluxes(); }
  Vector solved_fluxes_;  ///< empty where the flow was not solved in this step
  /// A step uses the flow at the accepted and at the current state several times.
  mutable std::array<Flow, 2> flows_;
  mutable std::uint64_t flow_uses_ = 0;
  struct WithWalls {
    std::uint64_t pressure = 0, face_pressure = 0, wall_flux = 0;  ///< versions of the fields
    std::vector<std::uint64_t> borders = {};                       ///< the same
    FluidDensity::Version density = {};                            ///< the same
    Vector fluxes = {};                                            ///< empty for none
  };
  mutable WithWalls with_walls_;
  /// Derivatives of limited fluxes at the last state for which face_flux_derivatives was called.
  mutable SparseMatrix limited_by_pressure_, limited_by_wall_flux_, limited_by_side_outflow_;

  std::unique_ptr<Buoyancy> buoyancy_;                            ///< nullptr for a constant density
  std::uint64_t operators_made_ = 0, operators_of_buoyancy_ = 0;  ///< how often operators and buoyancy were made
  mutable LinearExpression wall_pressure_by_density_;             ///< wall_pressure_ and what the density adds
  /// Versions of the densities for which that expression was made.
  mutable std::array<FluidDensity::Version, 2> versions_at_walls_;
  mutable std::vector<std::pair<const Field*, SparseMatrix>> fluxes_by_density_;  ///< of face_flux_derivatives
};

}  // namespace sprekk::matrix_flow
