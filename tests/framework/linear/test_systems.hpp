// Manufactured systems for the tests of linear solvers.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <random>

#include "framework/linear/linear_solver.hpp"

namespace sprekk::test {

inline LinearSystem make_system(int unknowns, const std::vector<Triplet>& entries, std::vector<UnknownBlock> blocks) {
  LinearSystem system;
  system.rows.resize(unknowns);
  for (int i = 0; i < unknowns; ++i) system.rows[i] = i;
  system.local = SparseMatrix(unknowns, unknowns);
  system.local.setFromTriplets(entries.begin(), entries.end());
  system.blocks = std::move(blocks);
  return system;
}

/// Places as a block of unknowns has them: a column each.
inline Eigen::MatrixXd columns_of(const std::vector<Point>& places) {
  Eigen::MatrixXd columns(2, places.size());
  for (std::size_t i = 0; i < places.size(); ++i) columns.col(static_cast<Eigen::Index>(i)) = places[i];
  return columns;
}

inline Vector random_vector(int n, unsigned seed) {
  std::mt19937_64 engine(seed);
  std::uniform_real_distribution<double> uniform(-1, 1);
  return Vector::NullaryExpr(n, [&] { return uniform(engine); });
}

/// -Laplace u, five points, zero outside the n × n interior nodes, scaled by h^2. With `floating`, no boundary value.
inline LinearSystem poisson(int n, bool floating = false) {
  std::vector<Triplet> entries;
  UnknownBlock block{"pore.pressure", 0, n * n, 1, BlockKind::bulk_elliptic, {}, {}};
  const auto id = [n](int i, int j) { return j * n + i; };
  for (int j = 0; j < n; ++j)
    for (int i = 0; i < n; ++i) {
      block.coordinates.conservativeResize(2, id(i, j) + 1);
      block.coordinates.col(id(i, j)) << (i + 1.0) / (n + 1), (j + 1.0) / (n + 1);
      double diagonal = 0;
      for (const auto& [di, dj] : {std::array{1, 0}, {-1, 0}, {0, 1}, {0, -1}}) {
        const bool is_inside = i + di >= 0 && i + di < n && j + dj >= 0 && j + dj < n;
        if (is_inside) entries.emplace_back(id(i, j), id(i + di, j + dj), -1);
        if (is_inside || !floating) diagonal += 1;
      }
      entries.emplace_back(id(i, j), id(i, j), diagonal);
    }
  return make_system(n * n, entries, {block});
}

/// A chain of contents p that exchange fluxes Q: S p_i + t (Q_i - Q_(i-1)) = b_i and Q_i / C = p_i - p_(i+1). The first
/// receives 1, the middle one loses what the total leaves.
struct Exchange {
  int n;
  double storage, conductance;
  double time_step = 3e7, total = 0.25;

