// What checkpoints keep of tips beside fields.
#include <utility>

#include "components/fine_fracture/quarter_point/tips.hpp"

namespace sprekk::fine_fracture {
namespace {

constexpr int state_size = 15;  ///< numbers of a state, without its way and its path

}  // namespace

void Tips::save(std::map<std::string, Vector>& state) const {
  for (const Tip& tip : tips_) {
    const State& kept = tip.accepted;
    std::vector<Point> places = kept.way;
    places.insert(places.end(), kept.path.added.begin(), kept.path.added.end());
    Vector values(state_size + 2 * places.size());
    values.head<state_size>() << kept.sifs.k1, kept.sifs.k2, kept.sifs.t_stress, kept.grown, kept.is_stopped,
        kept.has_started, kept.sif_error, kept.warm_start.stiffness_ratio, kept.warm_start.release, kept.is_evaluated,
        kept.load, kept.is_extendable, kept.speed, kept.turning, static_cast<double>(kept.way.size());
    for (std::size_t i = 0; i < places.size(); ++i) values.segment<2>(state_size + 2 * i) = places[i];
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
    for (int i = state_size; i + 1 < values.size(); i += 2)
      (i < state_size + 2 * values[14] ? kept.way : kept.path.added).emplace_back(values[i], values[i + 1]);
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
