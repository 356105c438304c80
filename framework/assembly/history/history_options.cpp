#include "framework/assembly/history/history_options.hpp"

#include <algorithm>
#include <cctype>

#include "framework/config/expression.hpp"
#include "framework/config/units.hpp"
#include "framework/formula/program.hpp"

namespace sprekk {
namespace {

/// How many a component may have: formulas are differentiated by them and by up to as many variables of the state.
constexpr std::size_t most = formula::most_derivatives / 2;

std::string names_of(const StateVariables& variables) {
  std::vector<std::string> names;
  for (const StateVariable& variable : variables) names.push_back(variable.name);
  return listed(names);
}

/// The place of the rate of a variable, "v_rate" of "v"; -1 for none.
int rate_of(const std::string& variable, const StateVariables& among) {
  const auto found = std::ranges::find(among, variable + "_rate", &StateVariable::name);
  const bool is_known = std::ranges::count(among, variable, &StateVariable::name) > 0;
  return is_known && found != among.end() ? static_cast<int>(found - among.begin()) : -1;
}

}  // namespace

Spec HistoryOptions::Entry::spec() {
  Spec spec("history", "What is remembered: one of largest, smallest and sum, of an expression of the state.");
  spec.text("largest", largest, {.doc = "The largest value so far of this expression."});
  spec.text("smallest", smallest, {.doc = "The smallest value so far of this expression."});
  spec.text("sum", sum, {.doc = "The sum of this expression over time, or over what `over` says."});
  spec.text("over", over, {.doc = "Of a sum: t, the time, which is the default, or a variable that has a rate."});
  spec.text("start", start,
            {.doc = "What has been remembered when the run starts. Without it, a sum begins with 0, and "
                    "an extreme value with that of the state at the start."});
  spec.check([this](const Node& node) {
    path = node.path;
    require_one();
    if (over && !sum)
      throw InputError(node.find("over")->origin, "'over' has no effect", "an extreme value is not summed up",
                       "write 'sum', or remove it");
  });
  return spec;
}

void HistoryOptions::Entry::require_one() const {
  const int said = largest.has_value() + smallest.has_value() + sum.has_value();
  if (said != 1)
    throw InputError(origin, quoted(path) + (said == 0 ? " does not say what is remembered" : " contradicts itself"),
                     "it is one of 'largest', 'smallest' and 'sum'", "give one of them");
}

void HistoryOptions::declare(Spec& spec, const StateVariables& followed) {
  static Entry example;
  followed_ = &followed;
  spec.named_sections("history", example.spec(),
                      [this](const std::string& key, const Origin& origin) {
                        if (entries_.size() >= most)
                          throw InputError(origin,
                                           "there are more than " + std::to_string(most) + " variables of 'history'",
                                           "formulas are differentiated by each of them",
                                           "remember less, or put several expressions together");
                        entries_.push_back({.name = key, .origin = origin});
                        all_.clear();
                        let_formulas_name([this] {
                          StateVariables variables;
                          for (const Remembered& each : all()) variables.push_back(each.variable);
                          return variables;
                        });
                        return entries_.back().spec();
                      },
                      {.doc = "What is remembered of the state, by names that formulas of this component may take. An "
                              "expression may name " +
                              names_of(followed) + ", place and time."});
}

const std::vector<Remembered>& HistoryOptions::all() const {
  for (std::size_t k = all_.size(); k < entries_.size(); ++k) all_.push_back(understood(entries_[k]));
  return all_;
}

void HistoryOptions::check_name(const Entry& entry) const {
  const std::string& name = entry.name;
  const bool is_word = !name.empty() && std::isdigit(static_cast<unsigned char>(name[0])) == 0 &&
                       std::ranges::all_of(name, [](unsigned char c) { return std::isalnum(c) != 0 || c == '_'; });
  if (!is_word)
    throw InputError(entry.origin, quoted(name) + " cannot be a variable of 'history'", "no formula could name it",
                     "take letters, digits and '_', as in 'largest_so_far'");
  if (!is_free_name(name, *followed_))
    throw InputError(entry.origin, quoted(name) + " cannot be a variable of 'history'",
                     "in a formula the name means something else", "take another one");
}

Remembered HistoryOptions::understood(const Entry& entry) const {
  entry.require_one();
  check_name(entry);
  Remembered result;
  result.origin = entry.origin;
  result.recall = entry.largest ? Recall::largest : entry.smallest ? Recall::smallest : Recall::sum;
  const char* key = entry.largest ? "largest" : entry.smallest ? "smallest" : "sum";
  const std::string& text = *(entry.largest ? entry.largest : entry.smallest ? entry.smallest : entry.sum);
  for (const Entry& other : entries_)
    if (names(text, other.name))
      throw InputError(
          entry.origin,
          "what " + quoted(entry.name) + " remembers depends on " + (&other == &entry ? "itself" : quoted(other.name)),
          "what is remembered follows the state alone: " + names_of(*followed_) + ", place and time",
          "write an expression of these");
  std::string unit = unit_of_data(text, entry.origin, key, *followed_);
  {
    const ReadsFormula formula(followed_);
    result.expression = parse_data(text, unit, entry.origin, key);
  }
  const std::string over = entry.over.value_or("t");
  if (result.recall == Recall::sum) {
    result.rate = rate_of(over, *followed_);
    if (over != "t" && result.rate < 0) {
      std::vector<std::string> known = {"t"};
      for (const StateVariable& variable : *followed_)
        if (rate_of(variable.name, *followed_) >= 0) known.push_back(variable.name);
      throw unknown_name(entry.origin, "variable to sum over:", over, known);
    }
    const std::string step = over == "t" ? "s" : std::ranges::find(*followed_, over, &StateVariable::name)->unit;
    unit = si_unit((parse_unit(unit) * parse_unit(step)).dimension);
  } else if (result.expression.is_constant() || variables_named(result.expression, {}, *followed_) == 0) {
    throw InputError(entry.origin, quoted(entry.name) + " remembers what does not follow the state: " + quoted(text),
                     "it may name " + names_of(*followed_), "name one of these, or write the number in the formula");
  }
  const std::string what =
      result.recall == Recall::sum ? "sum of " + text + " over " + over : std::string(key) + " " + text;
  result.variable = {entry.name, unit, what + (result.recall == Recall::sum ? "" : " so far")};
  if (entry.start) result.start = parse_quantity(*entry.start, unit, entry.origin, "start");
  return result;
}

}  // namespace sprekk
