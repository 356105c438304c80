// The condition on a side of the rock.
#pragma once

#include <optional>
#include <vector>

#include "framework/config/data.hpp"
#include "framework/config/input_error.hpp"

namespace sprekk::matrix_flow {

/// The condition on one side of the outer boundary: one of pressure, flux and outer pressure; without them no fluid
/// flows through the side.
struct SideCondition {
  Origin origin;
  std::optional<Data> pressure;        ///< Pa
  std::optional<Data> flux;            ///< m/s, out of the rock
  std::optional<Data> outer_pressure;  ///< Pa, see LeakySides
  std::optional<Data> conductance;     ///< m/(Pa s)
  bool only_out = false;
  bool is_leaky() const { return outer_pressure.has_value(); }
  std::vector<const Data*> data() const {
    std::vector<const Data*> given;
    for (const std::optional<Data>* one : {&pressure, &flux, &outer_pressure, &conductance})
      if (*one) given.push_back(&**one);
    return given;
  }
};

}  // namespace sprekk::matrix_flow
