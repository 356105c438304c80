// Who takes a formula that somebody else has been given.
#pragma once

#include <string>

namespace sprekk {

/// A guard: while it exists, the parameter of this name is being read.
class ReadsParameter {
 public:
  explicit ReadsParameter(const std::string& name);
  ~ReadsParameter();
  ReadsParameter(const ReadsParameter&) = delete;
  ReadsParameter& operator=(const ReadsParameter&) = delete;

 private:
  const std::string* before_;
};

/// "'p' may be named by 'permeability' of matrix_flow/mpfa, …, not of this component": the specs whose parameter of the
/// name that is being read may be a formula of this variable; "" for none.
std::string formula_takers(const std::string& variable);

}  // namespace sprekk
