// The value (temperature, concentration) of the fluid in wells: a mixture of what flows in.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "components/capabilities/carried.hpp"
#include "components/capabilities/wells.hpp"
#include "framework/assembly/notes.hpp"
#include "framework/types.hpp"

namespace sprekk::couplers {

/// The value in cells of the rock, or of fractures; null pointers if there is none.
struct ValuesOfCells {
  const Field* pressure = nullptr;  ///< of the flow there
  const Field* value = nullptr;
};

/// The fluid in a well, which is mixed and stores nothing. It flows in at some of its places, with the values T_k
/// of the cells there, and with a net rate Q = sum of q_k > 0 from outside with T_given:
///   T = (sum over q_k < 0 of −q_k T_k + max(Q, 0) T_given)/(sum over q_k < 0 of −q_k + max(Q, 0)).
/// The fluid leaves the well with T, at other places and to the outside.
struct WellMixture {
  /// The derivative by the rate at a place (for heat K s/m^2, in space K s/m^3), or by the value of a cell.
  struct Derivative {
    int index;
    double value;
  };
  double value = 0;  ///< the mean of the cells where nothing flows
  std::vector<Derivative> by_rate, by_rock, by_fractures;
};

/// The cells with which a well exchanges fluid at a place, and the parts of its rate there: those with a positive
/// share. What a negative share takes from its cell passes to these cells outside of the well.
std::vector<std::pair<int, double>> parts_in_well(const AroundWell& around);

using Mixtures = std::vector<std::optional<WellMixture>>;

/// Wells, and the values around them.
struct ValuesOfWells {
  const WellPressures* wells = nullptr;
  ValuesOfCells rock, fractures;
  const Carried* carried = nullptr;
  std::vector<std::optional<double>> injected;  ///< of what comes from outside, one a well

  bool is_known(const AroundWell& around) const;
  /// One mixture a well; empty for a well that is open to no cell with a value. `rates`: out of the well at each place,
  /// m^2/s (in space m^3/s).
  Mixtures mixtures(const Vector& rates) const;
  /// Throws DataError where the fluid that a well brings has no value. `coupler`: its name.
  void check(const std::string& coupler) const;
  /// Notes wells that let fluid in without a value.
  void note(const std::string& coupler, Notes& notes) const;
};

}  // namespace sprekk::couplers
