#include "components/outside/program.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "components/outside/hello.hpp"
#include "framework/assembly/property.hpp"
#include "framework/config/state.hpp"
#include "framework/field/ownership.hpp"
#include "framework/output/activity.hpp"
#include "framework/outside/commands.hpp"
#include "framework/outside/outside_error.hpp"
#include "framework/parallel/parallel.hpp"

namespace sprekk::outside {

namespace {

/// So small that nothing is left of a row by it: rows of a check are told by their error alone (Assembly::Fixed).
constexpr double no_scale = 1e-200;

Vector initial_values(const Mesh& mesh, const GivenOptions& given, double start) {
  const Location location = given.location();
  const int count = entity_count(mesh, location);
  Vector values(count * given.components);
  for (int i = 0; i < count; ++i) {
    Place place;
    if (location == Location::node) place = {mesh.nodes[i]};
    if (location == Location::cell) place = {mesh.cell_center[i], mesh.cell_region[i]};
    if (location == Location::fracture_cell) place = fracture_cell_place(mesh, i);
    place.t = start;
    values.segment(i * given.components, given.components).setConstant(given.start.at(place));
  }
  return values;
}

Role role_of(const GivenOptions& given) {
  const bool is_potential = given.components == 1 && given.location() != Location::fracture_cell;
  return Role::unknown(is_potential ? BlockKind::bulk_elliptic : BlockKind::interface);
}

}  // namespace

Program::Program(const ComponentContext& context, const Options& options)
    : Component(context.name),
      mesh_(context.mesh),
      fields_(context.fields),
      origin_(context.origin),
      options_(options),
      start_time_(context.start_time) {
  for (const auto& [name, given] : options_.gives) {
    Field& field = fields_.add(mesh_, {.owner = context.name,
                                       .name = name,
                                       .location = given.location(),
                                       .components = given.components,
                                       .role = role_of(given),
                                       .unit = given.unit,
                                       .doc = "As another program determines it"});
    Vector initial = initial_values(mesh_, given, start_time_);
    field.set_both(initial);
    given_.push_back({given, &field, std::move(initial), given.as.starts_with("rock"),
                      Operator(diagonal_matrix(Vector::Ones(field.size())))});
  }
}

Field& Program::given(const std::string& role) const {
  return *std::ranges::find(given_, role, [](const Given& given) { return given.options.as; })->field;
}

const Vector& Program::initial(const std::string& role) const {
  return std::ranges::find(given_, role, [](const Given& given) { return given.options.as; })->initial;
}

void Program::require_command() const {
  if (!program_command(name()))
    throw InputError(origin_, quoted(name()) + " is another program, and no command starts it",
                     "a scene starts no program: only you do",
                     "add --program " + name() + "='python3 " + name() + ".py', or what starts yours");
}

void Program::join_run(const std::vector<Part*>&) { has_joined_ = true; }

void Program::evaluate_data(const StepTime&) {
  if (!taken_.empty()) return;
  std::vector<std::string> names;
  for (const auto& field : fields_.all()) names.push_back(field->name());
  for (const std::string& name : options_.takes) {
    if (!fields_.has(name)) throw unknown_name(options_.takes_origin, "field", name, names);
    taken_.push_back(&fields_.at(name));
  }
}

bool Program::is_own(const Field& field) const {
  return std::ranges::any_of(given_, [&](const Given& given) { return given.field == &field; });
}

std::vector<std::uint64_t> Program::versions_of_others() const {
  std::vector<std::uint64_t> versions;
  for (const auto& field : fields_.all())
    if (!is_own(*field)) versions.push_back(field->version());
  return versions;
}

OutsideMessage Program::hello() const {
  OutsideMessage hello;
  hello.texts.emplace_back("name", name());
  std::string gives, takes;
  const auto line = [](const std::string& name, const FieldSpec& spec) {
    return fmt::format("{} {} {}\n", name, spec.components, spec.unit.empty() ? "1" : spec.unit);
  };
  for (const Given& given : given_) gives += line(given.field->spec().name, given.field->spec());
  for (const Field* field : taken_) takes += line(field->name(), field->spec());
  hello.texts.emplace_back("gives", gives);
  hello.texts.emplace_back("takes", takes);
  hello.ints.emplace_back("dimension", std::vector<int>{dimension});
  hello.reals.emplace_back("start", Vector::Constant(1, start_time_));
  for (const auto& [parameter, value] : options_.parameters)
    hello.reals.emplace_back("parameter." + parameter, Vector::Constant(1, value));
  for (const Given& given : given_) hello.reals.emplace_back(given.field->spec().name, given.field->accepted());
  add_mesh(mesh_, hello);
  return hello;
}

OutsideMessage Program::fields_for(const Assembly& assembly) const {
  OutsideMessage fields;
  for (const Field* field : taken_) fields.reals.emplace_back(field->name(), field->now());
  const std::vector<const Field*>& unknowns = assembly.unknowns();
  for (const Given& given : given_) {
    if (!given.has_loads) continue;
    const auto row = std::ranges::find(unknowns, given.field) - unknowns.begin();
    Vector loads = assembly.residual(static_cast<int>(row));
    exchange(mesh_, given.options.location(), 1, loads);
    fields.reals.emplace_back(given.field->spec().name + ".loads", std::move(loads));
  }
  return fields;
}

std::vector<Vector> Program::ask(OutsideMessage fields) const {
  now_doing("the program of " + name());
  if (!conversation_) {
    require_command();
    conversation_ =
        std::make_unique<Conversation>(name(), *program_command(name()), options_.timeout, hello(), kept_at_restart_);
  }
  const OutsideMessage solved = conversation_->solve(
      step_,
      [this](OutsideMessage& begin) {
        for (const Field* field : taken_) begin.reals.emplace_back(field->name(), field->accepted());
        for (const Given& given : given_) begin.reals.emplace_back(given.field->spec().name, given.field->accepted());
        tell_more(begin);
      },
      std::move(fields));
  std::vector<Vector> values;
  for (const Given& given : given_) {
    const FieldSpec& spec = given.field->spec();
    const Vector* found = solved.real(spec.name);
    if (found == nullptr || found->size() != given.field->size())
      throw OutsideError(fmt::format("the program of '{}' gives {} for '{}', not {} ({} values of {})", name(),
                                     found ? std::to_string(found->size()) + " numbers" : "nothing", spec.name,
                                     given.field->size(), given.field->entities(), spec.components));
    for (Eigen::Index i = 0; i < found->size(); ++i)
      if (!std::isfinite((*found)[i]))
        throw StateError(fmt::format("the program of '{}' gives {} for value {} of '{}'", name(), (*found)[i],
                                     i / spec.components, spec.name));
    values.push_back(*found);
  }
  return values;
}

const std::vector<Vector>* Program::answer(const Assembly& assembly, bool is_alone) const {
  const auto is_step = [&] {
    return asked_ && asked_->step.start == step_.start && asked_->step.dt == step_.dt && asked_->step.end == step_.end;
  };
  std::vector<std::uint64_t> versions = versions_of_others();
  // All processes ask, or none does.
  if (is_alone && !parallel::any(!is_step() || asked_->versions != versions)) return &asked_->answer;
  // Beside others it is asked for the residual of the step that it has solved, not for that of a whole step when it has
  // taken substeps, and not for derivatives.
  if (!is_alone && (assembly.wants_derivatives() || !is_step())) return nullptr;
  OutsideMessage fields = fields_for(assembly);
  if (parallel::any(!is_step() || asked_->fields.reals != fields.reals)) {
    asked_.reset();
    OutsideMessage copy = fields;
    std::vector<Vector> values = ask(std::move(copy));
    asked_ = Asked{step_, {}, std::move(fields), std::move(values)};
  }
  asked_->versions = std::move(versions);
  return &asked_->answer;
}

void Program::hold(Assembly& assembly, const Field& field, double scale) {
  for (int i = 0; i < field.size(); ++i) assembly.fix(field, i, field.now()[i], scale);
}

/// Rows that are fixed are judged by their own relative errors, and values near zero have large ones: the largest error
/// over the largest value is told by the row of the latter.
double Program::fix_error(Assembly& assembly, const Field& field, const Vector& answer) {
  Eigen::Index place = 0;
  const double largest = field.size() > 0 ? field.now().cwiseAbs().maxCoeff(&place) : 0;
  const double size = field.size() > 0 ? std::max(largest, answer.lpNorm<Eigen::Infinity>()) : 0;
  const double error = size > 0 ? (field.now() - answer).lpNorm<Eigen::Infinity>() / size : 0;
  for (int i = 0; i < field.size(); ++i) {
    const double value = field.now()[i];
    const bool tells = i == place && error > 0;
    assembly.fix(field, i, !tells ? value : largest > 0 ? (1 - error) * value : size, no_scale);
  }
  return error;
}

void Program::constrain(Assembly& assembly) const {
  const std::vector<const Field*>& unknowns = assembly.unknowns();
  const auto own = std::ranges::count_if(unknowns, [this](const Field* field) { return is_own(*field); });
  if (own == 0) return;
  for (const Given& given : given_)
    if (!given.field->now().allFinite()) throw StateError(given.field->name() + " is not finite");
  const bool is_alone = own == static_cast<std::ptrdiff_t>(unknowns.size());
  const std::vector<Vector>* values = has_joined_ ? answer(assembly, is_alone) : nullptr;
  double error = 0;
  for (std::size_t k = 0; k < given_.size(); ++k) {
    const Field& field = *given_[k].field;
    // What others have added is the program's: nothing of it is left in the row, nor in sums of rows.
    const auto row = std::ranges::find(unknowns, &field) - unknowns.begin();
    if (given_[k].has_loads) assembly.add(field, -assembly.residual(static_cast<int>(row)));
    assembly.derivative(field, field, given_[k].identity);
    if (!values)
      hold(assembly, field, is_alone || assembly.wants_derivatives() ? 1 : no_scale);
    else if (is_alone)
      for (int i = 0; i < field.size(); ++i) assembly.fix(field, i, (*values)[k][i], 1);
    else
      error = std::max(error, fix_error(assembly, field, (*values)[k]));
  }
  // The same state may be looked at several times.
  if (!is_alone && values && error != error_) error_before_ = std::exchange(error_, error);
}

void Program::accepted() {
  if (conversation_) conversation_->accept();
  asked_.reset();
  error_ = error_before_ = 0;
}

void Program::rewound() {
  if (conversation_) conversation_->rewind();
  asked_.reset();
  error_ = error_before_ = 0;
}

void Program::save(std::map<std::string, Vector>& state) const {
  for (const auto& [item, values] : conversation_ ? conversation_->kept() : kept_at_restart_)
    if (values.size() > 0) state[name() + ".program." + item] = values;
}

void Program::restore(const std::map<std::string, Vector>& state) {
  const std::string prefix = name() + ".program.";
  for (const auto& [key, values] : state)
    if (key.starts_with(prefix)) kept_at_restart_[key.substr(prefix.size())] = values;
}

std::map<std::string, long> Program::counts() const {
  if (!conversation_) return {};
  return {{name() + ": solves by its program", conversation_->solves()}};
}

std::vector<ProfileEntry> Program::efforts() const {
  if (!conversation_) return {};
  return {{.name = name() + ": its program",
           .calls = conversation_->solves(),
           .seconds = conversation_->seconds_of_solves()}};
}

void Program::note_input(Notes& notes) const {
  notes.add(name() + " is another program",
            fmt::format("another program solves the equations of {0} (Sprekk does not know them, so an iteration ends "
                        "when the program would change its values by less than 'until: relative' of the largest one) a "
                        "note at the end estimates how far they may be from the solution",
                        name()));
}

void Program::note_step(Notes& notes, const StepTime&) const {
  if (conversation_ && !conversation_->repeats_bits())
    notes.add(name() + " does not repeat itself",
              fmt::format("the program of {} has given two answers to the same input (it keeps more than its state, or "
                          "computes in a varying order) repeated and restarted steps will differ",
                          name()));
  if (error_ == 0 || error_before_ == 0) return;
  const double factor = error_ / error_before_;
  if (factor >= 1) return;
  const double bound = error_ / (1 - factor);
  notes.add(
      name() + " judged by change",
      fmt::format("iterations of {} ended when its program would change its values little: they are at most {:.2g} of "
                  "the largest one from the solution, if each further pass reduces the change {:.2g} times",
                  name(), bound, factor),
      bound);
}

}  // namespace sprekk::outside
