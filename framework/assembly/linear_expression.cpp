#include "framework/assembly/linear_expression.hpp"

namespace sprekk {

Vector LinearExpression::now() const {
  Vector value = constant;
  for (const Term& term : terms) value += term.matrix.entries() * term.field->now();
  return value;
}

Vector LinearExpression::accepted() const {
  Vector value = constant;
  for (const Term& term : terms) value += term.matrix.entries() * term.field->accepted();
  return value;
}

}  // namespace sprekk
