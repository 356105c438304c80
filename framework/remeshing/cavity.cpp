#include "framework/remeshing/cavity.hpp"

#include <algorithm>

#include "framework/invariants.hpp"
#include "framework/round_off.hpp"

namespace sprekk {
namespace {

class Choice {
 public:
  Choice(const Mesh& mesh, const std::vector<int>& merged)
      : mesh_(mesh),
        merged_(merged),
        is_in_(mesh.cell_count()),
        node_count_(1 + *std::max_element(merged.begin(), merged.end())) {}

  std::vector<bool> run(const std::vector<std::vector<Segment>>& paths, const std::vector<double>& radii) {
    std::vector<bool> is_near(node_count_);
    SPREKK_EXPECT(paths.size() == radii.size(), paths.size(), radii.size());
    for (std::size_t p = 0; p < paths.size(); ++p) take_near(paths[p], radii[p], is_near);
    for (int cell = 0; cell < mesh_.cell_count(); ++cell) {
      for (const int node : mesh_.cell_nodes[cell]) {
        if (is_near[merged_[node]]) is_in_[cell] = true;
      }
    }
    while (fill_notches() || part_pinches()) {
    }
    return is_in_;
  }

 private:
  void take_near(const std::vector<Segment>& path, double radius, std::vector<bool>& is_near) {
    SPREKK_EXPECT(!path.empty() && radius > 0, path.size(), radius);
    Point low = path.front().from, high = low;
    for (const auto& [from, to] : path) low = low.cwiseMin(to), high = high.cwiseMax(to);
    const Point wide = Point::Constant(radius);
    for (int cell = 0; cell < mesh_.cell_count(); ++cell) {
      const Point& center = mesh_.cell_center[cell];
      const bool may_be_near =
          (center.array() >= (low - wide).array()).all() && (center.array() <= (high + wide).array()).all();
      Point cell_low = center, cell_high = center;
      for (const int node : mesh_.cell_nodes[cell]) {
        cell_low = cell_low.cwiseMin(mesh_.nodes[node]);
        cell_high = cell_high.cwiseMax(mesh_.nodes[node]);
      }
      const bool may_meet = (cell_high.array() >= low.array()).all() && (cell_low.array() <= high.array()).all();
      if (!may_be_near && !may_meet) continue;
      for (const Segment& s : path) {
        if (may_be_near && distance(center, s) < radius) is_in_[cell] = true;
        if (may_meet && meets_cell(mesh_, cell, s)) {
          for (const int node : mesh_.cell_nodes[cell]) is_near[merged_[node]] = true;
        }
      }
    }
  }

  bool fill_notches() {
    std::vector<int> front;
    for (int cell = 0; cell < mesh_.cell_count(); ++cell) {
      if (!is_in_[cell] && is_notch(cell)) front.push_back(cell);
    }
    const bool changed = !front.empty();
    while (!front.empty()) {
      const int cell = front.back();
      front.pop_back();
      if (is_in_[cell]) continue;
      is_in_[cell] = true;
      for (int k = 0; k < mesh_.cell_faces[cell].size(); ++k) {
        const int next = cell_across(mesh_, cell, k);
        if (next != none && !is_in_[next] && is_notch(next)) front.push_back(next);
      }
    }
    return changed;
  }

  bool is_notch(int cell) const {
    const int sides = mesh_.cell_faces[cell].size();
    int in = 0, out = 0;
    for (int k = 0; k < sides; ++k) {
      const int next = cell_across(mesh_, cell, k);
      if (next != none) ++(is_in_[next] ? in : out);
    }
    return in >= sides - 1 || (in > 0 && out == 0);
  }

  /// Adds all cells around nodes at which the rim of the cavity touches itself (more than one rim edge begins there);
  /// returns whether there are any.
  bool part_pinches() {
    std::vector<char> leaving(node_count_, 0);
    bool is_pinched = false;
    for (int cell = 0; cell < mesh_.cell_count(); ++cell) {
      if (!is_in_[cell]) continue;
      for (int k = 0; k < mesh_.cell_faces[cell].size(); ++k) {
        const int next = cell_across(mesh_, cell, k);
        if (next != none && is_in_[next]) continue;
        if (++leaving[merged_[mesh_.cell_nodes[cell][k]]] > 1) is_pinched = true;
      }
    }
    if (!is_pinched) return false;
    for (int cell = 0; cell < mesh_.cell_count(); ++cell) {
      for (const int node : mesh_.cell_nodes[cell]) {
        if (leaving[merged_[node]] > 1) is_in_[cell] = true;
      }
    }
    return true;
  }

  const Mesh& mesh_;
  const std::vector<int>& merged_;
  std::vector<bool> is_in_;
  const int node_count_;
};

}  // namespace

int cell_across(const Mesh& mesh, int cell, int k) {
  SPREKK_EXPECT(is_index(cell, mesh.cell_count()), cell, mesh.cell_count());
  SPREKK_EXPECT(is_index(k, mesh.cell_faces[cell].size()), cell, k);
  const int face = mesh.cell_faces[cell][k];
  const int fracture_cell = mesh.face_fracture_cell[face];
  if (fracture_cell != none) {
    const auto& walls = mesh.fracture_cells[fracture_cell].faces;
    return mesh.face_cells[walls[walls[0] == face ? 1 : 0]][0];
  }
  const auto& [one, other] = mesh.face_cells[face];
  return one == cell ? other : one;
}

std::vector<bool> choose_cavity(const Mesh& mesh, const std::vector<int>& merged,
                                const std::vector<std::vector<Segment>>& paths, const std::vector<double>& radii) {
  return Choice(mesh, merged).run(paths, radii);
}

std::vector<int> connected_parts(const Mesh& mesh, const std::vector<bool>& is_marked) {
  std::vector<int> part(mesh.cell_count(), none);
  SPREKK_EXPECT(static_cast<int>(is_marked.size()) == mesh.cell_count(), is_marked.size(), mesh.cell_count());
  int parts = 0;
  for (int first = 0; first < mesh.cell_count(); ++first) {
    if (!is_marked[first] || part[first] != none) continue;
    std::vector<int> front{first};
    part[first] = parts;
    while (!front.empty()) {
      const int cell = front.back();
      front.pop_back();
      for (int k = 0; k < mesh.cell_faces[cell].size(); ++k) {
        const int next = cell_across(mesh, cell, k);
        if (next == none || !is_marked[next] || part[next] != none) continue;
        part[next] = parts;
        front.push_back(next);
      }
    }
    ++parts;
  }
  return part;
}

bool meets_cell(const Mesh& mesh, int cell, const Segment& segment) {
  const Ring& corners = mesh.cell_nodes[cell];
  bool is_inside = true;
  for (int k = 0; k < corners.size(); ++k) {
    const Point &a = mesh.nodes[corners[k]], &b = mesh.nodes[corners.after(k)];
    if (distance(segment, Segment{a, b}) <= rounding::same * (b - a).norm()) return true;
    is_inside = is_inside && signed_area(a, b, segment.from) > 0;
  }
  return is_inside;
}

}  // namespace sprekk
