#include "couplers/two_level/plane/pressure_near_tips.hpp"

#include <Eigen/SparseLU>
#include <algorithm>
#include <limits>
#include <map>
#include <set>
#include <stdexcept>

#include "framework/invariants.hpp"

namespace sprekk::couplers {
namespace {

constexpr int rings = 3;      ///< of cells around a tip
constexpr int divisions = 4;  ///< of each edge of a cell
/// How far a pressure may be outside of the range of the given ones, as a part of this range: up to the first it has
/// its full weight, from the second on none.
constexpr double least_overshoot = 0.02, most_overshoot = 0.15;

/// The nodes at tips.
std::set<int> tip_nodes(const Mesh& mesh) {
  std::set<int> nodes;
  for (const Ridge& point : mesh.ridges) {
    if (point.kind != Ridge::Kind::tip) continue;
    for (const int node : mesh.face_nodes[mesh.fracture_cells[point.cells[0]].faces[0]])
      if (mesh.nodes[node] == point.center) nodes.insert(node);
  }
  return nodes;
}

}  // namespace

/// Cells that are joined, and their triangulation.
struct PressureNearTips::Region {
  using Matrix = Eigen::SparseMatrix<double>;
  const Mesh& mesh;
  std::vector<int> cells;
  std::vector<std::vector<std::array<int, 3>>> triangles;  ///< of each of the cells
  std::vector<Point> nodes;

  /// Where a node gets its value from, if it is not free: two nodes of the mesh, or a wall and one of its ends.
  struct Source {
    std::array<int, 2> ends{none, none};
    double share = 0;        ///< of the second end
    std::vector<int> faces;  ///< the walls (as faces) on which it lies
    bool on_rim = false;
  };
  std::vector<Source> sources;

  // For one set of walls that let fluid through.
  std::vector<bool> conducting;
  std::vector<int> unknown;  ///< of each node, or none
  Matrix by_given;  ///< what nodes with values contribute to the equations of the others, and to the means of the cells
  Eigen::SparseLU<Matrix> factors;

  std::optional<Vector> solution;
  double weight = 1;

  explicit Region(const Mesh& mesh) : mesh(mesh) {}
  class EdgeNodes;
  class EdgeNodes;
  void triangulate(const std::vector<int>& region_of_cell, int self, const std::set<int>& tips);
  void set_sources(const std::vector<int>& region_of_cell, int self, EdgeNodes& edges);
  void factorize(const std::vector<std::optional<double>>& walls);
  void solve(const Given& given);
};

PressureNearTips::~PressureNearTips() = default;

PressureNearTips::PressureNearTips(const Mesh& mesh) : mesh_(mesh), region_of_cell_(mesh.cell_count(), none) {
  const std::set<int> tips = tip_nodes(mesh);
  std::vector<char> near(mesh.cell_count(), 0);
  for (const int tip : tips) {
    std::set<int> nodes{tip};
    for (int ring = 0; ring < rings; ++ring) {
      std::set<int> next;
      for (const int node : nodes)
        for (const int cell : mesh.node_cells[node]) {
          near[cell] = 1;
          next.insert(mesh.cell_nodes[cell].begin(), mesh.cell_nodes[cell].end());
        }
      nodes = std::move(next);
    }
  }
  for (int cell = 0; cell < mesh.cell_count(); ++cell) {
    if (!near[cell] || region_of_cell_[cell] != none) continue;
    const int number = static_cast<int>(regions_.size());
    auto region = std::make_unique<Region>(mesh);
    std::vector<int> open{cell};
    region_of_cell_[cell] = number;
    while (!open.empty()) {
      const int next = open.back();
      open.pop_back();
      region->cells.push_back(next);
      for (const int node : mesh.cell_nodes[next])
        for (const int other : mesh.node_cells[node])
          if (near[other] && region_of_cell_[other] == none) {
            region_of_cell_[other] = number;
            open.push_back(other);
          }
    }
    std::ranges::sort(region->cells);
    region->triangulate(region_of_cell_, number, tips);
    regions_.push_back(std::move(region));
  }
}

/// The nodes that divide the edges of a region's cells.
class PressureNearTips::Region::EdgeNodes {
 public:
  /// An edge becomes finer towards a tip at one of its ends. A triangle can become finer towards one corner only: tips
  /// in a triangle with two of them do not count.
  EdgeNodes(Region& region, const std::set<int>& tips) : region_(region), fine_(tips) {
    const auto tip_count = [&](int cell) {
      return std::ranges::count_if(corners(cell), [&](int node) { return is_fine(node); });
    };
    for (const int cell : region.cells)
      if (tip_count(cell) > 1)
        for (const int node : corners(cell)) fine_.erase(node);
  }

