// From the text of a formula to its program.
#pragma once

#include <string>
#include <utility>
#include <vector>

#include "framework/formula/program.hpp"

namespace sprekk::formula {

/// What names in a formula mean, besides functions, pi and e. A name that is both is the variable.
struct Names {
  std::vector<std::string> variables;
  std::vector<std::pair<std::string, double>> units;  ///< with their values
  std::vector<std::string> suggested_units;           ///< that messages name
};

/// Thrown for a text that is no formula: parts of a message without the text and its place.
struct Problem {
  std::string has;  ///< " has 'sin(45)'"; "" for a text that is malformed
  std::string why, suggestion;
  std::string unknown = {};             ///< a name that nothing has
  std::vector<std::string> known = {};  ///< those that may be meant
};

/// A formula that has been read.
struct Parsed {
  Program program;
  bool mentions_unit = false;
};

/// Reads a formula: + - * / ^, comparisons, && and ||, c ? a : b, if(c, a, b), and functions. Throws Problem.
Parsed parse(const std::string& text, const Names& names);

}  // namespace sprekk::formula
