// The figures of tips in history.csv and run.json.
#include <limits>

#include "components/fine_fracture/tips/ends.hpp"
#include "components/fine_fracture/tips/tips.hpp"

namespace sprekk::fine_fracture {

void Tips::report(std::vector<Quantity>& quantities) const {
  // In the order of ends: columns keep their places when a tip joins another fracture and is no tip any more.
  for (const TipEnd& end : all_ends(mesh_)) {
    for (const Tip& tip : tips_) {
      if (!is_same(tip.end, end)) continue;
      const double length = tip.now.grown + length_of(position(tip, {}), tip.now.path);
      report_end(tip.name, tip.now,
                 {position(tip, tip.now.path), length, tip.length_at_start, options_.toughness ? toughness(tip) : 0,
                  equivalent_sif(felt(tip))},
                 quantities);
    }
    State at_rest;
    at_rest.is_stopped = true;
    for (const Joint& joint : joints_)
      if (is_same(joint.end, end))
        report_end(joint.name, at_rest,
                   {end_point(mesh_, end), joint.grown, joint.length_at_start,
                    options_.toughness ? toughness(end, end_point(mesh_, end)) : 0, 0},
                   quantities);
  }
}

void Tips::report_end(const std::string& end, const State& state, const EndGrowth& growth,
                      std::vector<Quantity>& quantities) const {
  const std::string prefix = name() + "." + end + ".";
  const auto known = [&state](double value) {
    return state.is_evaluated ? value : std::numeric_limits<double>::quiet_NaN();
  };
  quantities.push_back({prefix + "K_I", "Pa*m^0.5", known(state.sifs.k1)});
  quantities.push_back({prefix + "K_II", "Pa*m^0.5", known(state.sifs.k2)});
  quantities.push_back({prefix + "K_eq", "Pa*m^0.5", known(growth.equivalent)});
  quantities.push_back({prefix + "K_error_fine_mesh", "Pa*m^0.5", known(state.sif_error)});
  quantities.push_back({prefix + "stopped", "1", state.is_stopped ? 1.0 : 0.0});
  quantities.push_back({prefix + "length", "m", growth.length});
  // Where growth is looked for in some of the steps only, nothing grows in the others.
  const double grown = examined_ == step_.start ? growth.length - growth.length_at_start : 0;
  quantities.push_back({prefix + "x", "m", growth.position[0]});
  quantities.push_back({prefix + "y", "m", growth.position[1]});
  quantities.push_back({prefix + "speed", "m/s", grown > 0 ? grown / step_.dt : 0.0});
  quantities.push_back({prefix + "grows", "1", grown > 0 ? 1.0 : 0.0});
  if (!options_.toughness) return;
  quantities.push_back({prefix + "apparent_toughness", "Pa*m^0.5",
                        grown > 0 && state.apparent_toughness > 0 ? state.apparent_toughness : growth.toughness});
}

std::vector<MovingTips::Tip> Tips::moving_tips() const {
  std::vector<MovingTips::Tip> moving;
  if (examined_ != step_.start) return moving;
  for (const Tip& tip : tips_) {
    const double grown = tip.now.grown + length_of(position(tip, {}), tip.now.path) - tip.length_at_start;
    if (grown > 0) moving.push_back({tip.end.fracture, tip.end.at_end, grown / step_.dt});
  }
  return moving;
}

std::vector<PendingPath> Tips::pending_paths() const {
  std::vector<PendingPath> paths;
  for (const Tip& tip : tips_) {
    if (tip.now.path.added.empty()) continue;
    paths.push_back({tip.end.fracture, {position(tip, {})}});
    std::vector<Point>& points = paths.back().points;
    points.insert(points.end(), tip.now.path.added.begin(), tip.now.path.added.end());
  }
  return paths;
}

std::map<std::string, long> Tips::counts() const {
  return {{"tips: solves", solves_},
          {"tips: meshes", meshes_},
          {"tips: answers kept", kept_},
          {"tips: ruled out", skipped_},
          {"tips: increments", increments_}};
}

std::vector<Profile::Entry> Tips::efforts() const {
  std::vector<Profile::Entry> efforts(profile_->entries().begin(), profile_->entries().end());
  for (Profile::Entry& effort : efforts) effort.name = "tips: " + effort.name;
  return efforts;
}

}  // namespace sprekk::fine_fracture