  LinearSystem build() const {
    std::vector<Triplet> entries;
    for (int i = 0; i < n; ++i) entries.emplace_back(i, i, storage);
    for (int i = 0; i + 1 < n; ++i) {
      entries.emplace_back(i, n + i, time_step);
      entries.emplace_back(i + 1, n + i, -time_step);
      entries.emplace_back(n + i, n + i, 1 / conductance);
      entries.emplace_back(n + i, i, -1);
      entries.emplace_back(n + i, i + 1, 1);
    }
    return make_system(2 * n - 1, entries,
                       {{"conduit.pressure", 0, n, 1, BlockKind::interface, {}, {}},
                        {"conduit.flux", n, n - 1, 1, BlockKind::interface, {}, {}}});
  }
  Vector right_hand_side() const {
    Vector b = Vector::Zero(2 * n - 1);
    b[0] = 1;
    b[n / 2] = total - 1;
    return b;
  }
  /// To the first order in S / (t C): the constant mode, and differences by what flows from the first to the middle.
  Vector solution() const {
    const Vector b = right_hand_side();
    Vector x(2 * n - 1), drop = Vector::Zero(n);
    double given = 0;
    for (int i = 0; i + 1 < n; ++i) {
      given += b[i] - total / n;
      x[n + i] = given / time_step;
      drop[i + 1] = drop[i] - x[n + i] / conductance;
    }
    // Neglected in the fluxes: S drop of each cell, which vanishes in the sum.
    const double constant = storage > 0 ? total / (n * storage) - drop.mean() : 0;
    x.head(n) = Vector::Constant(n, constant) + drop;
    return x;
  }
};

/// Rows of random sparsity, diagonally dominant, not symmetric.
inline LinearSystem random_dominant(int n, unsigned seed) {
  std::mt19937_64 engine(seed);
  std::uniform_int_distribution<int> column(0, n - 1);
  std::uniform_real_distribution<double> value(-1, 1);
  std::vector<Triplet> entries;
  for (int i = 0; i < n; ++i) {
    double sum = 0;
    for (int k = 0; k < 6; ++k) {
      const double v = value(engine);
      sum += std::abs(v);
      entries.emplace_back(i, column(engine), v);
    }
    entries.emplace_back(i, i, 1.1 * sum);
  }
  return make_system(n, entries, {{"some.field", 0, n, 1, BlockKind::interface, {}, {}}});
}

/// One backward Euler step of Biot's equations in two halves of a unit square, joined by a fracture along the middle,
/// by bilinear elements: displacements u (m), pressures p (Pa), and at every pair of wall nodes the unknowns
///   T  contact traction (2),     T on the + wall, -T on the - wall
///   d  displacement jump (2)     d = u+ - u- - C T, C a wall compliance
///   l  wall fluxes (2)           l = k (p_wall - p_f)
///   p_f fracture pressure        (storage + flow along the fracture) p_f + d_n per time = l+ + l-
/// Half of the fracture sticks (d = 0), half is open (T = 0). Not symmetric; entries from 1e-12 to 1e11.
struct FracturedBiot {
  int n;  ///< elements along a side; even
  double young = 4e10, poisson_ratio = 0.2, biot = 0.8, storage = 1e-11, mobility = 1e-13, time_step = 1e4;
  double fracture_mobility = 1e-9;

  int columns() const { return n + 1; }
  int half_nodes() const { return columns() * (n / 2 + 1); }
  int nodes() const { return 2 * half_nodes(); }
  int node(int half, int i, int j) const { return half * half_nodes() + j * columns() + i; }
  int displacement(int node, int c) const { return 2 * node + c; }
  int pressure(int node) const { return 2 * nodes() + node; }
  int first_local() const { return 3 * nodes(); }
  int traction(int i, int c) const { return first_local() + 2 * i + c; }
  int jump(int i, int c) const { return first_local() + 2 * columns() + 2 * i + c; }
  int wall_flux(int i, int side) const { return first_local() + 4 * columns() + 2 * i + side; }
  int fracture_pressure(int i) const { return first_local() + 6 * columns() + i; }
  int unknowns() const { return first_local() + 7 * columns(); }

  /// Unknowns chosen at random, each block in its own unit.
  Vector random_state(unsigned seed) const {
    Vector x = random_vector(unknowns(), seed);
    x.head(2 * nodes()) *= 1e-4;                        // m
    x.segment(2 * nodes(), nodes()) *= 1e6;             // Pa
    x.segment(traction(0, 0), 2 * columns()) *= 1e6;    // Pa
    x.segment(jump(0, 0), 2 * columns()) *= 1e-4;       // m
    x.segment(wall_flux(0, 0), 2 * columns()) *= 1e-6;  // m/s
    x.segment(fracture_pressure(0), columns()) *= 1e6;  // Pa
    return x;
  }

  LinearSystem build() const {
    std::vector<Triplet> entries;
    for (int half = 0; half < 2; ++half)
      for (int j = 0; j < n / 2; ++j)
        for (int i = 0; i < n; ++i) add_element(entries, half, i, j);
    add_fracture(entries);
    return make_system(unknowns(), with_boundary_values(entries), blocks());
  }

 private:
  // Clamped at the outer bottom and top; pressure given at the top.
  bool is_fixed(int unknown) const {
    const int bottom = columns(), top = node(1, 0, n / 2);
    if (unknown < 2 * nodes()) return unknown / 2 < bottom || unknown / 2 >= top;
    return unknown < first_local() && unknown - 2 * nodes() >= top;
  }

