#include "framework/config/state.hpp"

#include <algorithm>
#include <map>

#include "framework/config/input_error.hpp"
#include "framework/config/unknown_key.hpp"

namespace sprekk {
namespace {

thread_local const StateNow* now = nullptr;
thread_local const StateVariables* read_now = nullptr;
thread_local const std::string* parameter_now = nullptr;

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

ReadsFormula::ReadsFormula(const StateVariables* variables) : before_(read_now) { read_now = variables; }
ReadsFormula::~ReadsFormula() { read_now = before_; }

const StateVariables& ReadsFormula::variables() {
  static const StateVariables nothing;
  return read_now ? *read_now : nothing;
}

}  // namespace sprekk
