#include "framework/schedule/convergence_criteria.hpp"

#include <algorithm>

#include "framework/config/units.hpp"
#include "framework/invariants.hpp"

namespace sprekk {

namespace {

const char* const residual_doc =
    "Largest residual of any equation, without stabilization, over the largest of its terms.";

}  // namespace

Spec CriterionOptions::spec() {
  Spec spec("condition",
            "A bound of the coupled residual, of that of one equation, or of the change of a field by a pass.");
  spec.quantity("residual", residual, {.range = strictly_between(0, 1), .doc = residual_doc});
  spec.text("change_of", change_of, {.doc = "A field that is solved inside, by its whole name."});
  spec.text("residual_of", residual_of,
            {.doc = "A field that is solved inside, by its whole name: bounds the residual of its equation alone."});
  spec.quantity("relative", relative,
                {.range = strictly_between(0, 1),
                 .doc = "Largest change of the field over its largest value, or largest residual of its equation over "
                        "the largest of its terms."});
  spec.text("absolute", absolute, {.doc = "Largest change of the field, with a unit."});
  spec.check([this](const Node& node) {
    origin = node.origin;
    for (const char* key : {"change_of", "residual_of"})
      if (const Node* given = node.find(key)) field_origin = given->origin;
    if (const Node* given = node.find("absolute")) absolute_origin = given->origin;
    if (residual_of) {
      if (residual || change_of || absolute || !relative)
        throw InputError(origin,
                         "the condition on the equation of " + sprekk::quoted(*residual_of) + " has not one bound",
                         "it bounds its residual over its largest term by 'relative', and nothing else",
                         "write '{residual_of: " + *residual_of + ", relative: 1e-8}'");
      return;
    }
    if (residual.has_value() == change_of.has_value())
      throw InputError(origin,
                       residual ? "one condition bounds 'residual' and 'change_of'" : "the condition bounds nothing",
                       "each is an item of the list",
                       "write '{residual: 1e-8}', '{residual_of: a.b, relative: 1e-8}' or '{change_of: a.b, relative: "
                       "1e-6}'");
    if (residual && (relative || absolute))
      throw InputError(origin, "'relative' and 'absolute' have no effect", "the condition bounds the residual",
                       "remove them, or write 'change_of'");
    if (change_of && relative.has_value() == absolute.has_value())
      throw InputError(
          origin, "the change of " + sprekk::quoted(*change_of) + (relative ? " has two bounds" : " has no bound"),
          "a condition has one, 'relative' or 'absolute'", relative ? "write two conditions" : "add 'relative: 1e-6'");
  });
  return spec;
}

Spec UntilOptions::spec() {
  Spec spec("until", "When the iteration has converged.");
  spec.quantity("relative", relative,
                {.range = strictly_between(0, 1),
                 .doc = std::string(residual_doc) + " Without effect, unless it is given, where 'all' or 'any' are."});
  spec.integer(
      "at_most", at_most,
      {.range = between(1, 100000), .doc = "Passes before the step is refused, or what 'fallback' says is done."});
  spec.integer("at_least", at_least, {.range = between(1, 100000), .doc = "Passes that are made in any case."});
  static CriterionOptions example;
  const auto list = [&](const char* name, std::list<CriterionOptions>& conditions, const char* doc) {
    spec.list_of_sections(name, example.spec(),
                          [&conditions](int, const Origin&) {
                            conditions.emplace_back();
                            return conditions.back().spec();
                          },
                          {.doc = doc});
  };
  list("all", all, "Conditions that all have to hold.");
  list("any", any, "Conditions of which one has to hold.");
  spec.check([this](const Node& node) {
    is_relative_given = node.find("relative") != nullptr;
    const auto origin_of = [&](const char* key) { return node.find(key) ? node.find(key)->origin : node.origin; };
    if (at_least > at_most)
      throw InputError(origin_of("at_least"), "'at_least' is larger than 'at_most'", "no step would ever end",
                       "raise 'at_most'");
    const auto bounds_change = [](const CriterionOptions& condition) { return condition.change_of.has_value(); };
    if (at_most == 1 &&
        (std::ranges::any_of(all, bounds_change) || (!any.empty() && std::ranges::all_of(any, bounds_change))))
      throw InputError(origin_of("at_most"), "'at_most: 1' allows no change to be seen",
                       "the change by a pass is known from the second pass on", "raise it");
    for (const CriterionOptions& condition : any)
      if (condition.residual && is_relative_given && relative <= *condition.residual)
        throw InputError(condition.origin, "the condition has no effect",
                         "'relative' already asks for a residual that is at least as small", "remove one of them");
    if (!is_relative_given) return;
    for (const CriterionOptions& condition : all) {
      if (condition.residual)
        throw InputError(condition.origin, "the residual has two bounds", "'relative' is one of all conditions, too",
                         "remove one of them");
      if (condition.residual_of && *condition.relative >= relative)
        throw InputError(condition.origin, "the condition has no effect",
                         "'relative' already asks for residuals that are at least as small", "remove one of them");
    }
  });
  return spec;
}

double UntilOptions::tightest() const {
  double least = relative;
  bool is_first = !is_relative_given;
  for (const auto* conditions : {&all, &any})
    for (const CriterionOptions& condition : *conditions)
      if (const std::optional<double> bound = condition.of_residual()) {
        least = is_first ? *bound : std::min(least, *bound);
        is_first = false;
      }
  return least;
}

double UntilOptions::loosest() const {
  double of_all = is_relative_given || (all.empty() && any.empty()) ? relative : 1, of_any = any.empty() ? 1 : 0;
  for (const CriterionOptions& condition : all)
    if (condition.residual) of_all = std::min(of_all, *condition.residual);
  for (const CriterionOptions& condition : any) of_any = std::max(of_any, condition.residual.value_or(1));
  return std::min(of_all, of_any);
}

bool UntilOptions::bounds_residual() const {
  const auto is_of_residual = [](const CriterionOptions& condition) { return condition.residual.has_value(); };
  if (is_relative_given || (all.empty() && any.empty())) return true;
  return std::ranges::any_of(all, is_of_residual) || (!any.empty() && std::ranges::all_of(any, is_of_residual));
}

void UntilOptions::require_changes() const {
  for (const auto* conditions : {&all, &any})
    for (const CriterionOptions& condition : *conditions)
      if (condition.of_residual())
        throw InputError(condition.origin, "there is no residual to be bounded",
                         "the steps inside take substeps, which do not fulfil the equations of the whole step",
                         "write 'relative', or bound changes by 'change_of'");
}

ConvergenceCriteria::ConvergenceCriteria(const UntilOptions& options, const std::vector<Field*>& fields)
    : at_least_(options.at_least), all_(made(options.all, fields)), any_(made(options.any, fields)) {
  if (options.is_relative_given || (all_.empty() && any_.empty())) all_.push_back({options.relative});
  for (const auto* criteria : {&all_, &any_})
    for (const Criterion& criterion : *criteria)
      need_changes_ = need_changes_ || (criterion.field && !criterion.is_residual);
}

std::vector<ConvergenceCriteria::Criterion> ConvergenceCriteria::made(const std::list<CriterionOptions>& options,
                                                                      const std::vector<Field*>& fields) {
  std::vector<Criterion> criteria;
  for (const CriterionOptions& condition : options) {
    if (condition.residual) {
      criteria.push_back({*condition.residual});
      continue;
    }
    const std::string& name = condition.residual_of ? *condition.residual_of : *condition.change_of;
    std::vector<std::string> names;
    for (const Field* field : fields) names.push_back(field->name());
    const auto place = std::ranges::find(names, name) - names.begin();
    if (place == static_cast<std::ptrdiff_t>(names.size()))
      throw unknown_name(condition.field_origin, "field that is solved inside", name, names);
    if (condition.residual_of) {
      criteria.push_back(
          {*condition.relative, fields[static_cast<std::size_t>(place)], static_cast<std::size_t>(place), true, true});
      continue;
    }
    const Field* field = fields[static_cast<std::size_t>(place)];
    const double bound = condition.relative ? *condition.relative
                                            : parse_quantity(*condition.absolute, field->spec().unit,
                                                             condition.absolute_origin, "absolute");
    if (!(bound > 0))
      throw InputError(condition.absolute_origin, "a change of " + quoted(*condition.absolute) + " is never seen",
                       "a bound is larger than 0", "raise it");
    criteria.push_back({bound, field, static_cast<std::size_t>(place), condition.relative.has_value()});
  }
  return criteria;
}

bool ConvergenceCriteria::holds(const Criterion& criterion, int pass, const std::function<bool(double)>& residual_holds,
                                const std::vector<std::pair<std::string, double>>& residuals,
                                const std::vector<Vector>& before) {
  if (!criterion.field) return residual_holds(criterion.bound);
  if (criterion.is_residual)
    return std::ranges::all_of(residuals, [&](const auto& residual) {
      return residual.first != criterion.field->name() || residual.second <= criterion.bound;
    });
  if (criterion.field->size() == 0) return true;
  if (pass == 1) return false;
  const Vector& now = criterion.field->now();
  const Vector& old = before[criterion.place];
  SPREKK_EXPECT(now.size() == old.size(), now.size(), old.size());
  const double change = (now - old).lpNorm<Eigen::Infinity>();
  const double largest = std::max(now.lpNorm<Eigen::Infinity>(), old.lpNorm<Eigen::Infinity>());
  return change <= criterion.bound * (criterion.is_relative ? largest : 1);
}

bool ConvergenceCriteria::hold(int pass, const std::function<bool(double)>& residual_holds,
                               const std::vector<std::pair<std::string, double>>& residuals,
                               const std::vector<Vector>& before) const {
  if (pass < at_least_) return false;
  const auto is_met = [&](const Criterion& criterion) {
    return holds(criterion, pass, residual_holds, residuals, before);
  };
  return std::ranges::all_of(all_, is_met) && (any_.empty() || std::ranges::any_of(any_, is_met));
}

}  // namespace sprekk
