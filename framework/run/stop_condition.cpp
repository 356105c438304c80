#include "framework/run/stop_condition.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "framework/config/units.hpp"

namespace sprekk {

namespace {

const Quantity* find(const std::vector<Quantity>& quantities, const std::string& name) {
  const auto found = std::ranges::find(quantities, name, &Quantity::name);
  return found == quantities.end() ? nullptr : &*found;
}

std::string joined(const std::vector<std::string>& texts) {
  std::string whole;
  for (const std::string& text : texts) whole += (whole.empty() ? "" : ", and ") + text;
  return whole;
}

}  // namespace

StopCondition::Term StopCondition::read(const TimeOptions::StopTerm& given, const std::vector<Quantity>& quantities) {
  const Quantity* quantity = find(quantities, *given.of);
  if (!quantity) {
    std::vector<std::string> names;
    for (const Quantity& each : quantities) names.push_back(each.name);
    throw unknown_name(given.origin, "quantity of history.csv", *given.of, names);
  }
  const bool falls = given.falls_to.has_value();
  const std::string limit = falls ? *given.falls_to : *given.reaches;
  return {*given.of,       falls, parse_quantity(limit, quantity->unit, given.origin, falls ? "falls_to" : "reaches"),
          quantity->value, limit, quantity->unit};
}

StopCondition::StopCondition(const Scene& scene, const std::vector<Quantity>& quantities)
    : needs_all_(!scene.time.stop.all.empty()) {
  if (!scene.time.has_stop) return;
  for (const TimeOptions::StopTerm& given : scene.time.stop.terms()) terms_.push_back(read(given, quantities));
  was_reached_at_start_ = is_reached(quantities);
}

bool StopCondition::Term::holds(const std::vector<Quantity>& quantities) const {
  const Quantity* quantity = find(quantities, name);
  return quantity && (falls ? quantity->value <= value : quantity->value >= value);
}

bool StopCondition::is_reached(const std::vector<Quantity>& quantities) const {
  const auto holds = [&](const Term& term) { return term.holds(quantities); };
  if (terms_.empty()) return false;
  return needs_all_ ? std::ranges::all_of(terms_, holds) : std::ranges::any_of(terms_, holds);
}

std::string StopCondition::text(const std::vector<Quantity>& quantities) const {
  std::vector<std::string> texts;
  for (const Term& term : terms_)
    if (term.holds(quantities))
      texts.push_back(term.name + (term.falls ? " has fallen to " : " has reached ") + term.limit);
  return joined(texts);
}

std::string StopCondition::start_text() const {
  std::vector<std::string> texts;
  for (const Term& term : terms_)
    texts.push_back(fmt::format("{} is {} at the start", term.name, quantity_text(term.start, term.unit)));
  return joined(texts);
}

std::string StopCondition::missed_text(const std::vector<Quantity>& quantities) const {
  std::vector<std::string> texts;
  for (const Term& term : terms_) {
    if (term.holds(quantities)) continue;
    const std::string missed = "has not " + std::string(term.falls ? "fallen to " : "reached ") + term.limit;
    const Quantity* quantity = find(quantities, term.name);
    texts.push_back(term.name + " " +
                    (quantity ? "is " + quantity_text(quantity->value, term.unit) + ", and " + missed : missed));
  }
  return joined(texts);
}

}  // namespace sprekk