  bool is_fine(int node) const { return fine_.contains(node); }

  int add(const Point& x) {
    region_.nodes.push_back(x);
    region_.sources.emplace_back();
    return static_cast<int>(region_.nodes.size()) - 1;
  }

  int corner(int node) {
    const auto [at, is_new] = of_corner_.try_emplace(node, 0);
    if (is_new) {
      at->second = add(region_.mesh.nodes[node]);
      region_.sources[at->second].ends = {node, node};
    }
    return at->second;
  }

  /// The k-th of divisions + 1 nodes on the way from a to b.
  int on_edge(int a, int b, int k) {
    if (k == 0) return corner(a);
    if (k == divisions) return corner(b);
    if (a > b) std::swap(a, b), k = divisions - k;
    const auto [at, is_new] = along_.try_emplace({a, b});
    if (is_new)
      for (int i = 1; i < divisions; ++i) {
        double share = double(i) / divisions;
        if (is_fine(a)) share = share * share;
        if (is_fine(b)) share = 1 - (1 - share) * (1 - share);
        const std::vector<Point>& nodes = region_.mesh.nodes;
        at->second.push_back(add(nodes[a] + share * (nodes[b] - nodes[a])));
        region_.sources.back().ends = {a, b};
        region_.sources.back().share = share;
      }
    return at->second[k - 1];
  }

 private:
  const Ring& corners(int cell) const { return region_.mesh.cell_nodes[cell]; }

