// Which tips grow in a search for a front, and the equations that their loads and advances have to fulfil.
#include <algorithm>
#include <cmath>

#include "components/fine_fracture/growth/front.hpp"

namespace sprekk::fine_fracture {

namespace {

constexpr double equal_advances = 1e-9;  ///< of an increment: differences below this are round-off
constexpr double alike = 0.01;  ///< of ln K over one increment: if growth of another tip unloads a tip as its own does,
                                ///< except for this, both are the same

}  // namespace

/// Tips whose loads and advances are found together. A tip with a new segment is found alone.
std::vector<int> Front::front_tips() const {
  std::vector<int> tips;
  for (int i = 0; i < count(); ++i)
    if (grows_[i] && !is_new(i) && last_[i].is_evaluated) tips.push_back(i);
  return tips;
}

double Front::advance(int tip) const { return (length_[tip] - tips_[tip].covered) / options_.increment; }

Eigen::VectorXd Front::advances(const std::vector<int>& tips) const {
  Eigen::VectorXd values(tips.size());
  for (std::size_t k = 0; k < tips.size(); ++k) values[static_cast<Eigen::Index>(k)] = advance(tips[k]);
  return values;
}

Eigen::VectorXd Front::loads(const std::vector<int>& tips, const Eigen::VectorXd& residual) {
  Eigen::VectorXd values(tips.size());
  for (std::size_t k = 0; k < tips.size(); ++k) values[static_cast<Eigen::Index>(k)] = residual[2 * tips[k]];
  return values;
}

FrontEquations Front::equations(const Eigen::VectorXd& residual) const {
  const std::vector<int> tips = front_tips();
  return most_equal_front(loads(tips, residual), advances(tips), options_.mesh_error);
}

Eigen::VectorXd Front::count_loads(const Eigen::VectorXd& residual, const FrontEquations& front) const {
  Eigen::VectorXd values = residual;
  Eigen::Index k = 0;
  for (const int tip : front_tips()) values[2 * tip] = front.residual[k++];
  return values;
}

bool Front::has_equal_advances(const Eigen::VectorXd& residual) const {
  const std::vector<int> tips = front_tips();
  if (options_.mesh_error == 0 || tips.size() < 2) return true;
  const Eigen::VectorXd advance = advances(tips);
  return !advances_are_equal(loads(tips, residual), options_.mesh_error) ||
         advance.maxCoeff() - advance.minCoeff() <= equal_advances;
}

/// A number that is positive where a tip at rest has to grow.
double Front::load_at_rest(int tip, const Eigen::VectorXd& residual) const {
  const double load = residual[2 * tip];
  if (is_new(tip) || options_.mesh_error == 0) return load;
  const std::vector<int> growing = front_tips();
  if (!growing.empty())
    return load_beside_front(load, loads(growing, residual), advances(growing), options_.mesh_error);
  std::vector<int> resting;
  for (int i = 0; i < count(); ++i)
    if (may_start(i) && !is_new(i)) resting.push_back(i);
  const Eigen::VectorXd all = loads(resting, residual);
  if (load < all.maxCoeff() - 2 * options_.mesh_error) return load;
  return load_of_front_at_rest(all, options_.mesh_error);
}

/// Adds tips at rest that have to grow to those that grow. True if one of them did not grow in the last trial: then
/// another trial, with the new set, is needed.
bool Front::free_tips(const Eigen::VectorXd& residual) {
  std::vector<int> freed;
  for (int i = 0; i < count(); ++i)
    if (may_start(i) && load_at_rest(i, residual) > options_.load_tolerance) freed.push_back(i);
  for (const int i : freed) {
    best_.reset();
    const bool was_laid = is_laid_[i], is_loaded = residual[2 * i] > options_.load_tolerance;
    if (!was_laid) {
      before_place_.resize(0);
      begin(i, last_[i]);
      set_turn_slope(i, last_[i].sifs);
    }
    if (!is_loaded) begin_beside_front(i);
    grows_[i] = 1;
    if (!was_laid && is_loaded) return true;
  }
  return false;
}

/// A tip that is below its toughness, but within the error of the mesh, begins without an advance. If growth of another
/// tip unloads both alike, its own growth does so, too.
void Front::begin_beside_front(int tip) {
  length_[tip] = tips_[tip].covered;
  angle_[tip] = tips_[tip].angle;
  grows_[tip] = 0;
  const std::vector<int> growing = front_tips();
  if (growing.empty()) return;
  const int leader = *std::ranges::max_element(growing, {}, [&](int i) { return advance(i); });
  const double own = slopes_.jacobian(2 * leader, 2 * leader), shared = slopes_.jacobian(2 * tip, 2 * leader);
  if (std::abs(own - shared) < alike) slopes_.jacobian.col(2 * tip) = slopes_.jacobian.col(2 * leader);
}

}  // namespace sprekk::fine_fracture
