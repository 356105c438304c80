#include "framework/mesh/ways_to_middle.hpp"

#include <algorithm>
#include <map>

namespace sprekk {

namespace {

/// The mean of the conductivities of a fracture's arms, so that one sealed arm does not seal the crossing; then the
/// mean of the resistivities of the fractures.
double harmonic_mean(const std::vector<CrossingArm>& arms) {
  struct Sum {
    double conductivity = 0;
    int arms = 0;
  };
  std::map<int, Sum> fractures;
  for (const CrossingArm& arm : arms) {
    if (arm.width == 0) continue;
    fractures[arm.fracture].conductivity += 1 / arm.resistivity;
    ++fractures[arm.fracture].arms;
  }
  double resistivity = 0;
  for (const auto& [fracture, sum] : fractures) resistivity += sum.arms / sum.conductivity;
  return resistivity / static_cast<double>(fractures.size());
}

bool are_alike(const std::vector<CrossingArm>& arms) {
  const CrossingArm* first = nullptr;
  for (const CrossingArm& arm : arms) {
    if (arm.width == 0) continue;
    if (first && arm.resistivity != first->resistivity) return false;
    if (!first) first = &arm;
  }
  return true;
}

/// The width of the widest other fracture; 0 without one.
double width_of_others(const std::vector<CrossingArm>& arms, int fracture) {
  double width = 0;
  for (const CrossingArm& arm : arms)
    if (arm.fracture != fracture) width = std::max(width, arm.width);
  return width;
}

void pass_walls(const std::vector<CrossingArm>& arms, int through, std::vector<WayToMiddle>& ways) {
  double width = 0, across = 0;
  int count = 0;
  for (const CrossingArm& arm : arms) {
    if (arm.fracture != through) continue;
    width = std::max(width, arm.width);
    across += arm.across;
    ++count;
  }
  if (count == 0) return;
  for (std::size_t i = 0; i < arms.size(); ++i)
    if (arms[i].fracture != through && arms[i].width > 0)
      ways[i] = {1 - std::min(1.0, 0.5 * width / arms[i].length), across / count / arms[i].width};
}

}  // namespace

std::vector<WayToMiddle> ways_to_middle(const std::vector<CrossingArm>& arms, const CrossingFill& fill) {
  std::vector<WayToMiddle> ways(arms.size());
  const auto meeting = std::count_if(arms.begin(), arms.end(), [](const CrossingArm& arm) { return arm.width > 0; });
  if (!fill.is_said() && (meeting < 3 || are_alike(arms))) return ways;
  if (fill.through != none) {
    pass_walls(arms, fill.through, ways);
    return ways;
  }
  const double resistivity = fill.resistivity ? *fill.resistivity : harmonic_mean(arms);
  for (std::size_t i = 0; i < arms.size(); ++i) {
    const double others = width_of_others(arms, arms[i].fracture);
    if (arms[i].width == 0 || others == 0) continue;
    const double within = std::min(0.5 * others, arms[i].length);
    ways[i] = {1 - within / arms[i].length, within * resistivity / arms[i].width};
  }
  return ways;
}

}  // namespace sprekk
