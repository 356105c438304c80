// The unknowns of the contact, their equations, and the data of these.
#include "components/contact/frictional_contact.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <memory>
#include <utility>

#include "components/contact/cell_equations.hpp"
#include "components/contact/fields.hpp"
#include "components/contact/laws/closure.hpp"
#include "components/contact/options.hpp"
#include "components/contact/places_of_parameters.hpp"
#include "components/contact/rate_and_state_walls.hpp"
#include "components/contact/tangents.hpp"
#include "components/contact/trial_state.hpp"
#include "framework/invariants.hpp"
#include "framework/mesh/geometry.hpp"
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
  history_ = History::find(options_->history, strength_variables(), places, here_);
  formulas_ = std::make_unique<Formulas>(
      LawData{options_->friction, options_->cohesion, options_->dilation, options_->closure.formula},
      options_->friction_law.build(), places, history_.get());
  if (formulas_->friction() && formulas_->friction_law())
    throw InputError(context.origin, "the friction of '" + context.name + "' is a formula, and changes by itself",
                     "'friction_law' says how a constant one changes", "remove one of the two");
  if (formulas_->friction() && (options.depends_on_rate || options.dynamic_friction))
    throw InputError(context.origin, "the friction of '" + context.name + "' is a formula, and changes by itself",
                     "'rate_and_state' and the friction of 'weakening' say how a constant one changes",
                     "remove one of the two");
  if (weakening_.is_on() || formulas_->strength_names(path_of_walls)) path_ = &add_path(context);
  if (!formulas_->friction()) friction_ = Property(options_->friction, places, context.start_time);
  dilation_angle_ = Property(options_->dilation_angle, places, context.start_time);
  if (options_->dynamic_friction) dynamic_friction_ = Property(*options_->dynamic_friction, places, context.start_time);
  if (options.depends_on_rate)
    rate_and_state_ = std::make_unique<RateAndStateWalls>(context, options.rate_and_state, friction_, here_);
  dilation_ = dilation_angle_.values().unaryExpr([](double psi) { return std::tan(psi); });
  formulas_->set_time({context.start_time, 0, context.start_time});
  evaluate_formulas();
  if (history_) history_->add_fields(context.fields, mesh_, Location::fracture_cell, context.name, traction_.name());
  stiffness_of_walls_ = stiffness_of_fractures_ = stiffness_of_springs_ = Vector::Ones(dimension * count);
  fracture_size_.assign(mesh_.fractures.size(), 0);
  for (const FractureCell& cell : mesh_.fracture_cells) fracture_size_[cell.fracture] += cell.measure;
  if constexpr (dimension > 2)
    for (double& size : fracture_size_) size = std::sqrt(size);
}

FrictionalContact::~FrictionalContact() = default;

double FrictionalContact::opening_under(int cell, double normal_traction) const {
  // A fracture that grows has no walls before that could have closed.
  return mesh_.fracture_cells[cell].grown ? 0.0 : -closure(cell, normal_traction);
}

void FrictionalContact::evaluate_data(const StepTime& step) {
  if (history_) history_->show({step.start, step.dt, step.end}, state_remembered(false));
  formulas_->set_time(step);
  evaluate_formulas();
  friction_.evaluate(step);
  if (rate_and_state_ && friction_.depends_on_time()) rate_and_state_->evaluate_data(friction_);
  if (options_->dynamic_friction) dynamic_friction_.evaluate(step);
  if (!dilation_angle_.depends_on_time()) return;
  dilation_angle_.evaluate(step);
  dilation_ = dilation_angle_.values().unaryExpr([](double psi) { return std::tan(psi); });
}

void FrictionalContact::begin_step(const StepTime& step) {
  dt_ = step.dt;
  if (history_) history_->begin_step({step.start, step.dt, step.end}, state_remembered(false));
  if (rate_and_state_) rate_and_state_->begin_step(step, slipping_walls());
  back_slip_.clear();
  kept_.clear();
}

std::vector<double> FrictionalContact::switch_times() const {
  std::vector<const Data*> data{&options_->friction, &options_->dilation_angle, &options_->cohesion};
  for (const std::optional<Data>* given :
       {&options_->dynamic_friction, &options_->dilation, &options_->closure.formula})
    if (*given) data.push_back(&**given);
  return merged_switch_times(data);
}