  Region& region_;
  std::set<int> fine_;
  std::map<std::array<int, 2>, std::vector<int>> along_;  // of an edge from the lower node on
  std::map<int, int> of_corner_;
};

void PressureNearTips::Region::triangulate(const std::vector<int>& region_of_cell, int self,
                                           const std::set<int>& tips) {
  constexpr int n = divisions;
  EdgeNodes edges(*this, tips);
  for (const int cell : cells) {
    const Ring& ring = mesh.cell_nodes[cell];
    std::vector<std::array<int, 3>> pieces;
    const int count = static_cast<int>(ring.size());
    int first = 0;
    for (int k = 0; k < count; ++k)
      if (edges.is_fine(ring[k])) first = k;
    const auto node = [&](int k) { return ring[(first + k) % count]; };
    pieces.push_back({node(0), node(1), node(2)});
    if (count == 4) pieces.push_back({node(0), node(2), node(3)});
    std::vector<std::array<int, 3>>& made = triangles.emplace_back();
    for (const auto& [a, b, c] : pieces) {
      // Rows parallel to the edge b-c; row i has i+1 nodes.
      std::vector<std::vector<int>> rows(n + 1);
      rows[0] = {edges.corner(a)};
      for (int i = 1; i <= n; ++i) {
        const int left = edges.on_edge(a, b, i), right = edges.on_edge(a, c, i);
        rows[i].push_back(left);
        for (int k = 1; k < i; ++k)
          rows[i].push_back(i == n ? edges.on_edge(b, c, k)
                                   : edges.add(nodes[left] + double(k) / i * (nodes[right] - nodes[left])));
        rows[i].push_back(right);
      }
      for (int i = 0; i < n; ++i)
        for (int k = 0; k <= i; ++k) {
          made.push_back({rows[i][k], rows[i + 1][k], rows[i + 1][k + 1]});
          if (k < i) made.push_back({rows[i][k], rows[i + 1][k + 1], rows[i][k + 1]});
        }
    }
  }
  set_sources(region_of_cell, self, edges);
}

void PressureNearTips::Region::set_sources(const std::vector<int>& region_of_cell, int self, EdgeNodes& edges) {
  for (const int cell : cells)
    for (const int face : mesh.cell_faces[cell]) {
      const int wall = mesh.face_fracture_cell[face];
      const auto& [a, b] = mesh.face_nodes[face];
      const auto& [one, other] = mesh.face_cells[face];
      const bool is_rim =
          wall == none && (other == none || region_of_cell[one] != self || region_of_cell[other] != self);
      if (wall == none && !is_rim) continue;
      for (int k = 0; k <= divisions; ++k) {
        Source& source = sources[edges.on_edge(a, b, k)];
        if (is_rim) {
          source.on_rim = true;
        } else if (std::ranges::find(source.faces, face) == source.faces.end()) {
          source.faces.push_back(face);
        }
      }
    }
}

namespace {

/// The number of the wall of a face.
int wall_of(const Mesh& mesh, int face) {
  const int cell = mesh.face_fracture_cell[face];
  return 2 * cell + (mesh.fracture_cells[cell].faces[1] == face ? 1 : 0);
}

}  // namespace

void PressureNearTips::Region::factorize(const std::vector<std::optional<double>>& walls) {
  std::vector<bool> now;
  for (const Source& source : sources)
    now.push_back(source.on_rim ||
                  std::ranges::any_of(source.faces, [&](int face) { return walls[wall_of(mesh, face)].has_value(); }));
  if (now == conducting) return;
  conducting = now;
  unknown.assign(nodes.size(), none);
  int count = 0;
  for (std::size_t i = 0; i < nodes.size(); ++i)
    if (!conducting[i]) unknown[i] = count++;
  // The least integral of the squared gradient under the condition that each cell has its mean: after the unknown nodes
  // come the multipliers of these conditions.
  std::vector<Triplet> entries, given;
  for (std::size_t c = 0; c < cells.size(); ++c)
    for (const std::array<int, 3>& t : triangles[c]) {
      const Point ab = nodes[t[1]] - nodes[t[0]], ac = nodes[t[2]] - nodes[t[0]];
      const double area = 0.5 * (ab[0] * ac[1] - ab[1] * ac[0]);
      SPREKK_ASSERT(area > 0, area);
      const std::array<Point, 3> opposite{nodes[t[2]] - nodes[t[1]], nodes[t[0]] - nodes[t[2]],
                                          nodes[t[1]] - nodes[t[0]]};
      const int mean = count + static_cast<int>(c);
      for (int i = 0; i < 3; ++i) {
        const int row = unknown[t[i]];
        const double part = area / 3 / mesh.cell_measure[cells[c]];
        if (row == none) {
          given.emplace_back(mean, t[i], part);
          continue;
        }
        entries.emplace_back(mean, row, part);
        entries.emplace_back(row, mean, part);
        for (int k = 0; k < 3; ++k) {
          const double value = opposite[i].dot(opposite[k]) / (4 * area);
          if (unknown[t[k]] == none)
            given.emplace_back(row, t[k], value);
          else
            entries.emplace_back(row, unknown[t[k]], value);
        }
      }
    }
  const int size = count + static_cast<int>(cells.size());
  Matrix equations(size, size);
  equations.setFromTriplets(entries.begin(), entries.end());
  by_given.resize(size, static_cast<Eigen::Index>(nodes.size()));
  by_given.setFromTriplets(given.begin(), given.end());
  factors.compute(equations);
  if (factors.info() != Eigen::Success) throw std::runtime_error("the pressure around a tip is not determined");
}

void PressureNearTips::Region::solve(const Given& given) {
  factorize(given.walls);
  const auto wall_value = [&](const Source& source) {
    // At a node of the mesh the mean of the walls there, which is linear between centres; between, linear from the
    // ends of a wall to its middle.
    const auto at_corner = [&](int node) {
      double sum = 0, weights = 0;
      for (const int face : mesh.node_faces[node]) {
        if (mesh.face_fracture_cell[face] == none) continue;
        const auto value = given.walls[wall_of(mesh, face)];
        if (!value) continue;
        sum += *value / mesh.face_measure[face];
        weights += 1 / mesh.face_measure[face];
      }
      return sum / weights;
    };
    if (source.ends[0] == source.ends[1]) return at_corner(source.ends[0]);
    double sum = 0;
    int count = 0;
    for (const int face : source.faces)
      if (const auto value = given.walls[wall_of(mesh, face)]) sum += *value, ++count;
    const double middle = sum / count, s = source.share;
    return s < 0.5 ? (1 - 2 * s) * at_corner(source.ends[0]) + 2 * s * middle
                   : (2 - 2 * s) * middle + (2 * s - 1) * at_corner(source.ends[1]);
  };
  Vector fixed = Vector::Zero(nodes.size());
  for (std::size_t i = 0; i < nodes.size(); ++i) {
    if (!conducting[i]) continue;
    const Source& source = sources[i];
    fixed[i] = source.on_rim
                   ? (1 - source.share) * given.nodes[source.ends[0]] + source.share * given.nodes[source.ends[1]]
                   : wall_value(source);
  }
  Vector cell_means(cells.size());
  for (std::size_t c = 0; c < cells.size(); ++c) cell_means[c] = given.cells[cells[c]];
  Vector right = -(by_given * fixed);
  right.tail(cell_means.size()) += cell_means;
  const Vector found = factors.solve(right);
  solution = fixed;
  for (std::size_t i = 0; i < nodes.size(); ++i)
    if (unknown[i] != none) (*solution)[i] = found[unknown[i]];
  double low = cell_means.minCoeff(), high = cell_means.maxCoeff();
  for (std::size_t i = 0; i < nodes.size(); ++i)
    if (conducting[i]) low = std::min(low, fixed[i]), high = std::max(high, fixed[i]);
  const double beyond = std::max(low - solution->minCoeff(), solution->maxCoeff() - high), range = high - low;
  weight = range > 0 ? std::clamp((most_overshoot - beyond / range) / (most_overshoot - least_overshoot), 0.0, 1.0) : 0;
}

void PressureNearTips::set(Given given) {
  const bool is_first = given_.cells.size() == 0;
  if (!is_first && given.cells == given_.cells && given.walls == given_.walls && given.nodes == given_.nodes) return;
  given_ = std::move(given);
  for (const auto& region : regions_) region->solution.reset();
}

std::optional<PressureNearTips::Place> PressureNearTips::place(int cell, const Point& x) const {
  const int number = region_of_cell_[cell];
  if (number == none) return std::nullopt;
  const Region& region = *regions_[number];
  const auto index = std::ranges::lower_bound(region.cells, cell) - region.cells.begin();
  Place best{number, {}, {}};
  double most = -std::numeric_limits<double>::infinity();
  const auto cross = [](const Point& u, const Point& v) { return u[0] * v[1] - u[1] * v[0]; };
  for (const std::array<int, 3>& t : region.triangles[index]) {
    const Point &a = region.nodes[t[0]], &b = region.nodes[t[1]], &c = region.nodes[t[2]];
    const double area = cross(b - a, c - a), l0 = cross(b - x, c - x) / area, l1 = cross(c - x, a - x) / area;
    const double least = std::min({l0, l1, 1 - l0 - l1});
    if (least <= most) continue;
    most = least;
    best.nodes = t;
    best.share = {l0, l1, 1 - l0 - l1};
    if (least >= 0) break;
  }
  return best;
}

PressureNearTips::Value PressureNearTips::at(const Place& place) {
  Region& region = *regions_[place.region];
  if (!region.solution) region.solve(given_);
  double sum = 0;
  for (int k = 0; k < 3; ++k) sum += place.share[k] * (*region.solution)[place.nodes[k]];
  return {sum, region.weight};
}

void PressureNearTips::add_pieces(LinearPieces& pieces) {
  for (const auto& region : regions_) {
    if (!region->solution) region->solve(given_);
    if (region->weight == 0) continue;
    for (std::size_t c = 0; c < region->cells.size(); ++c) {
      std::vector<LinearPiece>& of_cell = pieces[region->cells[c]];
      for (const std::array<int, 3>& t : region->triangles[c]) {
        LinearPiece& piece = of_cell.emplace_back();
        piece.weight = region->weight;
        for (int k = 0; k < 3; ++k) {
          piece.corners[k] = region->nodes[t[k]];
          piece.values[k] = (*region->solution)[t[k]];
        }
      }
    }
  }
}

}  // namespace sprekk::couplers
