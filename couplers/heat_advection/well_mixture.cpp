#include "couplers/heat_advection/well_mixture.hpp"

#include <algorithm>

#include "framework/invariants.hpp"

namespace sprekk::couplers {
namespace {

/// What a well is open to, with the temperatures there.
struct Opening {
  int place, cell;
  bool is_fracture;
  double rate, temperature;
};

std::vector<Opening> openings(const WellPressures& wells, const HeatOfCells& rock, const HeatOfCells& fractures,
                              int well) {
  std::vector<Opening> openings;
  for (int k = 0; k < static_cast<int>(wells.places().size()); ++k) {
    if (wells.places()[k].well != well) continue;
    const AroundWell& around = wells.surroundings()[k];
    for (const HeatOfCells* medium : {&rock, &fractures})
      if (medium->temperature && medium->pressure == around.pressure)
        openings.push_back(
            {k, around.cell, medium == &fractures, wells.rate().now()[k], medium->temperature->now()[around.cell]});
  }
  return openings;
}

WellMixture mixture(const std::vector<Opening>& openings, std::optional<double> given) {
  double net = 0;
  for (const Opening& each : openings) net += each.rate;
  const bool from_outside = given && net > 0;
  double flow = from_outside ? net : 0, heat = from_outside ? net * *given : 0, mean = 0;
  for (const Opening& each : openings) {
    flow += std::max(-each.rate, 0.0);
    heat += std::max(-each.rate, 0.0) * each.temperature;
    mean += each.temperature / static_cast<double>(openings.size());
  }
  WellMixture mixture;
  mixture.temperature = flow > 0 ? heat / flow : mean;
  SPREKK_ASSERT(std::isfinite(mixture.temperature), flow, heat);
  for (const Opening& each : openings) {
    const bool flows_in = flow > 0 && each.rate < 0;
    const double part = flow > 0 ? std::max(-each.rate, 0.0) / flow : 1.0 / static_cast<double>(openings.size());
    if (part > 0) (each.is_fracture ? mixture.by_fractures : mixture.by_rock).push_back({each.cell, part});
    double by_rate = flows_in ? (mixture.temperature - each.temperature) / flow : 0;
    if (from_outside) by_rate += (*given - mixture.temperature) / flow;
    if (by_rate != 0) mixture.by_rate.push_back({each.place, by_rate});
  }
  return mixture;
}

}  // namespace

std::vector<std::optional<WellMixture>> mixtures(const WellPressures& wells, const HeatOfCells& rock,
                                                 const HeatOfCells& fractures,
                                                 const std::vector<std::optional<double>>& given) {
  const int count = static_cast<int>(wells.names().size());
  SPREKK_EXPECT(static_cast<int>(given.size()) == count, given.size(), count);
  SPREKK_EXPECT(wells.surroundings().size() == wells.places().size(), wells.surroundings().size());
  std::vector<std::optional<WellMixture>> mixtures(count);
  for (int well = 0; well < count; ++well) {
    const std::vector<Opening> open = openings(wells, rock, fractures, well);
    if (!open.empty()) mixtures[well] = mixture(open, given[well]);
  }
  return mixtures;
}

}  // namespace sprekk::couplers
