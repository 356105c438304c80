#include "framework/schedule/residual_check.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <set>

#include "framework/invariants.hpp"
#include "framework/parallel/parallel.hpp"
#include "framework/round_off.hpp"

namespace sprekk {

namespace {

/// Squares of smaller numbers are zero, so no norm shows them. Values that are to be zero, but are solved for among
/// large ones, shrink by 1e-16 in each iteration until they get there.
constexpr double no_digits = 1e-154;

/// Sizes of the rows of each unknown: of this process, and after add_up() of all processes.
struct OfUnknowns {
  explicit OfUnknowns(std::size_t count)
      : largest(Vector::Zero(static_cast<Eigen::Index>(count))),
        magnitude(largest),
        round_off_base(largest),
        squares(largest),
        rows(largest) {}
  Vector largest, magnitude, round_off_base;  ///< largest residual, and of the terms
  Vector squares, rows;  ///< sum of the squares of residuals, and number, of rows that are not fixed

  /// Takes maxima and sums over all processes: one message for all maxima, and one for all sums. Collective.
  void add_up() {
    const Eigen::Index n = largest.size();
    Vector maxima(3 * n), sums(2 * n);
    maxima << largest, magnitude, round_off_base;
    sums << squares, rows;
    parallel::max(maxima);
    parallel::sum(sums);
    largest = maxima.head(n);
    magnitude = maxima.segment(n, n);
    round_off_base = maxima.tail(n);
    squares = sums.head(n);
    rows = sums.tail(n);
  }
};

/// What the rounded exchanges of the rows of an unknown may add up to.
double noise_of_rows(const Assembly& assembly, const BlockSystem& system, int unknown) {
  const std::vector<char>& owned = system.owned(unknown);
  const double rows = parallel::sum(static_cast<double>(std::ranges::count(owned, 1)));
  return rows * rounding::of_sum * parallel::max(assembly.round_off_base(unknown));
}

/// For each unknown of a sum: the uncertainty of the sum of its own rows, beside that of the sum of all rows. In the
/// system the sum replaces one row. The others hold with the round-off of what rows exchange, which enters, by the
/// exchange between fields (such as the flux through walls), the sum of the field whose row was replaced.
std::vector<double> noise_of_parts(const Assembly& assembly, const BlockSystem& system,
                                   const std::vector<Balances::Quantity>& sums, const Balances::Quantity& quantity) {
  std::vector<double> noise(quantity.unknowns.size(), 0);
  if (noise.size() == 1) return noise;
  const int holder = system.unknown_with_sum(assembly, quantity);
  double passed_on = 0;
  for (std::size_t k = 0; k < noise.size(); ++k) {
    const int u = quantity.unknowns[k];
    const bool has_own = std::ranges::any_of(
        sums, [&](const Balances::Quantity& sum) { return sum.unknowns.size() == 1 && sum.has(u); });
    if (u != holder && !has_own) passed_on += noise[k] = noise_of_rows(assembly, system, u);
  }
  for (std::size_t k = 0; k < noise.size(); ++k)
    if (quantity.unknowns[k] == holder) noise[k] = passed_on;
  return noise;
}

/// Checks the sums of balances, which have to be zero as well: the sum of the balances of a field has more correct
/// digits than any one of them.
void check_sums(const Assembly& assembly, const BlockSystem& system, double tolerance, ResidualCheck& check) {
  const std::size_t unknowns = assembly.unknowns().size();
  check.is_round_off_in_sum.assign(unknowns, 1);
  check.mean_squares.resize(2 * unknowns, 0);
  check.magnitudes.resize(2 * unknowns, 0);
  check.fixed_errors.resize(2 * unknowns, 0);
  const Balances& balances = assembly.balances();
  const std::vector<Balances::Quantity> sums = system.sums_of(assembly);
  for (const Balances::Quantity& quantity : sums) {
    const std::vector<double> of_parts = noise_of_parts(assembly, system, sums, quantity);
    double total = 0, noise_of_total = 0, magnitude_of_total = 0;
    bool are_round_off = true;
    const auto note = [&](int u, double value, double relative, const std::string& equation) {
      check.mean_squares[unknowns + u] = value * value;
      if (relative <= check.largest) return;
      check.largest = relative;
      check.equation = "the sum of " + equation;
    };
    for (std::size_t k = 0; k < quantity.unknowns.size(); ++k) {
      const int u = quantity.unknowns[k];
      const double sum = system.residual_of_sum(assembly, u), value = std::abs(sum);
      const double magnitude = parallel::max(balances.magnitude(u));
      const double own_noise = rounding::of_sum * parallel::max(balances.round_off_base(u)),
                   noise = own_noise + of_parts[k];
      total += sum;
      noise_of_total += own_noise;
      magnitude_of_total += magnitude;
      if (value > tolerance * magnitude + noise) check.rows_hold = false;
      check.magnitudes[unknowns + u] = magnitude;
      if (value <= noise) continue;
      are_round_off = false;
      check.is_round_off_in_sum[u] = 0;
      note(u, value, value / magnitude, assembly.unknowns()[u]->name());
    }
    // Where the parts are unknown, their sum is not.
    if (!are_round_off || std::abs(total) <= noise_of_total) continue;
    if (std::abs(total) > tolerance * magnitude_of_total + noise_of_total) check.rows_hold = false;
    for (const int u : quantity.unknowns) check.is_round_off_in_sum[u] = 0;
    note(quantity.unknowns.front(), std::abs(total), std::abs(total) / magnitude_of_total, quantity.name);
  }
}

/// The sizes of the terms of each row of an unknown: (|A| |x|)_i, with the throughput of a balance. The storage of a
/// cell follows from changes in the step, so the values themselves are not among the terms; `digits` includes them,
/// since their last digits are lost.
struct SizesOfRows {
  Vector terms, digits;
};
SizesOfRows sizes_of_rows(const Assembly& assembly, int unknown) {
  SizesOfRows sizes{assembly.balances().throughput(unknown), assembly.balances().throughput(unknown)};
  for (const Assembly::Block& block : assembly.blocks()) {
    if (block.row != unknown) continue;
    const Field& column = *assembly.unknowns()[block.column];
    const bool is_here = column.spec().location == assembly.unknowns()[unknown]->spec().location;
    for (int row = 0; row < block.matrix->outerSize(); ++row) {
      const double scale = std::abs(block.weights ? block.factor * (*block.weights)[row] : block.factor);
      for (SparseMatrix::InnerIterator entry(*block.matrix, row); entry; ++entry) {
        const double x = column.now()[entry.col()], size = scale * std::abs(entry.value());
        sizes.terms[row] += size * std::abs(is_here && entry.col() == row ? x - column.accepted()[row] : x);
        sizes.digits[row] += size * std::abs(x);
      }
    }
  }
  return sizes;
}

/// Whether each balance of an interface holds against the terms of its own row.
void check_each_row(const Assembly& assembly, const BlockSystem& system, double tolerance, ResidualCheck& check) {
  if (!assembly.wants_derivatives()) return;
  Vector worst_rows = Vector::Zero(static_cast<Eigen::Index>(assembly.unknowns().size()));
  for (std::size_t u = 0; u < assembly.unknowns().size(); ++u) {
    const int unknown = static_cast<int>(u);
    const Field& field = *assembly.unknowns()[u];
    if (!assembly.balances().are_rows_of(unknown) || is_bulk(field.spec().role.kind())) continue;
    std::vector<char> counts = system.owned(unknown);
    for (const Assembly::Fixed& fixed : assembly.fixed())
      if (fixed.unknown == unknown) counts[fixed.row] = 0;
    const auto [terms, digits] = sizes_of_rows(assembly, unknown);
    const Vector& residual = assembly.residual(unknown);
    double& worst = worst_rows[u];
    for (int row = 0; row < residual.size(); ++row) {
      const double allowed = looser_for_balances * tolerance * terms[row] + rounding::of_sum * digits[row];
      if (counts[row] && terms[row] > 0 && std::abs(residual[row]) > allowed)
        worst = std::max(worst, std::abs(residual[row]) / terms[row]);
    }
  }
  parallel::max(worst_rows);
  for (std::size_t u = 0; u < assembly.unknowns().size(); ++u) {
    if (worst_rows[u] == 0) continue;
    check.each_row_holds = false;
    check.row_error = std::max(check.row_error, worst_rows[u]);
    check.is_round_off[u] = 0;
  }
}

/// Whether the balances of conserved quantities hold against their throughput.
void check_balances(const Assembly& assembly, const BlockSystem& system, const OfUnknowns& all, double tolerance,
                    ResidualCheck& check) {
  check.is_unbalanced.assign(assembly.unknowns().size(), 0);
  const Balances& balances = assembly.balances();
  for (const Balances::Quantity& quantity : balances.quantities()) {
    if (std::ranges::any_of(assembly.fixed(),
                            [&](const Assembly::Fixed& fixed) { return quantity.has(fixed.unknown); }))
      continue;
    enum { rows, total, throughput, noise_of_total, count };
    Vector sums = Vector::Zero(count);
    for (const int u : quantity.unknowns) {
      const std::vector<char>& owned = system.owned(u);
      const double noise = rounding::of_sum * all.round_off_base[u];
      const Vector &residual = assembly.residual(u), &in_sum = balances.residual(u), &amounts = balances.throughput(u);
      for (int row = 0; row < residual.size(); ++row) {
        if (!owned[row]) continue;
        sums[rows] += std::max(0.0, std::abs(residual[row]) - noise);
        sums[total] += in_sum[row];
        sums[throughput] += amounts[row];
      }
      sums[noise_of_total] += rounding::of_sum * balances.round_off_base(u);
    }
    parallel::sum(sums);
    if (sums[throughput] == 0) continue;
    const double error = std::max(sums[rows], std::abs(sums[total]) - sums[noise_of_total]);
    if (error <= looser_for_balances * tolerance * sums[throughput]) continue;
    check.balances_hold = false;
    for (const int u : quantity.unknowns) check.is_unbalanced[u] = 1;
    const double relative = error / sums[throughput];
    if (relative <= check.imbalance) continue;
    check.imbalance = relative;
    if (!check.rows_hold) continue;  // otherwise the message names the worst row
    check.largest = relative;
    check.equation = "the balance of " + quantity.name;
  }
}

}  // namespace

ResidualCheck check_residual(const Assembly& assembly, const BlockSystem& system, double tolerance) {
  SPREKK_EXPECT(tolerance > 0, tolerance);
  SPREKK_EXPECT(assembly.unknowns().empty() || system.size() > 0 || assembly.unknowns().front()->size() == 0);
  ResidualCheck check;
  check.rows_hold = true;
  const Vector owned = system.residual(assembly);
  SPREKK_ASSERT(owned.size() == static_cast<Eigen::Index>(system.rows().size()), owned.size());
  const std::vector<int>& rows = system.rows();
  OfUnknowns all(assembly.unknowns().size());
  Vector fixed_errors = all.largest;  // the same on every process
  std::size_t next = 0;
  for (std::size_t u = 0; u < assembly.unknowns().size(); ++u) {
    const int end = system.first(static_cast<int>(u)) + assembly.unknowns()[u]->size();
    double largest = 0;
    double &squares = all.squares[u], &count = all.rows[u];
    bool finite = true;
    std::set<int> fixed;
    double& fixed_error = fixed_errors[u];
    for (const Assembly::Fixed& row : assembly.fixed()) {
      if (row.unknown != static_cast<int>(u)) continue;
      fixed.insert(system.first(row.unknown) + row.row);
      fixed_error = std::max(fixed_error, row.error);
    }
    const std::size_t first = next;
    next = std::lower_bound(rows.begin() + first, rows.end(), end) - rows.begin();
    if (fixed.empty()) {
      const auto part = owned.segment(first, next - first);
      squares = part.squaredNorm();
      count = static_cast<double>(part.size());
      if (part.size() > 0) largest = part.lpNorm<Eigen::Infinity>();
      finite = std::isfinite(squares) || part.allFinite();
    } else {
      for (std::size_t row = first; row < next; ++row) {
        if (fixed.count(rows[row]) > 0) continue;
        const double value = std::abs(owned[row]);
        finite = finite && std::isfinite(value);
        largest = std::max(largest, value);
        squares += value * value;
        count += 1;
      }
    }
    all.largest[u] = finite ? largest : std::numeric_limits<double>::infinity();
    all.magnitude[u] = assembly.magnitude(static_cast<int>(u));
    all.round_off_base[u] = assembly.round_off_base(static_cast<int>(u));
  }
  all.add_up();
  for (std::size_t u = 0; u < assembly.unknowns().size(); ++u) {
    const double largest = all.largest[u], magnitude = all.magnitude[u], fixed_error = fixed_errors[u];
    const double noise = rounding::of_sum * all.round_off_base[u] + no_digits;
    if (!std::isfinite(largest) || !std::isfinite(magnitude)) {
      check.finite = check.rows_hold = false;
      check.equation = assembly.unknowns()[u]->name();
      check.largest = std::numeric_limits<double>::infinity();
      return check;
    }
    if (largest > tolerance * magnitude + noise || fixed_error > tolerance) check.rows_hold = false;
    const bool is_round_off = largest <= noise || magnitude == 0;
    check.is_round_off.push_back(is_round_off && fixed_error <= tolerance);
    double relative = fixed_error;
    check.fixed_errors.push_back(fixed_error);
    check.magnitudes.push_back(magnitude);
    check.mean_squares.push_back(is_round_off ? 0 : all.squares[u] / std::max(1.0, all.rows[u]));
    if (!is_round_off) relative = std::max(relative, largest / magnitude);
    check.of_equations.emplace_back(assembly.unknowns()[u]->name(), relative);
    if (relative > check.largest) {
      check.largest = relative;
      check.equation = assembly.unknowns()[u]->name();
    }
  }
  check_sums(assembly, system, tolerance, check);
  check_balances(assembly, system, all, tolerance, check);
  check_each_row(assembly, system, tolerance, check);
  SPREKK_ASSERT(check.is_round_off.size() == assembly.unknowns().size(), check.is_round_off.size());
  SPREKK_ASSERT(check.magnitudes.size() == check.mean_squares.size(), check.magnitudes.size());
  check.converged = check.rows_hold && check.balances_hold && check.each_row_holds;
  return check;
}

double ResidualCheck::merit(const ResidualCheck& scales) const {
  SPREKK_EXPECT(!finite || scales.magnitudes.size() >= mean_squares.size(), scales.magnitudes.size(),
                mean_squares.size());
  if (!finite) return std::numeric_limits<double>::infinity();
  double sum = 0;
  for (std::size_t u = 0; u < mean_squares.size(); ++u) {
    sum += fixed_errors[u] * fixed_errors[u];
    if (mean_squares[u] == 0) continue;
    const double scale = scales.magnitudes[u] > 0 ? scales.magnitudes[u] : magnitudes[u];
    sum += mean_squares[u] / (scale * scale);
  }
  return sum;
}

}  // namespace sprekk
