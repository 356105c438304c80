#include "components/contact/laws/formulas.hpp"

#include <utility>

namespace sprekk::contact {

const StateVariables& strength_variables() {
  static const StateVariables variables = {
      {"slip", "m", "size of the slip"},
      {"path", "m", "path of slip and opening since the start, forth and back"},
      {"slip_rate", "m/s", "slip of the step over its length"},
      {"sigma_n", "Pa", "normal stress between the walls, positive where they press"}};
  return variables;
}

const StateVariables& dilation_variables() {
  static const StateVariables variables = {{"slip", "m", "size of the slip"}};
  return variables;
}

const StateVariables& closure_variables() {
  static const StateVariables variables = {
      {"sigma_n", "Pa", "normal stress between the walls, positive where they press"}};
  return variables;
}

Formulas::Formulas(const LawData& laws, std::unique_ptr<FrictionLaw> friction_law, const std::vector<Place>& places,
                   const History* history)
    : friction_law_(std::move(friction_law)) {
  if (StateFormula friction(laws.friction, strength_variables(), places, history); friction.is_formula())
    friction_.emplace(std::move(friction));
  if (!laws.cohesion.is_constant()) cohesion_.emplace(laws.cohesion, strength_variables(), places, history);
  if (laws.dilation) dilation_.emplace(*laws.dilation, dilation_variables(), places, history);
  if (laws.closure) closure_.emplace(*laws.closure, closure_variables(), places, history);
  if (!history) return;
  std::uint32_t recalled = 0;
  for (const StateFormula* formula : {this->friction(), cohesion(), dilation(), closure()})
    if (formula) recalled |= formula->recalled();
  history->require_named(recalled, "friction, cohesion, dilation or closure");
}

void Formulas::set_time(const StepTime& step) {
  for (std::optional<StateFormula>* formula : {&friction_, &cohesion_, &dilation_, &closure_})
    if (*formula) (*formula)->set_time(step);
}

bool Formulas::strength_names(WallVariable variable) const {
  return (friction_ && friction_->names(variable)) || (friction_law_ && friction_law_->depends_on(variable)) ||
         (cohesion_ && cohesion_->names(variable));
}

}  // namespace sprekk::contact
