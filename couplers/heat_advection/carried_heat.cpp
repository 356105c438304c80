#include "couplers/heat_advection/carried_heat.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "framework/config/data.hpp"
#include "framework/field/counted_amounts.hpp"
#include "framework/field/ownership.hpp"
#include "framework/field/units_of_amounts.hpp"

namespace sprekk::couplers {
namespace {

constexpr double round_off_of_fluxes = 1e-14;  // of the products whose sum a flux is, for all fluxes of a cell
constexpr double small_part = 1e-9;            // of what flows through a cell
constexpr double noticeable_capacity = 1e-2;   // of that of a cell

}  // namespace

CarriedHeat::CarriedHeat(const CouplerContext& context, Field& field, Location place, const std::string& where,
                         double fluid_heat_capacity)
    : temperature(&field), location(place), mesh_(&context.mesh), fluid_heat_capacity_(fluid_heat_capacity) {
  received = &context.fields.add(*mesh_, amounts_with(field, context.name, "received_in_" + where, volume_unit,
                                                      "Fluid that has entered each cell, as its heat is counted"));
  cumulative = &context.fields.add(
      *mesh_, amounts_with(field, context.name, "cumulative_in_" + where, energy_unit,
                           "Heat of received fluid, and what fluid carried in from outside and out", 3));
}

void CarriedHeat::check(const Vector& capacity, const std::string& coupler) const {
  const Vector& fluid = received->accepted();
  if (capacity.size() != fluid.size()) return;
  Eigen::Index cell = 0;
  if (fluid.size() == 0 || (capacity + fluid_heat_capacity_ * fluid).minCoeff(&cell) > 0) return;
  throw DataError(fmt::format(
      "{}: the heat capacity of cell {} of {} is {:.3g} J/(m K), and that of the fluid that has left it {:.3g} J/(m K) "
      "(it is that of the cell with its fluid at the start, which cannot be less) give '{}.heat_capacity' and "
      "'fluid_heat_capacity' of one porosity, storage and compressibility, or smaller steps where the heat is solved "
      "before the flow",
      coupler, cell, temperature->name(), capacity[cell], -fluid_heat_capacity_ * fluid[cell],
      temperature->spec().owner));
}

void CarriedHeat::count(const std::vector<Stream>& streams, const std::vector<double>& temperatures,
                        const Vector& capacity, double base, double dt) {
  Vector sums = cumulative->accepted(), fluid = received->accepted();
  Vector net = Vector::Zero(fluid.size()), gross = net;
  for (std::size_t i = 0; i < streams.size(); ++i) {
    const Stream& stream = streams[i];
    net[stream.cell] += stream.rate;
    gross[stream.cell] += std::abs(stream.rate);
    if (!stream.is_outside) continue;
    const double heat = fluid_heat_capacity_ * dt * stream.rate * temperatures[i];
    if (stream.rate > 0)
      sums[3 * stream.cell + 1] += heat;
    else
      sums[3 * stream.cell + 2] -= heat;
  }
  // In long steps the round-off of what flows through a cell would pass for many times the fluid that it holds.
  const auto is_noise = [&](int i) {
    const double rate = std::abs(net[i]);
    return rate <= round_off_of_fluxes * base && rate <= small_part * gross[i] && capacity.size() == net.size() &&
           fluid_heat_capacity_ * dt * rate > noticeable_capacity * capacity[i];
  };
  for (int i = 0; i < fluid.size(); ++i)
    if (!is_noise(i)) fluid[i] += dt * net[i];
  exchange(*mesh_, location, 1, fluid);
  const Vector stored =
      fluid.cwiseProduct(temperature->now()) - received->accepted().cwiseProduct(temperature->accepted());
  for (int i = 0; i < fluid.size(); ++i) sums[3 * i] += fluid_heat_capacity_ * stored[i];
  exchange(*mesh_, location, 3, sums);
  received->set(std::move(fluid));
  cumulative->set(std::move(sums));
}

void CarriedHeat::add_to(Balance& heat) const { add_totals(heat, *mesh_, *cumulative); }

}  // namespace sprekk::couplers
