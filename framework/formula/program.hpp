// A formula as a stack program.
#pragma once

#include <array>
#include <cstddef>
#include <span>
#include <string>
#include <vector>

namespace sprekk::formula {

/// The most variables by which a program gives derivatives.
inline constexpr std::size_t most_derivatives = 8;

using Function1 = double (*)(double);
/// A function of one value, with its derivative as a function of the same value. Without a derivative it is constant in
/// pieces, and jumps between them.
struct NamedFunction {
  const char* name;
  Function1 value, derivative;
};
/// All functions of one value.
std::span<const NamedFunction> functions_of_one();

/// What an instruction does with the numbers on top of the stack.
enum class Operation {
  linear,  ///< pushes factor · variable + offset
  power,   ///< pushes variable^2, ^3 or ^4, as products
  add,
  subtract,
  multiply,
  divide,
  raise,
  negate,
  less,
  less_equal,
  greater,
  greater_equal,
  equal,
  not_equal,
  both,
  either,
  apply,  ///< a function of one value
  arc_tangent_of_two,
  minimum,
  maximum,
  select  ///< condition, value, other value: the value where the condition is not zero
};

/// An instruction. `variable` is an index among the variables, -1 for none; a constant is linear without a variable.
struct Instruction {
  Operation operation;
  int variable = -1;
  double factor = 0, offset = 0;
  int exponent = 0;
  const NamedFunction* function = nullptr;

  bool is_constant() const { return operation == Operation::linear && variable < 0; }
  bool is_variable() const { return operation == Operation::linear && variable >= 0 && factor == 1 && offset == 0; }
};

/// A value and its derivatives.
struct Dual {
  double value = 0;
  std::array<double, most_derivatives> by{};
};

/// What a formula does, in reverse Polish order. Programs are values, and may be evaluated by several threads.
class Program {
 public:
  /// Appends an instruction. Constants are folded, and sums and multiples of one variable become one instruction.
  void append(const Instruction& instruction);

  /// The value where the variables have these values.
  double at(std::span<const double> variables) const;
  /// The value, with derivatives by the variables from `first` on. `max`, `min`, `abs` and conditions have the
  /// derivative of their piece.
  Dual at(std::span<const double> variables, std::size_t first) const;
  /// In which piece the program is: the outcomes of its comparisons, and the values of its functions that jump. Where
  /// two points have the same outcomes, the program has no jump between them.
  std::vector<double> pieces(std::span<const double> variables) const;

  bool uses(int variable) const;
  const std::vector<Instruction>& instructions() const { return instructions_; }

 private:
  bool fold_linear(const Instruction& instruction);
  std::vector<Instruction> instructions_;
  std::size_t depth_ = 0, most_depth_ = 0;
};

}  // namespace sprekk::formula
