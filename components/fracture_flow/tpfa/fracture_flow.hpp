// Flow in fractures (Eq. 8 of the paper) by the two-point flux approximation along piecewise linear fractures.
#pragma once

#include <array>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "components/capabilities/bore_holes.hpp"
#include "components/capabilities/fluid_density.hpp"
#include "components/capabilities/fluid_fluxes.hpp"
#include "components/capabilities/fracture_fluid.hpp"
#include "components/capabilities/matrix_fluid.hpp"
#include "components/fracture_flow/laws/formula_law.hpp"
#include "components/fracture_flow/tpfa/junction_fluxes.hpp"
#include "components/fracture_flow/tpfa/mean_along.hpp"
#include "components/fracture_flow/tpfa/mimetic_drops.hpp"
#include "components/fracture_flow/tpfa/options.hpp"
#include "components/fracture_flow/tpfa/outflows.hpp"
#include "components/fracture_flow/tpfa/stored_fluid.hpp"
#include "framework/assembly/follows_mesh.hpp"
#include "framework/assembly/heeds_stages.hpp"
#include "framework/assembly/keeps_state.hpp"
#include "framework/assembly/keeps_totals.hpp"
#include "framework/assembly/lives_in_part.hpp"
#include "framework/assembly/may_store_nothing.hpp"
#include "framework/assembly/notes_start.hpp"
#include "framework/assembly/piecewise_smooth.hpp"
#include "framework/assembly/property.hpp"
#include "framework/assembly/state_fields.hpp"
#include "framework/scene/component.hpp"