  std::vector<Triplet> with_boundary_values(const std::vector<Triplet>& entries) const {
    std::vector<Triplet> kept;
    for (const Triplet& t : entries)
      if (!is_fixed(t.row())) kept.push_back(t);
    for (int unknown = 0; unknown < first_local(); ++unknown)
      if (is_fixed(unknown)) kept.emplace_back(unknown, unknown, unknown < 2 * nodes() ? young : storage / (n * n));
    return kept;
  }

  void add_element(std::vector<Triplet>& entries, int half, int i, int j) const {
    const double h = 1.0 / n, point = 0.5 / std::sqrt(3.0);
    const double lambda = young * poisson_ratio / ((1 + poisson_ratio) * (1 - 2 * poisson_ratio));
    const double shear = young / (2 * (1 + poisson_ratio));
    const double k = mobility * ((i + j) % 7 == 0 ? 100 : 1);
    const int ids[4] = {node(half, i, j), node(half, i + 1, j), node(half, i + 1, j + 1), node(half, i, j + 1)};
    for (const double x : {0.5 - point, 0.5 + point})
      for (const double y : {0.5 - point, 0.5 + point}) {
        const double value[4] = {(1 - x) * (1 - y), x * (1 - y), x * y, (1 - x) * y};
        const double slope[4][2] = {
            {-(1 - y) / h, -(1 - x) / h}, {(1 - y) / h, -x / h}, {y / h, x / h}, {-y / h, (1 - x) / h}};
        const double w = h * h / 4;
        for (int a = 0; a < 4; ++a)
          for (int b = 0; b < 4; ++b) {
            const double dot = slope[a][0] * slope[b][0] + slope[a][1] * slope[b][1];
            for (int c = 0; c < 2; ++c) {
              for (int d = 0; d < 2; ++d)
                entries.emplace_back(displacement(ids[a], c), displacement(ids[b], d),
                                     w * (lambda * slope[a][c] * slope[b][d] + shear * slope[a][d] * slope[b][c] +
                                          (c == d ? shear * dot : 0.0)));
              entries.emplace_back(displacement(ids[a], c), pressure(ids[b]), -w * biot * slope[a][c] * value[b]);
              entries.emplace_back(pressure(ids[b]), displacement(ids[a], c), w * biot * slope[a][c] * value[b]);
            }
            // The last term keeps equal-order elements stable (Brezzi and Pitkaranta 1984).
            const double pressure_stabilization = h * h * biot * biot / (4 * (lambda + 2 * shear)) * dot;
            entries.emplace_back(pressure(ids[a]), pressure(ids[b]),
                                 w * (storage * value[a] * value[b] + time_step * k * dot + pressure_stabilization));
          }
      }
  }

  void add_fracture(std::vector<Triplet>& entries) const {
    const double h = 1.0 / n, compliance = 0.5 * h / young, exchange = mobility / h;
    for (int i = 0; i < columns(); ++i) {
      const int walls[2] = {node(1, i, 0), node(0, i, n / 2)};  // +, -
      for (int c = 0; c < 2; ++c) {
        for (int side = 0; side < 2; ++side) {
          const double sign = side == 0 ? 1 : -1;
          entries.emplace_back(displacement(walls[side], c), traction(i, c), sign * h);
          entries.emplace_back(traction(i, c), displacement(walls[side], c), -sign);
          if (c == 1) entries.emplace_back(displacement(walls[side], c), fracture_pressure(i), -sign * h);
        }
        entries.emplace_back(traction(i, c), jump(i, c), 1);
        entries.emplace_back(traction(i, c), traction(i, c), compliance);
        if (i < columns() / 2)
          entries.emplace_back(jump(i, c), jump(i, c), 1);
        else
          entries.emplace_back(jump(i, c), traction(i, c), 1);
      }
      for (int side = 0; side < 2; ++side) {
        entries.emplace_back(pressure(walls[side]), wall_flux(i, side), time_step * h);
        entries.emplace_back(wall_flux(i, side), wall_flux(i, side), 1 / exchange);
        entries.emplace_back(wall_flux(i, side), pressure(walls[side]), -1);
        entries.emplace_back(wall_flux(i, side), fracture_pressure(i), 1);
        entries.emplace_back(fracture_pressure(i), wall_flux(i, side), -time_step * h);
      }
      entries.emplace_back(fracture_pressure(i), jump(i, 1), h);
      entries.emplace_back(fracture_pressure(i), fracture_pressure(i), 1e-13 * h);
      for (const int neighbour : {i - 1, i + 1}) {
        if (neighbour < 0 || neighbour >= columns()) continue;
        entries.emplace_back(fracture_pressure(i), fracture_pressure(i), time_step * fracture_mobility / h);
        entries.emplace_back(fracture_pressure(i), fracture_pressure(neighbour), -time_step * fracture_mobility / h);
      }
    }
  }