void FrictionalContact::set_wall_stiffness(const Vector& stiffness) {
  stiffness_of_walls_ = stiffness;
  stiffness_of_springs_ = stiffness_of_fractures_ = stiffness_of_walls_;
  for (int i = 0; i < mesh_.fracture_cell_count(); ++i) {
    const FractureCell& cell = mesh_.fracture_cells[i];
    stiffness_of_fractures_.segment<tangents>(dimension * i + 1) *= cell.size() / fracture_size_[cell.fracture];
    constexpr double at_most = 0.5;  // times the tangential stiffness over mu_s tan psi
    const double wedge = std::max(friction_[i] * dilation_[i], std::numeric_limits<double>::min());
    for (Vector* c : {&stiffness_of_walls_, &stiffness_of_fractures_}) {
      // The same stiffness for all tangents: the return to the cone then does not depend on the directions of the
      // tangents.
      auto tangential = c->segment<tangents>(dimension * i + 1);
      const double least = tangential.minCoeff();
      tangential.setConstant(least);
      (*c)[dimension * i] = std::min((*c)[dimension * i], at_most * least / wedge);
    }
    stiffness_of_springs_.segment<tangents>(dimension * i + 1) =
        stiffness_of_fractures_.segment<tangents>(dimension * i + 1);
  }
}

void FrictionalContact::after_solve(const std::vector<Field*>& solved, const StepTime&) {
  if (std::find(solved.begin(), solved.end(), &traction_) == solved.end()) return;
  if (rate_and_state_ && bonded_.empty()) {
    Vector rates(tangents * mesh_.fracture_cell_count());
    for (int i = 0; i < mesh_.fracture_cell_count(); ++i)
      if (is_on_fracture_cell(i))
        rates.segment<tangents>(tangents * i) = trial(i).at_rate.value().slip_rate;
      else
        rates.segment<tangents>(tangents * i).setZero();
    rate_and_state_->set_slip_rates(std::move(rates));
  }
  if (path_) {
    Vector paths = Vector::Zero(mesh_.fracture_cell_count());
    for (int i = 0; i < paths.size(); ++i)
      if (is_on_fracture_cell(i))
        paths[i] = path(i, gap(i, traction_.now(), jump_.now()), magnitude<tangents>(moved(i)));
    path_->set(std::move(paths));
  }
  if (history_) history_->remember(state_remembered(true));
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
                          {stiffness()[row], stiffness()[row + 1], springs[0], springs[1], may_weaken()});
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

std::string FrictionalContact::loss_of_one_stage() const {
  if (!rate_and_state_) return "";
  return "recurrence times and peak slip rates of '" + name() +
         "' are of first order in 'state_change' (0.6 % and 8 % too small in the cycle of a spring-slider at 0.1, "
         "against 5e-6 and 3e-4)";
}

Vector FrictionalContact::slips() const {
  Vector slips(tangents * mesh_.fracture_cell_count());
  for (int i = 0; i < mesh_.fracture_cell_count(); ++i)
    slips.segment<tangents>(tangents * i) = tangential(jump_.now(), i);
  return slips;
}

SlippingWalls FrictionalContact::slipping_walls() const {
  SlippingWalls walls{slips(), Vector(mesh_.fracture_cell_count()), Vector(mesh_.fracture_cell_count())};
  for (int i = 0; i < mesh_.fracture_cell_count(); ++i) {
    walls.shear_before[i] = tangential(traction_.accepted(), i).norm();
    walls.shear[i] = tangential(traction_.now(), i).norm();
  }
  return walls;
}

void FrictionalContact::accepted() {
  if (rate_and_state_) rate_and_state_->accepted(slipping_walls());
  passed_.clear();
}

void FrictionalContact::save(std::map<std::string, Vector>& state) const {
  if (rate_and_state_) rate_and_state_->save(name(), state);
}

void FrictionalContact::restore(const std::map<std::string, Vector>& state) {
  if (rate_and_state_) rate_and_state_->restore(name(), state);
}

void FrictionalContact::begin_totals() {
  if (rate_and_state_) rate_and_state_->begin_events_anew(slipping_walls());
}

double FrictionalContact::longest_step(double) const {
  return rate_and_state_ ? rate_and_state_->longest_step() : std::numeric_limits<double>::infinity();
}

std::optional<StepTooLong> FrictionalContact::too_long(const StepTime& step) const {
  if (!rate_and_state_) return std::nullopt;
  Vector slip = slips();
  for (int i = 0; i < mesh_.fracture_cell_count(); ++i)
    slip.segment<tangents>(tangents * i) -= tangential(jump_.accepted(), i);
  return rate_and_state_->too_long(slip, step);
}

void FrictionalContact::set_shear_modulus(const Vector& modulus) {
  SPREKK_EXPECT(modulus.size() == mesh_.fracture_cell_count(), modulus.size());
  shear_modulus_ = modulus;
  if (rate_and_state_) rate_and_state_->set_shear_modulus(modulus);
}

std::unique_ptr<Component> frictional_contact(const ComponentContext& context, const Options& options,
                                              Multiplier multiplier, double stiffness_factor) {
  return std::make_unique<FrictionalContact>(context, options, multiplier, stiffness_factor);
}

}  // namespace sprekk::contact
