#include "couplers/advection/well_mixture.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "framework/config/data.hpp"
#include "framework/config/input_error.hpp"
#include "framework/field/units_of_amounts.hpp"
#include "framework/invariants.hpp"
#include "framework/round_off.hpp"

namespace sprekk::couplers {
namespace {

/// A cell to which a well is open at one of its places, with its share of the rate there and with its value.
struct Opening {
  int place, cell;
  bool is_fracture;
  double share, rate, value;
};

std::vector<Opening> openings(const ValuesOfWells& around_wells, const Vector& rates, int well) {
  const WellPressures& wells = *around_wells.wells;
  std::vector<Opening> openings;
  for (int k = 0; k < static_cast<int>(wells.places().size()); ++k) {
    if (wells.places()[k].well != well) continue;
    const AroundWell& around = wells.surroundings()[k];
    for (const ValuesOfCells* medium : {&around_wells.rock, &around_wells.fractures})
      if (medium->value && medium->pressure == around.pressure)
        for (const auto& [cell, share] : parts_in_well(around))
          openings.push_back(
              {k, cell, medium == &around_wells.fractures, share, share * rates[k], medium->value->now()[cell]});
  }
  return openings;
}

WellMixture mixture(const std::vector<Opening>& openings, std::optional<double> given) {
  double net = 0, places = 0;
  for (const Opening& each : openings) {
    net += each.rate;
    places += each.share;
  }
  const bool from_outside = given && net > 0;
  double flow = from_outside ? net : 0, carried = from_outside ? net * *given : 0, mean = 0;
  for (const Opening& each : openings) {
    flow += std::max(-each.rate, 0.0);
    carried += std::max(-each.rate, 0.0) * each.value;
    mean += each.share * each.value / places;
  }
  WellMixture mixture;
  mixture.value = flow > 0 ? carried / flow : mean;
  SPREKK_ASSERT(std::isfinite(mixture.value), flow, carried);
  for (const Opening& each : openings) {
    const bool flows_in = flow > 0 && each.rate < 0;
    const double part = flow > 0 ? std::max(-each.rate, 0.0) / flow : each.share / places;
    if (part != 0) (each.is_fracture ? mixture.by_fractures : mixture.by_rock).push_back({each.cell, part});
    double by_rate = flows_in ? (mixture.value - each.value) / flow : 0;
    if (from_outside) by_rate += (*given - mixture.value) / flow;
    if (by_rate != 0) mixture.by_rate.push_back({each.place, each.share * by_rate});
  }
  return mixture;
}

}  // namespace

std::vector<std::pair<int, double>> parts_in_well(const AroundWell& around) {
  double all = 0;
  for (const auto& [cell, share] : around.shares) all += std::max(share, 0.0);
  std::vector<std::pair<int, double>> parts;
  for (const auto& [cell, share] : around.shares)
    if (share > 0) parts.emplace_back(cell, share / all);
  return parts;
}

bool ValuesOfWells::is_known(const AroundWell& around) const {
  return (rock.value && around.pressure == rock.pressure) || (fractures.value && around.pressure == fractures.pressure);
}

Mixtures ValuesOfWells::mixtures(const Vector& rates) const {
  if (!wells) return {};
  SPREKK_EXPECT(injected.size() == wells->names().size(), injected.size());
  SPREKK_EXPECT(wells->surroundings().size() == wells->places().size(), wells->surroundings().size());
  Mixtures mixtures(injected.size());
  for (std::size_t well = 0; well < mixtures.size(); ++well) {
    const std::vector<Opening> open = openings(*this, rates, static_cast<int>(well));
    if (!open.empty()) mixtures[well] = mixture(open, injected[well]);
  }
  return mixtures;
}

void ValuesOfWells::check(const std::string& coupler) const {
  if (!wells) return;
  std::vector<char> has_known(wells->names().size(), false), has_unknown = has_known;
  for (std::size_t k = 0; k < wells->places().size(); ++k)
    (is_known(wells->surroundings().at(k)) ? has_known : has_unknown)[wells->places()[k].well] = true;
  for (const WellPlace& place : wells->places()) {
    const std::string& well = wells->names()[place.well];
    if (has_known[place.well] && has_unknown[place.well])
      throw DataError(
          InputError(place.origin, "the " + carried->value + " of the fluid in well '" + well + "' is not known",
                     "one of the places to which it is open has no " + carried->value + " in " + coupler,
                     "name the flow and the " + carried->quantity + " there in 'between', or make two wells of it")
              .what());
    if (has_known[place.well] && wells->is_to_inject(place.well) && !injected[place.well])
      throw DataError(InputError(place.origin, "the fluid that well '" + well + "' injects has no " + carried->value,
                                 "coupler " + coupler + " carries " + carried->quantity,
                                 "write 'injected: {" + well + ": {" + carried->value + ": " + carried->example +
                                     "}}' in " + coupler)
                          .what());
  }
}

void ValuesOfWells::note(const std::string& coupler, Notes& notes) const {
  if (!wells) return;
  const Vector& rates = wells->rate().now();
  Vector net = Vector::Zero(static_cast<int>(wells->names().size()));
  for (std::size_t k = 0; k < wells->places().size(); ++k)
    if (is_known(wells->surroundings()[k])) net[wells->places()[k].well] += rates[static_cast<int>(k)];
  for (int well = 0; well < net.size(); ++well)
    if (!injected[well] && net[well] > rounding::far_above * rates.lpNorm<Eigen::Infinity>())
      notes.add(coupler + ": fluid of " + wells->names()[well] + " without a " + carried->value,
                fmt::format("well '{}' injects {:.3g} {} of fluid that has no {} (it enters with that of "
                            "what flows into the well elsewhere, or of the cell) give one under 'injected' of {}",
                            wells->names()[well], net[well], volume_rate_unit, carried->value, coupler),
                net[well]);
}

}  // namespace sprekk::couplers
