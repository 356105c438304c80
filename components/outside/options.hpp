// The parameters of a component that is another program.
#pragma once

#include <map>
#include <string>
#include <utility>
#include <vector>

#include "framework/config/spec.hpp"
#include "framework/field/field.hpp"

namespace sprekk::outside {

/// A field that the program determines.
struct GivenOptions {
  Origin origin;
  std::string on = "cells";
  int components = 1;
  std::string unit, initial;
  Origin initial_origin;
  std::string as = "field";
  Data start;  ///< `initial` in its unit

  Location location() const;
  Spec spec();
};

/// The parameters of the component.
struct Options {
  std::map<std::string, GivenOptions> gives;
  std::vector<std::string> takes;
  Origin takes_origin;
  std::vector<std::pair<std::string, double>> parameters;  ///< in SI units
  double timeout = 600;  ///< s; longer than most programs need for a step, shorter than anybody watches nothing happen
  Spec spec();
};

}  // namespace sprekk::outside
