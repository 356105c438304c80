#include "couplers/advection/fluid_contents.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "framework/config/data.hpp"
#include "framework/field/counted_amounts.hpp"
#include "framework/field/ownership.hpp"
#include "framework/field/units_of_amounts.hpp"
#include "framework/noticeable.hpp"
#include "framework/round_off.hpp"

namespace sprekk::couplers {
namespace {

constexpr double round_off_of_fluxes = 1e-14;  // of the products whose sum a flux is, for all fluxes of a cell

}  // namespace

FluidContents::FluidContents(const CouplerContext& context, const Carried& carried, Field& field, Location place,
                             const std::string& where, double per_volume, Vector decay)
    : value(&field),
      location(place),
      decay(std::move(decay)),
      mesh_(&context.mesh),
      carried_(&carried),
      per_volume_(per_volume) {
  received = &context.fields.add(
      *mesh_, amounts_with(field, context.name, "received_in_" + where, volume_unit,
                           "Fluid that has entered each cell, as its " + carried.quantity + " is counted"));
  held = &context.fields.add(*mesh_,
                             amounts_with(field, context.name, "held_in_" + where, carried.unit + "*" + volume_unit,
                                          "Received fluid times the " + carried.value + " of its cell"));
  cumulative = &context.fields.add(
      *mesh_,
      amounts_with(field, context.name, "cumulative_in_" + where, carried.amount_unit,
                   capitalized(carried.quantity) + " of received fluid, and what fluid carried in from outside and out",
                   3));
}

Vector FluidContents::not_held_at_start() const {
  return per_volume_ * (received->accepted().cwiseProduct(value->accepted()) - held->accepted());
}

void FluidContents::check(const Vector& capacity, const std::string& coupler) const {
  const Vector& fluid = received->accepted();
  if (capacity.size() != fluid.size()) return;
  Eigen::Index cell = 0;
  if (fluid.size() == 0 || (capacity + per_volume_ * fluid).minCoeff(&cell) > 0) return;
  throw DataError(fmt::format(
      "{}: the {} of cell {} of {} is {:.3g} {}, and that of the fluid that has left it {:.3g} {} (it is that of the "
      "cell with its fluid at the start, which cannot be less) {}, or smaller steps where the {} is solved before the "
      "flow",
      coupler, carried_->capacity, cell, value->name(), capacity[cell], carried_->capacity_unit,
      -per_volume_ * fluid[cell], carried_->capacity_unit,
      fmt::format(fmt::runtime(carried_->advice), value->spec().owner), carried_->quantity));
}

void FluidContents::count(const std::vector<Stream>& streams, const std::vector<double>& values, const Vector& capacity,
                          double base, double dt) {
  Vector sums = cumulative->accepted(), fluid = received->accepted();
  Vector net = Vector::Zero(fluid.size()), gross = net;
  for (std::size_t i = 0; i < streams.size(); ++i) {
    const Stream& stream = streams[i];
    net[stream.cell] += stream.rate;
    gross[stream.cell] += std::abs(stream.rate);
    if (!stream.is_outside) continue;
    const double amount = per_volume_ * dt * stream.rate * values[i];
    if (stream.rate > 0)
      sums[3 * stream.cell + 1] += amount;
    else
      sums[3 * stream.cell + 2] -= amount;
  }
  // In long steps the round-off of what flows through a cell would pass for many times the fluid that it holds.
  const auto is_noise = [&](int i) {
    const double rate = std::abs(net[i]);
    return rate <= round_off_of_fluxes * base && rate <= rounding::same * gross[i] && capacity.size() == net.size() &&
           per_volume_ * dt * rate > noticeable * capacity[i];
  };
  for (int i = 0; i < fluid.size(); ++i)
    if (!is_noise(i)) fluid[i] += dt * net[i];
  exchange(*mesh_, location, 1, fluid);
  Vector holds = fluid.cwiseProduct(value->now());
  const Vector stored = holds - held->accepted();
  for (int i = 0; i < fluid.size(); ++i) sums[3 * i] += per_volume_ * stored[i];
  if (decay.size() > 0)
    for (int i = 0; i < fluid.size(); ++i)
      sums[3 * i + 2] += dt * decay[i] * per_volume_ * received->accepted()[i] * value->now()[i];
  exchange(*mesh_, location, 3, sums);
  received->set(std::move(fluid));
  held->set(std::move(holds));
  cumulative->set(std::move(sums));
}

void FluidContents::add_to(Balance& balance) const { add_totals(balance, *mesh_, *cumulative); }

}  // namespace sprekk::couplers
