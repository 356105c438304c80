#include "framework/formula/program.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <optional>

namespace sprekk::formula {
namespace {

double square(double x) { return x * x; }
const double per_root_of_pi = 2 / std::sqrt(std::numbers::pi);
double sign(double value) { return value > 0 ? 1 : value < 0 ? -1 : 0; }

const NamedFunction known_functions[] = {
    {"sin", std::sin, std::cos},
    {"cos", std::cos, [](double x) { return -std::sin(x); }},
    {"tan", std::tan, [](double x) { return 1 / square(std::cos(x)); }},
    {"asin", std::asin, [](double x) { return 1 / std::sqrt(1 - x * x); }},
    {"acos", std::acos, [](double x) { return -1 / std::sqrt(1 - x * x); }},
    {"atan", std::atan, [](double x) { return 1 / (1 + x * x); }},
    {"sinh", std::sinh, std::cosh},
    {"cosh", std::cosh, std::sinh},
    {"tanh", std::tanh, [](double x) { return 1 - square(std::tanh(x)); }},
    {"asinh", std::asinh, [](double x) { return 1 / std::sqrt(x * x + 1); }},
    {"acosh", std::acosh, [](double x) { return 1 / std::sqrt(x * x - 1); }},
    {"atanh", std::atanh, [](double x) { return 1 / (1 - x * x); }},
    {"exp", std::exp, std::exp},
    {"log", std::log, [](double x) { return 1 / x; }},
    {"log10", std::log10, [](double x) { return 1 / (x * std::numbers::ln10); }},
    {"sqrt", std::sqrt, [](double x) { return 0.5 / std::sqrt(x); }},
    {"abs", std::fabs, sign},
    {"erf", std::erf, [](double x) { return per_root_of_pi * std::exp(-x * x); }},
    {"erfc", std::erfc, [](double x) { return -per_root_of_pi * std::exp(-x * x); }},
    {"sign", sign, nullptr},
    {"floor", std::floor, nullptr},
    {"ceil", std::ceil, nullptr}};

/// a x + b y, where x and y depend on the variables.
Dual combined(double value, double a, const Dual& x, double b, const Dual& y) {
  Dual result{value};
  // A factor 0 also stands before derivatives that are infinite, as that of sqrt at 0.
  for (std::size_t k = 0; k < most_derivatives; ++k)
    result.by[k] = (x.by[k] == 0 ? 0 : a * x.by[k]) + (y.by[k] == 0 ? 0 : b * y.by[k]);
  return result;
}
Dual scaled(double value, double a, const Dual& x) { return combined(value, a, x, 0, {}); }

double value_of(double x) { return x; }
double value_of(const Dual& x) { return x.value; }
double combined(double value, double, double, double, double) { return value; }
double scaled(double value, double, double) { return value; }

/// The derivative of x^y by y, where y varies.
double by_exponent(double x, const Dual& y) {
  const bool varies = std::ranges::any_of(y.by, [](double by) { return by != 0; });
  return varies && x != 0 ? std::pow(x, y.value) * std::log(x) : 0;
}

/// The result of an operation on two numbers. The derivatives are not computed for plain numbers.
template <class Number>
Number of_two(Operation operation, const Number& left, const Number& right) {
  const double x = value_of(left), y = value_of(right);
  constexpr bool plain = std::is_same_v<Number, double>;
  switch (operation) {
    case Operation::add:
      return combined(x + y, 1, left, 1, right);
    case Operation::subtract:
      return combined(x - y, 1, left, -1, right);
    case Operation::multiply:
      return combined(x * y, y, left, x, right);
    case Operation::divide:
      return combined(x / y, 1 / y, left, -x / (y * y), right);
    case Operation::raise:
      if constexpr (plain)
        return std::pow(x, y);
      else
        return combined(std::pow(x, y), y == 0 ? 0 : y * std::pow(x, y - 1), left, by_exponent(x, right), right);
    case Operation::arc_tangent_of_two:
      return combined(std::atan2(x, y), y / (x * x + y * y), left, -x / (x * x + y * y), right);
    case Operation::minimum:
      return y < x ? right : left;
    case Operation::maximum:
      return x < y ? right : left;
    case Operation::less:
      return Number{static_cast<double>(x < y)};
    case Operation::less_equal:
      return Number{static_cast<double>(x <= y)};
    case Operation::greater:
      return Number{static_cast<double>(x > y)};
    case Operation::greater_equal:
      return Number{static_cast<double>(x >= y)};
    case Operation::equal:
      return Number{static_cast<double>(x == y)};
    case Operation::not_equal:
      return Number{static_cast<double>(x != y)};
    case Operation::both:
      return Number{static_cast<double>(x != 0 && y != 0)};
    default:
      return Number{static_cast<double>(x != 0 || y != 0)};
  }
}

template <class Number>
Number of_one(const Instruction& instruction, const Number& argument) {
  const double x = value_of(argument);
  if (instruction.operation == Operation::negate) return scaled(-x, -1, argument);
  const NamedFunction& function = *instruction.function;
  if constexpr (std::is_same_v<Number, double>)
    return function.value(x);
  else
    return scaled(function.value(x), function.derivative ? function.derivative(x) : 0, argument);
}

bool jumps(const Instruction& instruction) {
  if (instruction.operation == Operation::apply) return instruction.function->derivative == nullptr;
  return instruction.operation >= Operation::less && instruction.operation <= Operation::not_equal;
}

int taken(Operation operation) {
  switch (operation) {
    case Operation::linear:
    case Operation::power:
      return 0;
    case Operation::negate:
    case Operation::apply:
      return 1;
    case Operation::select:
      return 3;
    default:
      return 2;
  }
}

double product(double x, int exponent) { return exponent == 2 ? x * x : exponent == 3 ? x * x * x : x * x * x * x; }

/// Runs the instructions with numbers of a kind. `variable(i)`: the number for a variable. `seen(value)` hears what
/// instructions that jump give.
template <class Number, class Variable, class Seen>
Number run(const std::vector<Instruction>& instructions, std::span<Number> stack, const Variable& variable,
           const Seen& seen) {
  std::size_t top = 0;
  for (const Instruction& step : instructions) {
    switch (taken(step.operation)) {
      case 0:
        if (step.variable < 0) {
          stack[top++] = Number{step.offset};
        } else {
          const Number x = variable(step.variable);
          const double value = value_of(x);
          if (step.operation == Operation::linear)
            stack[top++] = scaled(step.factor * value + step.offset, step.factor, x);
          else
            stack[top++] = scaled(product(value, step.exponent),
                                  step.exponent * (step.exponent == 2 ? value : product(value, step.exponent - 1)), x);
        }
        break;
      case 1:
        stack[top - 1] = of_one(step, stack[top - 1]);
        break;
      case 2:
        --top;
        stack[top - 1] = of_two(step.operation, stack[top - 1], stack[top]);
        break;
      default:
        top -= 2;
        stack[top - 1] = value_of(stack[top - 1]) != 0 ? stack[top] : stack[top + 1];
    }
    if (jumps(step)) seen(value_of(stack[top - 1]));
  }
  return stack[0];
}

constexpr std::size_t usual_depth = 16;  ///< of stacks that need no memory from the heap

template <class Number, class Variable, class Seen>
Number run(const std::vector<Instruction>& instructions, std::size_t depth, const Variable& variable,
           const Seen& seen) {
  if (depth <= usual_depth) {
    std::array<Number, usual_depth> stack;
    return run<Number>(instructions, std::span<Number>(stack), variable, seen);
  }
  std::vector<Number> stack(depth);
  return run<Number>(instructions, std::span<Number>(stack), variable, seen);
}

const auto nobody = [](double) {};

}  // namespace

std::span<const NamedFunction> functions_of_one() { return known_functions; }

/// Sums, differences and multiples of at most one variable are one instruction, factor · variable + offset.
bool Program::fold_linear(const Instruction& instruction) {
  if (instructions_.size() < 2) return false;
  const Instruction& right = instructions_.back();
  Instruction& left = instructions_[instructions_.size() - 2];
  if (left.operation != Operation::linear || right.operation != Operation::linear) return false;
  const bool one_variable = left.variable < 0 || right.variable < 0 || left.variable == right.variable;
  const int variable = std::max(left.variable, right.variable);
  switch (instruction.operation) {
    case Operation::add:
    case Operation::subtract: {
      if (!one_variable) return false;
      const double sign = instruction.operation == Operation::add ? 1 : -1;
      left.factor += sign * right.factor;
      left.offset += sign * right.offset;
      break;
    }
    case Operation::multiply:
      if (left.is_variable() && right.is_variable() && left.variable == right.variable) {
        left.operation = Operation::power;
        left.exponent = 2;
      } else if (left.variable >= 0 && right.variable >= 0) {
        return false;
      } else {
        const double by = left.variable < 0 ? left.offset : right.offset;
        const Instruction of = left.variable < 0 ? right : left;
        left.factor = of.factor * by;
        left.offset = of.offset * by;
      }
      break;
    case Operation::divide:
      // x/c stays a quotient, whose rounding is that of the text.
      if (right.variable >= 0 || right.offset == 0 || left.is_variable()) return false;
      left.factor /= right.offset;
      left.offset /= right.offset;
      break;
    case Operation::raise: {
      if (right.variable >= 0 || !left.is_variable()) return false;
      const double exponent = right.offset;
      if (exponent != 2 && exponent != 3 && exponent != 4) return false;
      left.operation = Operation::power;
      left.exponent = static_cast<int>(exponent);
      break;
    }
    default:
      return false;
  }
  if (left.operation == Operation::linear) left.variable = variable;
  instructions_.pop_back();
  --depth_;
  return true;
}

void Program::append(const Instruction& instruction) {
  const auto count = static_cast<std::size_t>(taken(instruction.operation));
  const bool constants = count > 0 && std::all_of(instructions_.end() - static_cast<std::ptrdiff_t>(count),
                                                  instructions_.end(), [](const auto& i) { return i.is_constant(); });
  if (!constants && fold_linear(instruction)) return;
  instructions_.push_back(instruction);
  depth_ += 1 - count;
  most_depth_ = std::max(most_depth_, depth_);
  if (!constants) return;
  const std::vector<Instruction> folded(instructions_.end() - static_cast<std::ptrdiff_t>(count) - 1,
                                        instructions_.end());
  instructions_.resize(instructions_.size() - count);
  const auto no_variable = [](int) { return 0.0; };
  instructions_.back() = {.operation = Operation::linear,
                          .offset = run<double>(folded, count + 1, no_variable, nobody)};
}

double Program::at(std::span<const double> variables) const {
  return run<double>(
      instructions_, most_depth_, [&](int i) { return variables[static_cast<std::size_t>(i)]; }, nobody);
}

Dual Program::at(std::span<const double> variables, std::size_t first) const {
  const auto variable = [&](int i) {
    const auto index = static_cast<std::size_t>(i);
    Dual dual{variables[index]};
    if (index >= first) dual.by[index - first] = 1;
    return dual;
  };
  return run<Dual>(instructions_, most_depth_, variable, nobody);
}

std::vector<double> Program::pieces(std::span<const double> variables) const {
  std::vector<double> outcomes;
  run<double>(
      instructions_, most_depth_, [&](int i) { return variables[static_cast<std::size_t>(i)]; },
      [&](double value) { outcomes.push_back(value); });
  return outcomes;
}

bool Program::uses(int variable) const {
  return std::ranges::any_of(instructions_, [&](const Instruction& i) { return i.variable == variable; });
}

}  // namespace sprekk::formula