  std::vector<UnknownBlock> blocks() const {
    std::vector<Point> in_rock, on_fracture;
    for (int half = 0; half < 2; ++half)
      for (int j = 0; j <= n / 2; ++j)
        for (int i = 0; i < columns(); ++i) in_rock.emplace_back(double(i) / n, 0.5 * half + double(j) / n);
    for (int i = 0; i < columns(); ++i) on_fracture.emplace_back(double(i) / n, 0.5);
    const Eigen::MatrixXd rock = columns_of(in_rock), fracture = columns_of(on_fracture);
    const double lambda = young * poisson_ratio / ((1 + poisson_ratio) * (1 - 2 * poisson_ratio));
    const double shear = young / (2 * (1 + poisson_ratio));
    const Vector fixed_stress = Vector::Constant(nodes(), biot * biot / (lambda + shear) / (n * n));
    return {{"rock.displacement", 0, nodes(), 2, BlockKind::bulk_elastic, rock, {}},
            {"pore.pressure", 2 * nodes(), nodes(), 1, BlockKind::bulk_elliptic, rock, fixed_stress},
            {"contact.traction", traction(0, 0), columns(), 2, BlockKind::interface, fracture, {}},
            {"contact.jump", jump(0, 0), columns(), 2, BlockKind::interface, fracture, {}},
            {"exchange.flux", wall_flux(0, 0), columns(), 2, BlockKind::interface, fracture, {}},
            {"conduit.pressure", fracture_pressure(0), columns(), 1, BlockKind::interface, fracture, {}}};
  }
};

/// Only the rows whose entities lie in strip `rank` of `size` vertical strips.
inline LinearSystem strip(const LinearSystem& whole, int rank, int size) {
  LinearSystem part;
  part.blocks = whole.blocks;
  std::vector<Triplet> entries;
  for (const UnknownBlock& block : whole.blocks)
    for (int entity = 0; entity < block.entities; ++entity) {
      const int owner = block.coordinates.size() == 0
                            ? entity % size
                            : std::min(size - 1, static_cast<int>(block.coordinates(0, entity) * size));
      if (owner != rank) continue;
      for (int c = 0; c < block.components; ++c) {
        const int row = block.first + entity * block.components + c;
        for (SparseMatrix::InnerIterator entry(whole.local, row); entry; ++entry)
          entries.emplace_back(static_cast<int>(part.rows.size()), static_cast<int>(entry.col()), entry.value());
        part.rows.push_back(row);
      }
    }
  part.local = SparseMatrix(static_cast<int>(part.rows.size()), whole.local.cols());
  part.local.setFromTriplets(entries.begin(), entries.end());
  return part;
}

inline Vector rows_of(const LinearSystem& system, const Vector& whole) {
  Vector mine(system.rows.size());
  for (std::size_t k = 0; k < system.rows.size(); ++k) mine[k] = whole[system.rows[k]];
  return mine;
}

/// The largest difference of a block, over the block's largest value.
inline double block_difference(const LinearSystem& system, const Vector& a, const Vector& b) {
  double largest = 0;
  for (const UnknownBlock& block : system.blocks) {
    const int length = block.entities * block.components;
    const Vector difference = a.segment(block.first, length) - b.segment(block.first, length);
    largest = std::max(largest,
                       difference.lpNorm<Eigen::Infinity>() / b.segment(block.first, length).lpNorm<Eigen::Infinity>());
  }
  return largest;
}

}  // namespace sprekk::test
