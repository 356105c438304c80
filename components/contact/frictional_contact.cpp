// The unknowns of the contact, and how Newton's method finds its way among the states of the cells.
#include "components/contact/frictional_contact.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <memory>
#include <utility>

#include "components/contact/cell_equations.hpp"
#include "components/contact/fields.hpp"
#include "components/contact/jump_on_changed_mesh.hpp"
#include "components/contact/laws/closure.hpp"
#include "components/contact/note_jumps.hpp"
#include "components/contact/options.hpp"
#include "components/contact/places_of_parameters.hpp"
#include "components/contact/rate_and_state_walls.hpp"
#include "components/contact/shear_load.hpp"
#include "components/contact/trial_state.hpp"
#include "framework/invariants.hpp"
#include "framework/mesh/mesh_change.hpp"
#include "framework/mesh/planar.hpp"
#include "framework/scene/fracture_set.hpp"

namespace sprekk::contact {

FrictionalContact::FrictionalContact(const ComponentContext& context, const Options& options, Multiplier multiplier,
                                     double stiffness_factor)
    : Component(context.name),
      mesh_(context.mesh),
      origin_(context.origin),
      traction_(add_traction(context, options.depends_on_rate ? Friction::of_rate : Friction::of_path)),
      jump_(add_jump(context, options.depends_on_rate ? Friction::of_rate : Friction::of_path)),
      options_(std::make_unique<Options>(options)),
      here_(fracture_set(mesh_, options.fractures, options.fractures_origin)),
      dilation_limit_(options.dilation_limit),
      weakening_(options.weakening),
      multiplier_(multiplier),
      stiffness_factor_(stiffness_factor),
      closure_(options.closure.build()) {
  const int count = mesh_.fracture_cell_count();
  if (count == 0)
    throw InputError(context.origin, "component '" + context.name + "' has nothing to do", "the scene has no fractures",
                     "add fractures to `geometry:` or remove the component");
  const std::vector<Place> places = places_of_parameters(mesh_, here_);
  if (weakening_.is_on()) path_ = &add_path(context);
  friction_ = Property(options_->friction, places, context.start_time);
  dilation_angle_ = Property(options_->dilation_angle, places, context.start_time);
  if (options_->dynamic_friction) dynamic_friction_ = Property(*options_->dynamic_friction, places, context.start_time);
  if (options.depends_on_rate)
    rate_and_state_ = std::make_unique<RateAndStateWalls>(context, options.rate_and_state, friction_, here_);
  dilation_ = dilation_angle_.values().unaryExpr([](double psi) { return std::tan(psi); });
  stiffness_of_walls_ = stiffness_of_fractures_ = Vector::Ones(dimension * count);
  fracture_measure_.assign(mesh_.fractures.size(), 0);
  for (const FractureCell& cell : mesh_.fracture_cells) fracture_measure_[cell.fracture] += cell.measure;
}

FrictionalContact::~FrictionalContact() = default;

double FrictionalContact::closure(double normal_traction) const {
  return closure_ ? closure_->at(-normal_traction).closure : 0.0;
}

double FrictionalContact::closure_by_traction(double normal_traction) const {
  return closure_ ? -closure_->at(-normal_traction).by_pressure : 0.0;
}

double FrictionalContact::opening_under(int cell, double normal_traction) const {
  // A fracture that grows has no walls before that could have closed.
  return mesh_.fracture_cells[cell].grown ? 0.0 : -closure(normal_traction);
}

void FrictionalContact::evaluate_data(const StepTime& step) {
  friction_.evaluate(step);
  if (rate_and_state_ && friction_.depends_on_time()) rate_and_state_->evaluate_data(friction_);
  if (options_->dynamic_friction) dynamic_friction_.evaluate(step);
  if (!dilation_angle_.depends_on_time()) return;
  dilation_angle_.evaluate(step);
  dilation_ = dilation_angle_.values().unaryExpr([](double psi) { return std::tan(psi); });
}

void FrictionalContact::begin_step(const StepTime& step) {
  if (rate_and_state_) rate_and_state_->begin_step(step);
  back_slip_.clear();
  kept_.clear();
}

void FrictionalContact::set_search_mode(SearchMode mode) {
  is_without_shortcuts_ = mode != SearchMode::with_shortcuts;
  follows_pieces_ = is_without_shortcuts_ && mode != SearchMode::without_shortcuts;
}

std::vector<double> FrictionalContact::switch_times() const {
  std::vector<const Data*> data{&options_->friction, &options_->dilation_angle};
  if (options_->dynamic_friction) data.push_back(&*options_->dynamic_friction);
  return merged_switch_times(data);
}

void FrictionalContact::set_wall_stiffness(const Vector& stiffness) {
  stiffness_of_walls_ = stiffness;
  stiffness_of_fractures_ = stiffness_of_walls_;
  for (int i = 0; i < mesh_.fracture_cell_count(); ++i) {
    const FractureCell& cell = mesh_.fracture_cells[i];
    stiffness_of_fractures_.segment<dimension - 1>(dimension * i + 1) *=
        cell.measure / fracture_measure_[cell.fracture];
    constexpr double at_most = 0.5;  // times the tangential stiffness over mu_s tan psi
    const double wedge = std::max(friction_[i] * dilation_[i], std::numeric_limits<double>::min());
    for (Vector* c : {&stiffness_of_walls_, &stiffness_of_fractures_}) {
      // The same stiffness for all tangents: the return to the cone then does not depend on the directions of the
      // tangents.
      auto tangential = c->segment<dimension - 1>(dimension * i + 1);
      const double least = tangential.minCoeff();
      tangential.setConstant(least);
      (*c)[dimension * i] = std::min((*c)[dimension * i], at_most * least / wedge);
    }
  }
}

void FrictionalContact::carry_over(const Part& part, const MeshChange& change) {
  SPREKK_EXPECT(static_cast<int>(change.fracture_cell.size()) == mesh_.fracture_cell_count(),
                change.fracture_cell.size());
  const auto& before = dynamic_cast<const FrictionalContact&>(part);
  const Vector covered = covered_parts(change, mesh_);
  // Where a new cell covers no old one, it begins closed and without slip, and the old cells are not held. With
  // friction of rate and state, slip takes time, so cells keep their slip.
  const bool holds_all = rate_and_state_ || (covered.size() > 0 && covered.minCoeff() > 0);
  if (rate_and_state_) rate_and_state_->carry_over(*before.rate_and_state_);
  bonded_.resize(change.fracture_cell.size());
  for (std::size_t i = 0; i < bonded_.size(); ++i) bonded_[i] = holds_all || change.fracture_cell[i] == none;
  Vector jump = jump_on_changed_mesh(change, {mesh_, jump_.accepted()}, {before.mesh_, before.jump_.accepted()});
  bonded_jump_ = jump;
  jump_.set_both(std::move(jump));
  if (change.is_at_rest) carried_traction_ = traction_.accepted();
}

void FrictionalContact::settled(const MeshChange& change) {
  if (change.is_at_rest) traction_.set_both(std::exchange(carried_traction_, {}));
  bonded_.clear();
  bonded_jump_.resize(0);
}

void FrictionalContact::after_solve(const std::vector<Field*>& solved, const StepTime&) {
  if (std::find(solved.begin(), solved.end(), &traction_) == solved.end()) return;
  if (rate_and_state_ && bonded_.empty()) {
    constexpr int tangents = dimension - 1;
    Vector rates(tangents * mesh_.fracture_cell_count());
    for (int i = 0; i < mesh_.fracture_cell_count(); ++i)
      if (is_on_fracture_cell(i))
        rates.segment<tangents>(tangents * i) = trial(i).at_rate.value().slip_rate;
      else
        rates.segment<tangents>(tangents * i).setZero();
    rate_and_state_->set_slip_rates(std::move(rates));
  }
  if (!path_) return;
  Vector paths = Vector::Zero(mesh_.fracture_cell_count());
  for (int i = 0; i < paths.size(); ++i)
    if (is_on_fracture_cell(i)) paths[i] = path(i, gap(i, traction_.now(), jump_.now()));
  path_->set(std::move(paths));
}

void FrictionalContact::observe_iterate(const std::vector<Field*>& unknowns) {
  is_solved_for_ = std::find(unknowns.begin(), unknowns.end(), &traction_) != unknowns.end();
  if (follows_pieces_ || !is_solved_for_) return;
  const std::array<std::uint64_t, 2> values{traction_.version(), jump_.version()};
  if (!back_slip_.empty() && values == followed_) return;  // this update has been considered already
  followed_ = values;
  back_slip_.resize(mesh_.fracture_cell_count());
  for (int i = 0; i < mesh_.fracture_cell_count(); ++i) {
    if (!is_on_fracture_cell(i)) continue;
    BackSlip& cell = back_slip_[i];
    const Trial t = trial(i);
    SPREKK_ASSERT(is_index(i, static_cast<long>(back_slip_.size())), i, back_slip_.size());
    TangentialVector direction = TangentialVector::Zero();
    if (t.state() == State::slip) direction = direction_of<dimension - 1>(t.tangential);
    const bool slides_back = dilation_[i] > 0 && t.slides_back();
    if (cell.taken == BackSlip::Piece::before_kink && direction.dot(cell.direction) <= 0) {
      const TangentialVector slip = tangential(jump_.now(), i) - tangential(jump_.accepted(), i);
      cell.is_beyond = cell.is_beyond || slip.dot(cell.direction) < 0;
    } else if (cell.taken == BackSlip::Piece::beyond_kink && slides_back) {
      cell.is_beyond = false;  // the kink was not reached, or no solution lies beyond it
    }
    cell.taken = !slides_back     ? BackSlip::Piece::none
                 : cell.is_beyond ? BackSlip::Piece::beyond_kink
                                  : BackSlip::Piece::before_kink;
    cell.direction = direction;
  }
}

State FrictionalContact::state(int i) const {
  const State state = trial(i).state();
  return rate_and_state_ && state == State::stick && rate_and_state_->slips(i) ? State::slip : state;
}

namespace {

/// Whether slip has the positive one of the two directions in a plane. In space the direction changes without a kink,
/// and all directions are one piece.
bool is_forward(const TangentialVector& vector) { return dimension == 2 && vector[0] > 0; }

}  // namespace

int FrictionalContact::piece(int i) const {
  if (!is_on_fracture_cell(i)) return 0;
  const Trial t = trial(i);
  const State now = t.state();
  const bool knows_direction = now == State::slip && (friction_[i] > 0 || weakening_.cohesion > 0);
  const int piece = 2 * static_cast<int>(now) + (knows_direction && is_forward(t.tangential));
  if (!follows_pieces_) return piece;
  if (is_bonded(i)) return 0;
  const bool has_kink = dilation_[i] > 0 && now != State::open;
  const bool is_worn = has_kink && t.dilation == 0;
  const int kink = 3 * piece + (is_worn ? 2 : has_kink && is_forward(t.slip_direction));
  if (!path_ || now == State::stick) return kink;
  // What is left of the strength depends on the size of the slip in the step, and ends where all is lost.
  const bool is_spent = path(i, gap(i, traction_.now(), jump_.now())) >= weakening_.distance;
  return 3 * kink + (is_spent ? 2 : is_forward(t.path_by_slip));
}

/// Opens all cells by a very small amount. The amount makes no difference, since the conditions of open cells are
/// linear.
void FrictionalContact::deactivate_conditions() {
  constexpr double opening = 1e-9;  // of the length of a cell
  Vector traction = traction_.now(), jump = jump_.now();
  for (int i = 0; i < mesh_.fracture_cell_count(); ++i) {
    if (is_bonded(i) || !is_on_fracture_cell(i)) continue;
    traction.segment<dimension>(dimension * i).setZero();
    const double least = dilated(i, magnitude<dimension - 1>(tangential(jump, i))) - closure(0);
    jump[dimension * i] = std::max(jump[dimension * i], least + opening * mesh_.fracture_cells[i].measure);
  }
  traction_.set(std::move(traction));
  jump_.set(std::move(jump));
}

int FrictionalContact::keep_states() {
  constexpr double least = 1e-6;  // of the largest jump; smaller jumps are round-off
  if (!is_solved_for_ || rate_and_state_) return 0;
  kept_.assign(mesh_.fracture_cell_count(), 0);
  int count = 0;
  for (int i = 0; i < mesh_.fracture_cell_count(); ++i) {
    if (!is_on_fracture_cell(i)) continue;
    const TangentialVector before = tangential(jump_.accepted(), i), slip = tangential(jump_.now(), i) - before;
    const bool slides_back = dilation_[i] > 0 && friction_[i] > 0 && slip.dot(before) < 0;
    if (is_bonded(i) || !slides_back || magnitude<dimension - 1>(slip) < least * jump_.now().lpNorm<Eigen::Infinity>())
      continue;
    if (state(i) == State::open || traction_.accepted()[dimension * i] >= 0) continue;
    kept_[i] = 1;
    ++count;
  }
  if (count == 0) kept_.clear();
  return count;
}

int FrictionalContact::release_violated() {
  int count = 0;
  const std::vector<char> kept = std::exchange(kept_, {});
  std::vector<char> rest = kept;
  for (std::size_t i = 0; i < kept.size(); ++i) {
    if (!kept[i] || state(static_cast<int>(i)) == State::stick) continue;
    rest[i] = 0;
    ++count;
  }
  kept_ = std::move(rest);
  return count;
}

std::uint64_t FrictionalContact::discrete_state() const {
  std::uint64_t hash = 0;
  for (int i = 0; i < mesh_.fracture_cell_count(); ++i) hash = hash * 1000003 + piece(i);
  return hash;
}

void FrictionalContact::assemble(Assembly& assembly, const StepTime&) const {
  if (!assembly.has_row(traction_)) return;
  const int count = mesh_.fracture_cell_count();
  const bool guesses = assembly.wants_derivatives() && !follows_pieces_;
  Vector residual(dimension * count);
  SPREKK_ASSERT(residual.size() == traction_.size(), residual.size(), traction_.size());
  CellBlocks by_traction, by_jump;
  for (int i = 0; i < count; ++i) {
    const int row = dimension * i;
    CellEquations cell;
    if (!is_on_fracture_cell(i)) {
      cell.residual = traction_.now().segment<dimension>(row).cwiseQuotient(stiffness().segment<dimension>(row));
      cell.by_traction.diagonal() = stiffness().segment<dimension>(row).cwiseInverse();
    } else if (is_bonded(i)) {
      cell.residual = bonded_jump_.segment<dimension>(row) - jump_.now().segment<dimension>(row);
      cell.by_jump.diagonal().setConstant(-1);
    } else {
      const Point springs = compliance(i);
      cell = equations_of(guesses ? trial_of_update(i) : trial(i), traction_.now().segment<dimension>(row),
                          {stiffness()[row], stiffness()[row + 1], springs[0], springs[1], path_ != nullptr});
    }
    residual.segment<dimension>(row) = cell.residual;
    by_traction.push_back(cell.by_traction);
    by_jump.push_back(cell.by_jump);
  }
  assembly.add(traction_, residual);
  // The residual is compared with the jumps, or, where all cells stick, with the jumps that the tractions would make.
  assembly.compare_with(traction_, traction_.now().cwiseQuotient(stiffness()).lpNorm<Eigen::Infinity>());
  assembly.compare_with(traction_, jump_.now().lpNorm<Eigen::Infinity>());
  if (!assembly.wants_derivatives()) return;
  assembly.derivative(traction_, traction_, block_diagonal(by_traction, Pattern::normal_by_normal));
  assembly.derivative(traction_, jump_, block_diagonal(by_jump, Pattern::full));
}

void FrictionalContact::report(std::vector<Quantity>& quantities) const {
  int counts[3] = {0, 0, 0};
  for (int i = 0; i < mesh_.fracture_cell_count(); ++i)
    if (is_on_fracture_cell(i)) ++counts[static_cast<int>(state(i))];
  quantities.push_back({name() + ".cells_stick", "1", static_cast<double>(counts[0])});
  quantities.push_back({name() + ".cells_slip", "1", static_cast<double>(counts[1])});
  quantities.push_back({name() + ".cells_open", "1", static_cast<double>(counts[2])});
  if (rate_and_state_) rate_and_state_->report(name(), slips(), quantities);
}

void FrictionalContact::output(std::vector<OutputField>& fields) const {
  Vector states(mesh_.fracture_cell_count());
  const bool is_at_start = traction_.now().isZero(0) && jump_.now().isZero(0);  // walls touch, and carry nothing yet
  for (int i = 0; i < states.size(); ++i) states[i] = is_at_start ? 0.0 : static_cast<double>(state(i));
  fields.push_back({.name = name() + ".state_0_stick_1_slip_2_open",
                    .unit = "1",
                    .location = Location::fracture_cell,
                    .values = std::move(states),
                    .is_a_choice = true});
  Vector tendency(mesh_.fracture_cell_count()), used(mesh_.fracture_cell_count());
  for (int i = 0; i < tendency.size(); ++i) {
    const Trial t = trial(i);
    const bool has_parted = !is_at_start && t.state() == State::open;  // tractions are round-off then
    const ShearLoad load = shear_load(traction_.now().segment<dimension>(dimension * i), t.strength, has_parted);
    tendency[i] = load.slip_tendency;
    used[i] = load.friction_used;
  }
  fields.push_back({name() + ".slip_tendency", "1", Location::fracture_cell, 1, std::move(tendency)});
  fields.push_back({name() + ".friction_used", "1", Location::fracture_cell, 1, std::move(used)});
  if (rate_and_state_) rate_and_state_->output(fields);
}

void FrictionalContact::require_countable() const {
  if (rate_and_state_)
    throw InputError(origin_, "the walls of '" + name() + "' have no state at rest",
                     "friction of rate and state lets them creep under any load",
                     "give the rock its stress by 'initial_stress', and remove 'settle'");
}

void FrictionalContact::count_from_here(const SettledFields& settled) {
  if (!settled.contain(jump_)) return;
  for (int i = 0; i < mesh_.fracture_cell_count(); ++i)
    slip_at_start_ = std::max(slip_at_start_, tangential(jump_.now(), i).norm());
}

void FrictionalContact::note_step(Notes& notes, const StepTime&) const {
  std::vector<char> is_open(mesh_.fracture_cell_count()), slides = is_open;
  for (int i = 0; i < mesh_.fracture_cell_count(); ++i) {
    is_open[i] = is_on_fracture_cell(i) && state(i) == State::open;
    slides[i] = is_on_fracture_cell(i) && state(i) == State::slip;
  }
  std::vector<double> springs;
  if (multiplier_ == Multiplier::none)
    for (int i = 0; i < mesh_.fracture_cell_count(); ++i)
      springs.push_back(is_on_fracture_cell(i) ? compliance(i)[1] : 0);
  note_jumps(notes, name(), mesh_, {traction_, jump_, is_open, slides, options_->large_jump, slip_at_start_, springs});
  if (rate_and_state_) rate_and_state_->note_step(name(), traction_.now(), slips(), notes);
}

std::string FrictionalContact::loss_of_one_stage() const {
  if (!rate_and_state_) return "";
  return "recurrence times and peak slip rates of '" + name() +
         "' are of first order in 'state_change' (0.6 % and 8 % too small in the cycle of a spring-slider at 0.1, "
         "against 5e-6 and 3e-4)";
}

void FrictionalContact::note_start(Notes& notes) const {
  int cells = 0, worst = none;
  double most = 0;
  for (int i = 0; i < mesh_.fracture_cell_count(); ++i) {
    constexpr double small = 1e-2;  // of the traction
    const double beyond = is_on_fracture_cell(i) ? excess(i) : 0;
    if (beyond <= small * traction_.now().segment<dimension>(dimension * i).norm()) continue;
    ++cells;
    if (beyond > most) {
      most = beyond;
      worst = i;
    }
  }
  if (cells == 0) return;
  constexpr double mega = 1e6;
  const Point traction = traction_.now().segment<dimension>(dimension * worst);
  const bool parts = traction[0] > 0;
  notes.add(name() + " out of balance at the start",
            fmt::format("{} cells of '{}' {} under the initial stress: at {} their traction is {:.3g} MPa across and "
                        "{:.3g} MPa along them, by {:.3g} MPa more than they hold (they move at once, in the first "
                        "step) let 'start: settle' find the equilibrium, or change the initial stress, the pressure or "
                        "the friction",
                        cells, name(), parts ? "part" : "slide", to_text(mesh_.fracture_cells[worst].center),
                        traction[0] / mega, traction.tail<dimension - 1>().norm() / mega, most / mega),
            most);
}

double FrictionalContact::excess(int i) const {
  const Strength strength = trial(i).strength;
  const Point traction = traction_.now().segment<dimension>(dimension * i);
  if (traction[0] > strength.tension) return traction[0] - strength.tension;
  if (rate_and_state_) return 0;  // such walls slide under any shear
  return traction.tail<dimension - 1>().norm() - strength.cohesion - strength.friction * std::max(0.0, -traction[0]);
}

void FrictionalContact::note_input(Notes& notes) const {
  if (rate_and_state_) rate_and_state_->note_input(name(), notes);
}

Vector FrictionalContact::slips() const {
  constexpr int tangents = dimension - 1;
  Vector slips(tangents * mesh_.fracture_cell_count());
  for (int i = 0; i < mesh_.fracture_cell_count(); ++i)
    slips.segment<tangents>(tangents * i) = tangential(jump_.now(), i);
  return slips;
}

void FrictionalContact::accepted() {
  if (rate_and_state_) rate_and_state_->accepted(slips());
}

void FrictionalContact::save(std::map<std::string, Vector>& state) const {
  if (rate_and_state_) rate_and_state_->save(name(), state);
}

void FrictionalContact::restore(const std::map<std::string, Vector>& state) {
  if (rate_and_state_) rate_and_state_->restore(name(), state);
}

double FrictionalContact::longest_step(double) const {
  return rate_and_state_ ? rate_and_state_->longest_step() : std::numeric_limits<double>::infinity();
}

std::optional<StepTooLong> FrictionalContact::too_long(const StepTime& step) const {
  if (!rate_and_state_) return std::nullopt;
  Vector slip = slips();
  constexpr int tangents = dimension - 1;
  for (int i = 0; i < mesh_.fracture_cell_count(); ++i)
    slip.segment<tangents>(tangents * i) -= tangential(jump_.accepted(), i);
  return rate_and_state_->too_long(slip, step);
}

void FrictionalContact::set_shear_modulus(const Vector& modulus) {
  SPREKK_EXPECT(modulus.size() == mesh_.fracture_cell_count(), modulus.size());
  if (rate_and_state_) rate_and_state_->set_shear_modulus(modulus);
}

std::unique_ptr<Component> frictional_contact(const ComponentContext& context, const Options& options,
                                              Multiplier multiplier, double stiffness_factor) {
  return std::make_unique<FrictionalContact>(context, options, multiplier, stiffness_factor);
}

}  // namespace sprekk::contact
