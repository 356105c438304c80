#include "framework/schemes/pass_factor.hpp"

#include <algorithm>
#include <cmath>
#include <random>

#include "framework/assembly/assemble_all.hpp"
#include "framework/assembly/block_system.hpp"
#include "framework/assembly/stabilizes.hpp"
#include "framework/linear/direct/sparse_lu.hpp"
#include "framework/schedule/held_amounts.hpp"

namespace sprekk {

namespace {

constexpr int iterations = 150, counted = 100;  // of the power iteration, and those that the factor is the mean of

}  // namespace

/// The block of a group on the diagonal of M, factorized.
class PassFactor::Group {
 public:
  std::vector<int> rows;     ///< of the block
  std::vector<int> changed;  ///< places of rows whose unknowns the group changes
  SparseLu factors;
  bool is_regular = false;
};

PassFactor::~PassFactor() = default;

PassFactor::PassFactor(const Model& model, const StepTime& step)
    : model_(model), step_(step), unknowns_(model.schedule().unknowns()) {
  Assembly assembly(unknowns_, Assembly::Request::residual_and_derivatives);
  assemble_all(assembly, model.parts(), step);
  BlockSystem system(model.mesh(), unknowns_);
  for (std::size_t u = 0; u <= unknowns_.size(); ++u)
    first_.push_back(u < unknowns_.size() ? system.first(static_cast<int>(u)) : system.size());
  matrix_ = system.matrix(assembly).local;
}

std::vector<ResponseTerm> PassFactor::terms_of_held_amounts(const std::vector<std::string>& components,
                                                            const std::string& stabilization) const {
  std::vector<const Field*> solved, held;
  for (const Field* field : unknowns_)
    if (std::ranges::count(components, field->spec().owner) > 0) solved.push_back(field);
  for (const Part* part : model_.parts())
    if (const auto* holds = dynamic_cast<const Stabilizes*>(part); holds && !stabilization.empty())
      for (const Field* field : holds->holds_amounts_of(stabilization))
        if (std::ranges::count(solved, field) == 0) held.push_back(field);
  return HeldAmounts(model_.mesh(), held, solved, model_.parts()).update(step_);
}

const PassFactor::Group* PassFactor::group(const std::vector<std::string>& components,
                                           const std::string& stabilization) {
  std::string key = stabilization + ":";
  for (const std::string& component : components) key += component + " ";
  std::unique_ptr<Group>& group = groups_[key];
  if (group) return group.get();
  group = std::make_unique<Group>();
  Stabilization diagonals;
  for (const auto* part : parts_with<Stabilizes>(model_.parts()))
    if (!stabilization.empty()) part->stabilize(stabilization, diagonals);
  std::vector<int> place(static_cast<std::size_t>(matrix_.cols()), -1);
  Vector more = Vector::Zero(matrix_.cols());
  const bool responds = stabilization == "response";
  const auto is_in_group = [&](const std::string& component) { return std::ranges::count(components, component) > 0; };
  // Whether the unknowns of a component that waits answer: not while what it needs is solved for, and held meanwhile.
  const auto answers = [&](const std::string& component) {
    for (const Part* part : model_.parts())
      for (const Dependence& dependence : part->dependences())
        if (dependence.component == component && is_in_group(dependence.on)) return false;
    return true;
  };
  enum class Kind { none, waiting, bulk, interface };
  std::vector<Kind> kinds(static_cast<std::size_t>(matrix_.cols()), Kind::none);
  for (std::size_t u = 0; u < unknowns_.size(); ++u) {
    const bool is_own = is_in_group(unknowns_[u]->spec().owner);
    if (!is_own && !(responds && answers(unknowns_[u]->spec().owner))) continue;
    const Kind kind = !is_own                                     ? Kind::waiting
                      : is_bulk(unknowns_[u]->spec().role.kind()) ? Kind::bulk
                                                                  : Kind::interface;
    if (const auto found = diagonals.find(unknowns_[u]); found != diagonals.end())
      more.segment(first_[u], first_[u + 1] - first_[u]) = found->second;
    for (int row = first_[u]; row < first_[u + 1]; ++row) {
      place[row] = static_cast<int>(group->rows.size());
      kinds[row] = kind;
      if (is_own) group->changed.push_back(place[row]);
      group->rows.push_back(row);
    }
  }
  // Waiting unknowns answer those on interfaces, and act on them.
  const auto are_apart = [](Kind one, Kind other) {
    return (one == Kind::waiting && other == Kind::bulk) || (one == Kind::bulk && other == Kind::waiting);
  };
  const int size = static_cast<int>(group->rows.size());
  std::vector<Triplet> entries;
  for (int i = 0; i < size; ++i) {
    const int row = group->rows[i];
    for (SparseMatrix::InnerIterator entry(matrix_, row); entry; ++entry)
      if (place[entry.col()] >= 0 && !are_apart(kinds[row], kinds[entry.col()]))
        entries.emplace_back(i, place[entry.col()], entry.value());
    if (more[row] != 0) entries.emplace_back(i, i, more[row]);
  }
  for (const ResponseTerm& term : terms_of_held_amounts(components, stabilization)) {
    const auto first = [&](const Field* field) {
      return first_[std::ranges::find(unknowns_, field) - unknowns_.begin()];
    };
    for (int r = 0; r < term.matrix.outerSize(); ++r)
      for (SparseMatrix::InnerIterator entry(term.matrix, r); entry; ++entry)
        entries.emplace_back(place[first(term.row) + r], place[first(term.column) + entry.col()], entry.value());
  }
  Eigen::SparseMatrix<double> block(size, size);
  block.setFromTriplets(entries.begin(), entries.end());
  group->is_regular = group->factors.factorize(block) && size > 0;
  return group.get();
}

std::optional<double> PassFactor::of(const Scheme& scheme) {
  if (scheme.is_monolithic()) return 0;
  std::vector<const Group*> groups;
  for (std::size_t g = 0; g < scheme.groups.size(); ++g) {
    groups.push_back(group(scheme.groups[g], scheme.stabilization(g)));
    if (!groups.back()->is_regular) return std::nullopt;
  }
  std::mt19937 random(1);
  Vector error(matrix_.cols());
  for (double& entry : error) entry = static_cast<double>(random()) / static_cast<double>(std::mt19937::max()) - 0.5;
  // The random start has arbitrary proportions between fields; after one pass they are those of errors, so the first
  // pass is not counted.
  double logarithm = 0, size = 0;
  for (int k = 0; k < iterations; ++k) {
    // All groups of a Jacobi pass see the residual at its beginning, those of a Gauss-Seidel pass the latest one.
    Vector residual = matrix_ * error;
    for (const Group* group : groups) {
      if (!scheme.is_jacobi && group != groups.front()) residual = matrix_ * error;
      Vector right(static_cast<Eigen::Index>(group->rows.size()));
      for (Eigen::Index i = 0; i < right.size(); ++i) right[i] = residual[group->rows[i]];
      const Vector change = group->factors.solve(right);
      for (const int i : group->changed) error[group->rows[i]] -= change[i];
    }
    // The size is that of the fields that are solved last, since all others follow from them.
    double norm = 0;
    for (const int i : groups.back()->changed) norm = std::max(norm, std::abs(error[groups.back()->rows[i]]));
    if (!std::isfinite(norm)) return std::nullopt;
    if (norm == 0) return 0;
    if (k >= iterations - counted) logarithm += std::log(norm / size);
    error /= norm;
    size = 1;
  }
  return std::exp(logarithm / counted);
}

}  // namespace sprekk
