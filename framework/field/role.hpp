// The role of a field, and the kind of its equations for linear solvers.
#pragma once

#include "framework/linear/block_kind.hpp"

namespace sprekk {

/// The role of a field. unknown: determined by its owner's balance law. input: given to its owner; a coupler may
/// determine it, else it keeps its initial value. derived: follows from other fields; kept because its accepted value
/// is needed, or for output.
///
/// There is no default: a wrong kind of block gives the right answer, but many times slower, and no message would show
/// it.
class Role {
 public:
  static constexpr Role unknown(BlockKind kind) { return {Determination::unknown, kind}; }
  static constexpr Role input(BlockKind kind) { return {Determination::input, kind}; }
  static constexpr Role derived() { return {Determination::derived, BlockKind::interface}; }

  constexpr bool is_unknown() const { return determination_ == Determination::unknown; }
  constexpr bool is_input() const { return determination_ == Determination::input; }
  constexpr bool is_derived() const { return determination_ == Determination::derived; }
  /// The kind of block of an unknown or an input; without meaning for a derived field.
  constexpr BlockKind kind() const { return kind_; }

 private:
  enum class Determination { unknown, input, derived };
  constexpr Role(Determination determination, BlockKind kind) : determination_(determination), kind_(kind) {}

  Determination determination_;
  BlockKind kind_;
};

}  // namespace sprekk
