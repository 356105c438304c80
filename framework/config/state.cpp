#include "framework/config/state.hpp"

#include <algorithm>
#include <list>
#include <map>
#include <utility>

#include "framework/config/input_error.hpp"
#include "framework/config/unknown_key.hpp"

namespace sprekk {
namespace {

thread_local const StateNow* now = nullptr;
thread_local const StateVariables* read_now = nullptr;
thread_local const std::string* parameter_now = nullptr;
thread_local std::function<StateVariables()> declared_now;

bool are_the_same(const StateVariables& one, const StateVariables& other) {
  return std::ranges::equal(one, other, [](const StateVariable& a, const StateVariable& b) {
    return a.name == b.name && a.unit == b.unit && a.doc == b.doc;
  });
}

/// By the names of a spec and of a parameter: a spec is made anew for each map that it reads.
std::map<std::pair<std::string, std::string>, const StateVariables*>& formula_parameters() {
  static std::map<std::pair<std::string, std::string>, const StateVariables*> all;
  return all;
}

/// Sets the state that formulas see, and the one before at its end.
class Seen {
 public:
  explicit Seen(const StateNow& state) : before_(now) { now = &state; }
  ~Seen() { now = before_; }
  Seen(const Seen&) = delete;
  Seen& operator=(const Seen&) = delete;

 private:
  const StateNow* before_;
};

}  // namespace

const StateNow* state_now() { return now; }

double value_at_state(const Data& data, const Place& place, const StateVariables& variables,
                      std::span<const double> values, std::span<double> by) {
  std::ranges::fill(by, 0);
  std::uint32_t named = 0;
  const StateNow state{variables, values, by, &named};
  const Seen seen(state);
  try {
    return data.at(place);
  } catch (const DataError& error) {
    if (named == 0) throw;
    throw StateError(error.what());
  }
}

std::uint32_t variables_named(const Data& data, const Place& place, const StateVariables& variables) {
  const std::vector<double> values(variables.size(), 1);
  std::uint32_t named = 0;
  const StateNow state{variables, values, {}, &named};
  const Seen seen(state);
  try {
    data.at(place);
  } catch (const DataError&) {
    // It has no value in this state, and has said what it names.
  }
  return named;
}

WithoutDerivatives::WithoutDerivatives() : before_(now) {
  if (!now) return;
  without_.emplace(StateNow{now->variables, now->values, {}, now->named});
  now = &*without_;
}

WithoutDerivatives::~WithoutDerivatives() { now = before_; }

void may_be_formula(const std::string& spec, const std::string& parameter, const StateVariables& variables) {
  formula_parameters()[{spec, parameter}] = &variables;
}

const StateVariables* formula_variables(const std::string& spec, const std::string& parameter) {
  const auto found = formula_parameters().find({spec, parameter});
  return found == formula_parameters().end() ? nullptr : found->second;
}

std::string formula_text(const std::string& spec, const std::string& parameter) {
  const StateVariables* variables = formula_variables(spec, parameter);
  if (!variables) return "";
  std::string names;
  for (const StateVariable& variable : *variables)
    names += (names.empty() ? "" : ", ") + variable.name + " (" + variable.doc +
             (variable.unit.empty() ? ")" : ", " + variable.unit + ")");
  return "A formula may name " + names + ".";
}

ReadsParameter::ReadsParameter(const std::string& name) : before_(parameter_now) { parameter_now = &name; }
ReadsParameter::~ReadsParameter() { parameter_now = before_; }

std::string formula_takers(const std::string& variable) {
  if (!parameter_now) return "";
  place_of_key(variable);  // makes the specs of all parts, which say what may be a formula
  std::vector<std::string> takers;
  for (const auto& [parameter, variables] : formula_parameters())
    if (parameter.second == *parameter_now && std::ranges::count(*variables, variable, &StateVariable::name) > 0)
      takers.push_back(parameter.first);
  if (takers.empty()) return "";
  return "a formula of " + quoted(variable) + " is taken as " + quoted(*parameter_now) + " by " + listed(takers) +
         ", and not here";
}

const StateVariables& joined(const StateVariables& first, const StateVariables& second) {
  static std::list<StateVariables> all;
  StateVariables both = first;
  both.insert(both.end(), second.begin(), second.end());
  for (const StateVariables& known : all)
    if (are_the_same(known, both)) return known;
  return all.emplace_back(std::move(both));
}

ReadsMap::ReadsMap() : before_(declared_now) {}
ReadsMap::~ReadsMap() { declared_now = std::move(before_); }

void let_formulas_name(std::function<StateVariables()> further) { declared_now = std::move(further); }

const StateVariables* with_declared(const StateVariables* variables) {
  return variables && declared_now ? &joined(*variables, declared_now()) : variables;
}

ReadsFormula::ReadsFormula(const StateVariables* variables) : before_(read_now) { read_now = variables; }
ReadsFormula::~ReadsFormula() { read_now = before_; }

const StateVariables& ReadsFormula::variables() {
  static const StateVariables nothing;
  return read_now ? *read_now : nothing;
}

}  // namespace sprekk
