// The balance of what streams carry.
#include "couplers/advection/advection.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>

#include "framework/assembly/balance_rows.hpp"
#include "framework/field/ownership.hpp"
#include "framework/invariants.hpp"
#include "framework/matrix_of.hpp"

namespace sprekk::couplers {
namespace {

/// Relative to the content of a cell: the fluid that it gains in steady flow is round-off, and grows a little with each
/// step. In derivatives it would cause a factorization in each step; leaving it out there changes nothing beyond
/// round-off.
constexpr double round_off_of_steps = 1e-11;

/// `of_fluid` with 0 where it may be round-off beside `of_cell`.
Vector without_round_off(const Vector& of_fluid, const Vector& of_cell) {
  if (of_cell.size() != of_fluid.size()) return of_fluid;
  return (of_fluid.array().abs() > round_off_of_steps * of_cell.array()).select(of_fluid, 0.0);
}

/// What flows out of each cell of a list of streams, and the streams that take it there.
struct Outflows {
  Outflows(const std::vector<Stream>& streams, int cells) : rate(Vector::Zero(cells)), by(cells) {
    for (const Stream& stream : streams) {
      if (stream.rate >= 0) continue;
      rate[stream.cell] -= stream.rate;
      if (stream.flux != Stream::Flux::none) by[stream.cell].push_back(&stream);
    }
  }
  Vector rate;
  std::vector<std::vector<const Stream*>> by;
};

}  // namespace

double Advection::value_of(const FluidContents& place, const Stream& stream, const Mixtures& wells) const {
  const double own = place.value->now()[stream.cell];
  if (stream.rate <= 0) return own;
  switch (stream.from) {
    case Stream::From::given:
      return stream.value;
    case Stream::From::well:
      return wells[stream.index]->value;
    case Stream::From::rock_cell:
      return rock_.value->now()[stream.index];
    case Stream::From::fracture_cell:
      return fractures_.value->now()[stream.index];
    case Stream::From::own:
      break;
  }
  return own;
}

const std::optional<LimitedValues>& Advection::limited_of(const FluidContents& place) const {
  return place.location == Location::cell ? limited_in_rock_ : limited_in_fractures_;
}

Vector Advection::weights_of(const FluidContents& place, const std::vector<Stream>& streams,
                             const StepTime& step) const {
  if (!limited_of(place)) return {};
  Vector capacity = place.capacity_at_start();
  const Vector& at_start = place.location == Location::cell ? in_rock_->capacity() : in_fractures_->capacity();
  if (at_start.size() == capacity.size()) capacity += at_start;
  // A state that is settled rests in the equations of the first step.
  const double length = step.end == step.start ? begun_with_ : step.dt;
  return limited_of(place)->weights(streams, capacity, options_.per_volume * length);
}

void Advection::add(Assembly& assembly, const FluidContents& place, const std::vector<Stream>& streams,
                    const Mixtures& wells, const StepTime& step) const {
  const Field& unknown = *place.value;
  const double scale = options_.per_volume * step.dt;
  const Vector capacity = place.capacity_at_start();
  Vector carried = Vector::Zero(unknown.size()), through_sides = carried;
  double largest = 0, largest_rate = 0, largest_difference = 0;
  const std::optional<LimitedValues>& limited = limited_of(place);
  const Vector weights = weights_of(place, streams, step);
  std::vector<Triplet> own, of_rock, of_fractures, changes;
  std::array<std::vector<Triplet>, 4> by_flux;  // by Stream::Flux
  std::optional<Outflows> outflows;             // on which the weights depend
  if (weights.size() > 0 && weights.minCoeff() < 1 && assembly.wants_derivatives())
    outflows.emplace(streams, static_cast<int>(unknown.size()));
  for (const Stream& stream : streams) {
    SPREKK_ASSERT(std::isfinite(stream.rate), stream.cell, stream.rate);
    const bool enters = stream.rate > 0 && stream.from != Stream::From::own;
    const LimitedValues::Change change =
        limited ? limited->of(stream, unknown.now(), weights) : LimitedValues::Change{};
    for (const auto& [cell, by] : change.by_cells) changes.emplace_back(stream.cell, cell, -scale * stream.rate * by);
    if (!enters && change.value == 0) continue;
    if (const int from = stream.rate > 0 ? stream.index : stream.cell;
        outflows && change.value != 0 && weights[from] < 1)
      for (const Stream* other : outflows->by[from])
        by_flux[static_cast<int>(other->flux)].emplace_back(
            stream.cell, other->flux_index,
            -scale * stream.rate * change.value * other->by_flux / outflows->rate[from]);
    const double difference =
        (enters ? unknown.now()[stream.cell] - value_of(place, stream, wells) : 0.0) - change.value;
    const double amount = scale * stream.rate * difference;
    carried[stream.cell] += amount;
    if (stream.is_outside) through_sides[stream.cell] += std::abs(amount);
    largest = std::max(largest, std::abs(amount));
    largest_rate = std::max(largest_rate, std::abs(stream.rate));
    if (stream.flux == Stream::Flux::face || stream.flux == Stream::Flux::wall)
      largest_difference = std::max(largest_difference, std::abs(difference));
    if (enters) own.emplace_back(stream.cell, stream.cell, scale * stream.rate);
    if (enters && stream.from == Stream::From::rock_cell)
      of_rock.emplace_back(stream.cell, stream.index, -scale * stream.rate);
    if (enters && stream.from == Stream::From::fracture_cell)
      of_fractures.emplace_back(stream.cell, stream.index, -scale * stream.rate);
    if (stream.from == Stream::From::well) {
      const WellMixture& well = *wells[stream.index];
      const double amount_by_value = -scale * stream.rate;
      for (const auto& [cell, value] : well.by_rock) of_rock.emplace_back(stream.cell, cell, amount_by_value * value);
      for (const auto& [cell, value] : well.by_fractures)
        of_fractures.emplace_back(stream.cell, cell, amount_by_value * value);
      for (const auto& [place_of_well, value] : well.by_rate)
        by_flux[static_cast<int>(Stream::Flux::well)].emplace_back(stream.cell, place_of_well, amount_by_value * value);
    }
    if (stream.flux != Stream::Flux::none)
      by_flux[static_cast<int>(stream.flux)].emplace_back(stream.cell, stream.flux_index,
                                                          scale * stream.by_flux * difference);
    for (const auto& [ridge, by_flux_there] : stream.by_ridges)
      by_flux[static_cast<int>(Stream::Flux::ridge)].emplace_back(stream.cell, ridge,
                                                                  scale * by_flux_there * difference);
  }
  assembly.add(unknown, capacity.cwiseProduct(unknown.now() - unknown.accepted()) + place.not_held_at_start());
  assembly.add(unknown, carried);
  const Vector decaying = place.decay.size() > 0 ? Vector(step.dt * place.decay.cwiseProduct(capacity)) : Vector();
  if (decaying.size() > 0) BalanceRows(assembly, unknown).supply(-decaying.cwiseProduct(unknown.now()));
  assembly.compare_with(unknown, largest);
  assembly.compare_round_off(unknown, scale * largest_rate * unknown.now().lpNorm<Eigen::Infinity>());
  if (largest_difference > 0)  // fluxes through faces and walls are differences of larger numbers
    assembly.compare_round_off(unknown, scale * largest_difference * matrix_->round_off_base_of_fluxes());
  BalanceRows(assembly, unknown).add_throughput(through_sides);
  if (!assembly.wants_derivatives()) return;
  const auto block = [&](const std::vector<Triplet>& entries, int columns) {
    return matrix_of(unknown.size(), columns, entries);
  };
  Vector slope =
      without_round_off(capacity, place.location == Location::cell ? in_rock_->capacity() : in_fractures_->capacity());
  if (place.decay.size() > 0) slope += step.dt * place.decay.cwiseProduct(slope);
  assembly.diagonal(unknown, unknown, slope);
  std::vector<Triplet>& same = place.location == Location::cell ? of_rock : of_fractures;
  same.insert(same.end(), own.begin(), own.end());
  same.insert(same.end(), changes.begin(), changes.end());
  for (const auto& [other, entries] : {std::pair{&rock_, &of_rock}, std::pair{&fractures_, &of_fractures}})
    if (other->value && !entries->empty())
      assembly.derivative(unknown, *other->value, block(*entries, other->value->size()));
  const auto entries_of = [&](Stream::Flux flux) -> const std::vector<Triplet>& {
    return by_flux[static_cast<int>(flux)];
  };
  if (const auto& entries = entries_of(Stream::Flux::face); !entries.empty()) {
    const SparseMatrix of_faces = block(entries, mesh_.face_count());
    for (const MatrixFluxes::Derivative& derivative : matrix_->face_flux_derivatives())
      if (assembly.has_row(*derivative.field))
        assembly.derivative(unknown, *derivative.field, SparseMatrix(of_faces * *derivative.matrix));
  }
  if (const auto& entries = entries_of(Stream::Flux::wall); !entries.empty())
    assembly.derivative(unknown, walls_->wall_flux(), block(entries, mesh_.wall_count()));
  if (const auto& entries = entries_of(Stream::Flux::ridge); !entries.empty())
    assembly.derivative(unknown, fracture_->flux(), block(entries, fracture_->flux().size()));
  if (const auto& entries = entries_of(Stream::Flux::well); !entries.empty())
    assembly.derivative(unknown, wells_.wells->rate(), block(entries, wells_.wells->rate().size()));
}

void Advection::count(FluidContents& place, const std::vector<Stream>& streams, const Mixtures& wells,
                      const StepTime& step) {
  std::vector<double> values;
  const std::optional<LimitedValues>& limited = limited_of(place);
  const Vector weights = weights_of(place, streams, step);
  for (const Stream& stream : streams) {
    values.push_back(value_of(place, stream, wells));
    if (limited && stream.rate < 0) values.back() += limited->of(stream, place.value->now(), weights).value;
  }
  const Vector& capacity = &place == &rock_ ? in_rock_->capacity() : in_fractures_->capacity();
  place.count(streams, values, capacity, matrix_ ? matrix_->round_off_base_of_fluxes() : 0, step.dt);
}

}  // namespace sprekk::couplers