namespace sprekk::fracture_flow {

/// Unknowns: the pressure p of every fracture cell, and the flux Q through every ridge between them, from its first to
/// its second cell (m^2/s, in space m^3/s). Each row of p balances the volume of fluid of one cell over the step (m^2;
/// in space m^3, with the area of the cell for L):
///   L (rho a − rho_old a_old)/rho_mean + dt (sum of Q out of it) − dt q = 0,
/// the first term being the change of mass over the mean density of the step (stored_fluid.hpp; with `cavitation`, a
/// part of a is empty, cavitation.cpp). Each row of Q is Q = C (p_first − p_second), with C from the resistances of the
/// half cells in series (half_cell_apertures.hpp); with inertia, Q (1 + C I |Q|) takes the place of Q. Since Q is an
/// unknown, it is not computed from a difference of nearly equal pressures, so no digits are lost in a fracture that
/// conducts 1e12 times better than rock; and the flux out of one cell enters the next one to the bit. Properties are
/// those at the end of the step. Comments of members give the units of rates and volumes in a plane.
///
/// Where the transmissivity is a formula of the state, the hydraulic aperture of a half cell depends on the aperture
/// there, and on the further variables of the formula in its cell. In derivatives `by_aperture` columns of these
/// variables follow those of the apertures: with n fracture cells, column n + k n + i is the k-th further variable in
/// cell i.
///
/// With Options::fractures there is a flow in these fractures only. In all others the row of p is p = 0, conductances
/// are zero, and walls are sealed.
class FractureFlow : public Component,
                     public PiecewiseSmooth,
                     public KeepsState,
                     public FollowsMesh,
                     public FractureFluid,
                     public FractureFluxes,
                     public BuoyantFractures,
                     public BoreHolesInFractures,
                     public HeedsStages,
                     public KeepsTotals,
                     public LivesInPart,
                     public MayStoreNothing,
                     public NotesStart,
                     public TakesState {
 public:
  /// Throws InputError for a scene without fractures, and for fractures, sides and places that do not exist.
  FractureFlow(const ComponentContext& context, const Options& options);

  /// New cells of fractures that grow start with the pressure of their neighbours; a parameter says whether they
  /// contain fluid.
  void carry_over(const Part& before, const MeshChange& change) override;
  void settled(const MeshChange& change) override;
  void evaluate_data(const StepTime& step) override;
  /// Not with cavitation: a bound of the pressure that becomes active within a step makes every scheme of first order.
  bool allows_stages() const override { return !options_.cavitation; }
  void take_stages(bool are_stages) override {
    entering_density_ = are_stages ? EnteringDensity::at_end : EnteringDensity::of_step;
  }
  void begin_step(const StepTime& step) override;
  void assemble(Assembly& assembly, const StepTime& step) const override;
  void set_search_mode(SearchMode mode) override;
  void release_coefficients(double share) override;
  void constrain(Assembly& assembly) const override;
  void after_solve(const std::vector<Field*>& solved, const StepTime& step) override;
  void accepted() override { let_in_of_step_.clear(); }
  void rewound() override { let_in_of_step_.clear(); }
  void balance(std::map<std::string, Balance>& balances) const override;
  void begin_totals() override { cumulative_.set_both(Vector::Zero(cumulative_.size())); }
  std::vector<double> switch_times() const override;
  bool stores_nothing_somewhere() const override { return compressibility_.values().minCoeff() == 0; }
  void report(std::vector<Quantity>& quantities) const override;
  void output(std::vector<OutputField>& fields) const override;
  std::uint64_t discrete_state() const override;
  void note_input(Notes& notes) const override;
  void note_start(Notes& notes) const override;
  void note_step(Notes& notes, const StepTime& step) const override;

  Field& pressure() override { return pressure_; }
  Field& aperture() override { return aperture_; }
  const Vector& initial_aperture() const override { return initial_aperture_; }
  double least_aperture() const override;
  NormalPermeability normal_permeability() const override;
  void change_viscosity(const Vector& viscosity) override;
  double filled_part(int cell) const override;
  bool is_in_fracture_cell(int cell) const override { return wet_.empty() || wet_[cell]; }
  const std::vector<char>& inhabited_cells() const override { return wet_; }
  bool lives_on_fractures() const override { return true; }
  double viscosity_between_walls(int cell) const override { return options_.is_constant() ? 0 : viscosity_[cell]; }
  std::vector<std::pair<int, double>> shares_at(int cell, const Point& at) const override;
  Point point_at(int cell, const Point& at) const override;
  Rise rise_at(int cell, const Point& at) const override;
  double conductance(int cell) const override {
    return transmissivity(cell).value / (dimension == 2 ? mesh_.fracture_cells[cell].measure : 1);
  }
  bool follows_aperture() const override;
  const Field& flux() const override { return flux_; }
  std::vector<FluidSource> fluid_sources() const override;
  std::vector<FluidReservoir> fluid_reservoirs() const override;
  void accept_rock_fluid(MatrixFluid& rock_fluid, const MatrixWalls& walls) override {
    rock_fluid_ = &rock_fluid;
    rock_walls_ = &walls;
  }
  MatrixFluid* rock_fluid() const override { return rock_fluid_; }
  const MatrixWalls* rock_walls() const override { return rock_walls_; }
  bool has_gravity() const override { return !options_.gravity.is_zero(); }
  double weight_between(const Point& from, const Point& to) const override;
  bool density_varies() const override { return density_ != nullptr; }
  void accept_density(const FluidDensity& in_fractures) override { density_ = &in_fractures; }
  void offer_state(const std::string& variable, const StateField& source) override { state_.offer(variable, source); }
  void require_state() const override;

 private:
  /// Derivatives by the variables of a formula except the aperture.
  using ByState = ConductionState;
  /// The hydraulic aperture by the law, m.
  struct Hydraulic {
    double value, by_aperture;
    ByState by_state = {};
  };
  /// K/mu (m^2/(Pa s) times m, Eq. 8 of the paper) of a cell and its derivative by the aperture.
  struct Transmissivity {
    double value, by_aperture;
    ByState by_state = {};
  };
  using Derivatives = std::vector<std::pair<int, double>>;
  /// Appends `factor` times the derivatives by the variables of the formula in a cell, without the aperture.
  void append_by_state(Derivatives& derivatives, int cell, double factor, const ByState& by_state) const;
  /// The number of columns of derivatives `by_aperture`, divided by the number of cells.
  Eigen::Index kinds_of_columns() const { return 1 + std::ssize(named_); }
  /// Zero derivatives `by_aperture` for the cells of a junction.
  Vector no_derivatives(const Junction& junction) const {
    return Vector::Zero(kinds_of_columns() * std::ssize(junction.cells));
  }
  void prepare_formula(FieldStore& fields);
  History::StateAt state_remembered() const;
  ConductionState state_in(int cell) const;  ///< the aperture is not set
  Transmissivity transmissivity(int cell) const;
  /// The same for the half of the cell at one of its ridges.
  Transmissivity transmissivity(int cell, int ridge) const;
  Transmissivity cubic_law(int cell) const;
  bool is_held() const { return held_aperture_.size() > 0; }
  /// The hydraulic aperture by the law, from the present aperture and the held one, if any, with its derivative by the
  /// present one.
  Hydraulic hydraulic_aperture(int cell, double present, double held) const;
  Hydraulic hydraulic_aperture(int cell) const;
  Hydraulic hydraulic_by_law(int cell, ConductionState state) const;
  /// A ridge through which fluid can flow.
  struct Link {
    int ridge;
    int first, second;             ///< cells; second is none at an open end with a prescribed pressure
    int junction;                  ///< index into Mesh::junctions where fractures meet, else none
    int place;                     ///< among the ridges of the junction
    double boundary_pressure = 0;  ///< Pa, of an open end, or beyond its resistance
    std::optional<double> end_conductance = std::nullopt;  ///< m/(Pa s), per area of an end; none: it does not resist
    bool only_out = false;                                 ///< at an end: nothing enters
    double gravity = 0;                                    ///< rho g·(x_first − x_second), Pa
    /// The contribution of the excess density to the difference of pressures: a factor for each cell (m^2/s^2), and a
    /// pressure (Pa) at an end.
    std::vector<std::pair<int, double>> by_density = {};
    double excess_at_end = 0;
  };
  void count_let_in(const Assembly& assembly) const;
  /// The rates at named places, and the outflow at sides with a pressure, at the end of the step.
  void report_rates(std::vector<Quantity>& quantities) const;
  /// The condition outside of a fracture's end; nullopt if the end is closed.
  std::optional<OutsideOfRock> outside_of_end(const Ridge& end, const Place& place, const StepTime& step) const;
  Conductance conductance(const Link& link) const;
  Conductance conductance_at_end(const Link& link) const;
  /// The conductance by the cubic law, from the apertures of the half cells.
  Conductance conductance_by_opening(const Link& link) const;
  /// The hydraulic aperture of a half cell, with the derivatives of its aperture by those of both cells at a ridge.
  struct HydraulicHalf {
    Hydraulic hydraulic;
    std::array<double, 2> by_aperture;
  };
  std::array<HydraulicHalf, 2> halves_by_opening(const Link& link) const;
  std::vector<JunctionFluxes> junction_fluxes() const;
  double half_length(int cell, int ridge) const;
  std::vector<JunctionFluxes::Half> given_halves(const Junction& junction) const;
  std::vector<JunctionFluxes::Half> halves_by_opening(const Junction& junction) const;
  /// Notes fractures that end on a side where the rock is open, if the scene says nothing about their ends.
  void note_ends(Notes& notes) const;
  /// Notes a pressure on a side that does not act on a fracture which ends on the border of the side, since this end
  /// belongs to the neighbouring side.
  void note_ends_on_two_sides(Notes& notes) const;
  /// Notes an initial fluid pressure that differs from that of the rock at the walls.
  void note_start_at_walls(Notes& notes) const;
  /// Notes a fracture that conducts through the tight walls of another at a crossing whose fill is not given.
  void note_crossings(Notes& notes) const;
  /// The normal permeability of each wall, where what fills crossings depends on it; else empty.
  Vector walls_of_crossings() const;
  /// Adds the resistance of the fill of the crossing to the halves.
  void pass_crossing(std::size_t junction, const Vector& walls, std::vector<JunctionFluxes::Half>& halves) const;
  /// K (m^3) of the half of a cell at one of its ridges, where the transmissivity is given.
  double given_transmissivity(int cell, int ridge) const;
  double pressure_drop(const Link& link) const;
  bool is_shut(const Link& link) const;  ///< an end with only_out, where fluid would enter
  /// The part of the pressure drop of a link that other fluxes cause, with derivatives by fluxes and apertures.
  struct FurtherDrop {
    double value = 0;  ///< Pa
    std::vector<std::pair<int, double>> by_flux, by_aperture;
  };
  FurtherDrop further_drop(const Link& link) const;
  struct FluxRows;
  /// Terms of a density that varies (varying_density.cpp).
  void weigh_links();
  void find_excess() const;
  double varying_weight(const Link& link) const;
  void assemble_density(Assembly& assembly, const FluxRows& rows) const;
  bool has_inertia() const { return !options_.law.inertia.is_zero(); }
  /// The flux per width in a cell, m^2/s, with its derivatives by fluxes: in a plane that at one of its ends, in space
  /// that of the whole cell.
  struct Speed {
    double value;
    std::vector<std::pair<int, double>> by_flux;
  };
  Speed speed(int cell, int ridge, const Vector& flux) const;
  /// The speed in the term of inertia: held, or released in part.
  Speed speed(int cell, int ridge) const;
  Hydraulic aperture_of_inertia(int cell, const Transmissivity& transmissivity) const;
  std::array<Conductance, 2> inertia(const Link& link) const;
  void add_inertia(const Link& link, const Conductance& conductance, FluxRows& rows) const;
  void slow_down(const Junction& junction, std::vector<JunctionFluxes::Half>& halves) const;
  void derive_by_state(Assembly& assembly, const std::vector<Triplet>& entries) const;
  void assemble_fluxes(Assembly& assembly, const StepTime& step) const;
  void add_row(const Link& link, const Conductance& conductance, FluxRows& rows) const;
  void add_row(const Link& link, const JunctionFluxes::Flux& flux, FluxRows& rows) const;
  void add_pattern(const Link& link, FluxRows& rows) const;
  double scale_of_row(const Link& link, double conductance, double dt) const;
  void check_names() const;
  /// Cavitation. Without it nothing is empty, and the following do nothing.
  void check_bound(double pressure, const Origin& where, const std::string& what) const;
  /// `stored_by_filled`: the derivative of what each cell stores by the part of its aperture with fluid.
  void bound_pressure(Assembly& assembly, const Vector& stored_by_filled) const;
  bool is_partly_empty(int cell) const;
  double filled_now(int cell) const { return aperture_.now()[cell] - (empty_ ? empty_->now()[cell] : 0); }  ///< m
  double filled_accepted(int cell) const {
    return aperture_.accepted()[cell] - (empty_ ? empty_->accepted()[cell] : 0);
  }
  StoredFluid stored_fluid(int cell) const;  ///< in this step, m
  std::vector<int> cells_of(const FracturePlace& where) const;
  /// The end of a cell that is nearer to a point, and how far the point is on the way from the centre to it. If no
  /// other cell meets this end the point counts as the centre. In a plane only.
  struct Spot {
    int end;        ///< a ridge
    double to_end;  ///< 0 to 1, up to the tolerance for equally near ends
  };
  Spot spot(int cell, const Point& at) const;
  /// From the centre of a cell to one of its ends, m^2/(Pa s), with derivatives by the apertures of cells.
  struct HalfCell {
    int cell;
    double conductance;
    std::vector<std::pair<int, double>> by_aperture;
    double own = 0;  ///< without the fill of a crossing
    std::vector<std::pair<int, double>> own_by_aperture = {};
  };
  std::vector<HalfCell> halves_at(int ridge, int home) const;
  bool is_alone(const Spot& spot, const std::vector<HalfCell>& halves, int home) const;
  static double part_before(const Spot& spot, const HalfCell& home);
  /// The cells of a whole fracture, and their shares, which add up to 1.
  std::vector<std::pair<int, double>> shares_by_length(const FracturePlace& where) const;
  /// A point at which fluid enters, or where a pressure is prescribed.
  struct OpenPoint {
    std::string name;
    int cell;
    Point at;
    double value;                                     ///< Pa where its pressure is prescribed, else the rate, m^2/s
    std::vector<std::pair<int, double>> shares = {};  ///< in this step
    double level = 0;                                 ///< Pa, of the point above the mean of these cells
    double bore = 0;                                  ///< in space, with a radius r: ln(r_e/r), r_e: equivalent_radius
  };
  /// By how much the pressure at the point exceeds the mean of its cells, for each unit of its rate.
  Rise rise_of(const OpenPoint& point) const;
  /// OpenPoint::bore. Throws InputError where the cells are too small, or at the rim of their fracture.
  double bore_at(const FracturePlace& where, int cell);
  double log_of_radii(int cell, const Point& at, double radius, const Origin& where) const override;
  Rise rise_at_bore(int cell, double log_of_radii) const override;
  void share(OpenPoint& point, bool is_given_pressure) const;
  void share_points();
  /// shares_at() in the present state.
  std::vector<std::pair<int, double>> present_shares(int cell, const Point& at) const;
  std::vector<std::pair<int, double>> shares_of_conductors(int cell, const Point& at) const;
  double pressure_at(const OpenPoint& point, double rate) const;  ///< Pa
  void check_points_apart() const;
  void assemble_prescribed_points(Assembly& assembly, const StepTime& step) const;
  std::vector<const Data*> properties() const;
  void make_links(const StepTime& step);
  void find_prescribed_cells();
  void prescribe(const StepTime& step);

  const Mesh& mesh_;
  MatrixFluid* rock_fluid_ = nullptr;
  const MatrixWalls* rock_walls_ = nullptr;
  const FluidDensity* density_ = nullptr;  ///< nullptr for a constant one
  mutable Vector excess_;                  ///< kg/m^3, density of each cell minus the constant one
  Options options_;
  Origin origin_;
  Field& pressure_;
  Field& flux_;
  Field& aperture_;
  Field* let_in_at_points_ = nullptr;  ///< m^2/s, at each of prescribed_points_; only with such points
  Field* empty_ = nullptr;             ///< m, the part of the aperture without fluid; only with cavitation
  double bound_scale_ = 1;             ///< m/Pa, between e and p − p_c
  Field& cumulative_;                  ///< (stored, injected, outflow) of each cell since the start, m^2
  std::vector<char> wet_;  ///< one flag a cell: whether there is a flow; empty where there is a flow everywhere
  Vector initial_aperture_;
  std::unique_ptr<HydraulicLaw> law_;
  std::unique_ptr<History> history_;         ///< nullptr where nothing is remembered
  std::optional<StateFormula> formula_;      ///< of the transmissivity, instead of the law
  double lowest_ = 0;                        ///< m, of the hydraulic aperture by a formula
  StateFields state_;                        ///< what the formula may name
  std::vector<std::size_t> named_;           ///< variables that it names, without the aperture
  std::vector<ConductionState> held_state_;  ///< of each cell, where apertures are held
  Vector held_aperture_;                     ///< for the cubic law, or empty for the present one
  Vector held_flux_;                         ///< m^2/s, the flux that inertia is computed with; empty: the current flux
  double released_share_ = 0;  ///< share of the change from the held to the present apertures that the cubic law takes
  Property viscosity_, compressibility_;
  bool viscosity_is_given_ = false;  ///< by a coupler
  Property inertia_;                 ///< 1/m, one a cell; without values where there is none
  MeansAlong given_transmissivity_, given_normal_permeability_;  ///< m^3, m/(Pa s), one a cell
  std::vector<MeansAlong> transmissivity_of_part_;               ///< m^3, by place in FractureCell::ridges
  std::array<MeansAlong, 2> given_wall_permeability_;            ///< by Wall, m/(Pa s), one a cell
  std::vector<CrossingFill> crossing_fills_;                     ///< of each junction
  std::vector<Link> links_;
  Outflows outflows_;

 protected:
  MimeticDrops drops_;  ///< of two-point fluxes none

 private:
  Vector source_;                     ///< m^2/s, one a cell
  std::vector<FluidSource> sources_;  ///< the same by name, in the order of Options::injections
  struct Prescribed {
    int cell;
    double pressure, scale;
  };
  std::vector<Prescribed> prescribed_;  ///< whole fractures
  std::vector<OpenPoint> injected_points_, prescribed_points_;
  std::map<const FracturePlace*, double> bores_;  ///< OpenPoint::bore, which depends on the mesh alone
  mutable std::vector<double> let_in_;            ///< m^2/s, at each of prescribed_; set when rows are replaced
  std::vector<double> let_in_of_step_;            ///< the same at the last solve in this step (or substep)
  double step_length_ = 0;                        ///< s
  EnteringDensity entering_density_ = EnteringDensity::of_step;
  std::vector<char> is_prescribed_;  ///< of each cell
};

}  // namespace sprekk::fracture_flow
