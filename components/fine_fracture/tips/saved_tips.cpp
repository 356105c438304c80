// What checkpoints keep of tips beside fields.
#include <utility>

#include "components/fine_fracture/tips/tips.hpp"

namespace sprekk::fine_fracture {
namespace {

constexpr int state_size = 22;  ///< numbers of a state, without its path

void append(Vector& values, const Point& point) {
  values.conservativeResize(values.size() + 2);
  values.tail<2>() = point;
}

}  // namespace

void Tips::save(std::map<std::string, Vector>& state) const {
  for (const Tip& tip : tips_) {
    const State& kept = tip.accepted;
    const Point start = kept.segment_start.value_or(Point::Zero());
    Vector values(state_size);
    values << kept.sifs.k1, kept.sifs.k2, kept.sifs.t_stress, kept.grown, kept.is_stopped, kept.has_started,
        kept.sif_error, kept.warm_start.stiffness_ratio, kept.warm_start.release, kept.is_evaluated, kept.load,
        kept.is_extendable, kept.speed, kept.turning, kept.was_laid, start, kept.speed_before, kept.turning_before,
        kept.lasted, kept.lasted_before, kept.pressure_rate;
    for (const Point& place : kept.path.added) append(values, place);
    state[name() + "." + tip.name] = std::move(values);
  }
  state[name() + ".slopes"] = Eigen::Map<const Vector>(slopes_.data(), slopes_.size());
  for (const Joint& joint : joints_) state[name() + "." + joint.name] = Vector::Constant(1, joint.grown);
}

void Tips::restore(const std::map<std::string, Vector>& state) {
  for (Tip& tip : tips_) {
    const auto found = state.find(name() + "." + tip.name);
    if (found == state.end() || found->second.size() < state_size) continue;
    const Vector& values = found->second;
    State kept;
    kept.sifs = {values[0], values[1], values[2]};
    kept.grown = values[3];
    kept.is_stopped = values[4] != 0;
    kept.has_started = values[5] != 0;
    kept.sif_error = values[6];
    kept.warm_start = {values[7], values[8]};
    kept.is_evaluated = values[9] != 0;
    kept.load = values[10];
    kept.is_extendable = values[11] != 0;
    kept.speed = values[12];
    kept.turning = values[13];
    kept.speed_before = values[17];
    kept.turning_before = values[18];
    kept.lasted = values[19];
    kept.lasted_before = values[20];
    kept.pressure_rate = values[21];
    if (const Point start(values[15], values[16]); start != Point::Zero()) kept.segment_start = start;
    kept.was_laid = values[14] != 0;
    int at = state_size;
    const auto next = [&] {
      at += 2;
      return Point(values[at - 2], values[at - 1]);
    };
    while (at + 1 < values.size()) kept.path.added.push_back(next());
    tip.now = tip.accepted = kept;
  }
  if (const auto found = state.find(name() + ".slopes"); found != state.end()) {
    const auto size = 2 * static_cast<Eigen::Index>(tips_.size());
    if (found->second.size() == size * size) slopes_ = found->second.reshaped(size, size);
  }
  for (Joint& joint : joints_) {
    const auto found = state.find(name() + "." + joint.name);
    if (found != state.end() && found->second.size() == 1) joint.grown = found->second[0];
  }
}

}  // namespace sprekk::fine_fracture
