#include "framework/remeshing/path_nodes.hpp"

#include <algorithm>
#include <limits>

#include "framework/invariants.hpp"
#include "framework/mesh/plane/planar.hpp"
#include "framework/meshing/plane/graded_division.hpp"
#include "framework/meshing/plane/narrow_gaps.hpp"
#include "framework/round_off.hpp"

namespace sprekk {
namespace {

/// The growth of the lengths of edges along a path away from a short edge, m per m: steeper grading leaves small
/// angles.
constexpr double growth_along = 0.5;

class Placement {
 public:
  Placement(const Mesh& mesh, const RawMesh& raw, const std::vector<int>& merged, double size, double gap_edges)
      : mesh_(mesh), merged_(merged), size_(size), gap_edges_(gap_edges), is_on_fracture_(raw.nodes.size()) {
    result_.nodes = raw.nodes;
    for (const auto& [name, nodes] : raw.fractures) {
      for (const int node : nodes) is_on_fracture_[node] = true;
    }
    for (int face = 0; face < mesh.face_count(); ++face) {
      const auto [one, other] = mesh.face_cells[face];
      if (other != none && mesh.cell_region[one] != mesh.cell_region[other]) interfaces_.push_back(face);
    }
  }

  PathNodes run(const RawMesh& raw, const std::vector<PathExtension>& extensions) {
    for (const auto& [fracture, at_end, points, replaced, whole_segments, divides] : extensions) {
      const auto& chain = raw.fractures[fracture].nodes;
      SPREKK_EXPECT(is_index(fracture, static_cast<long>(raw.fractures.size())), fracture);
      SPREKK_EXPECT(!points.empty(), fracture);
      std::vector<int> path{at_end ? chain.back() : chain.front()};
      for (const Point& x : points) path.push_back(add(x));
      const bool is_end_fixed = put_end_on_boundary(path.back()) || put_end_on_fracture(path.back());
      if (!interfaces_.empty()) {
        meet_interfaces(path, is_end_fixed);
        pass_interface_nodes(path);
        cross_interfaces(path);
      }
      if (gap_edges_ > 0) find_narrow_places(path, fracture);
      result_.paths.push_back(whole_segments ? path : divide(path));
    }
    return std::move(result_);
  }

 private:
  int add(const Point& x) {
    result_.nodes.push_back(x);
    return static_cast<int>(result_.nodes.size()) - 1;
  }
  const Point& at(int node) const { return result_.nodes[node]; }
  std::array<int, 2> ends(int face) const {
    SPREKK_EXPECT(is_index(face, mesh_.face_count()), face);
    return {merged_[mesh_.face_nodes[face][0]], merged_[mesh_.face_nodes[face][1]]};
  }
  Segment segment(int face) const { return {at(ends(face)[0]), at(ends(face)[1])}; }
  double snap(int face) const { return interface_snap * std::min(size_, mesh_.face_measure[face]); }

  bool put_end_on_boundary(int& end) {
    for (int face = 0; face < mesh_.face_count(); ++face) {
      if (mesh_.face_side[face] == none || distance(at(end), segment(face)) > rounding::same * size_) continue;
      for (const int node : ends(face)) {
        if ((at(node) - at(end)).norm() > rounding::same * size_) continue;
        end = node;
        return true;
      }
      result_.on_face[face].push_back(end);
      return true;
    }
    return false;
  }

  bool put_end_on_fracture(int& end) {
    for (std::size_t node = 0; node < is_on_fracture_.size(); ++node) {
      if (!is_on_fracture_[node] || (at(static_cast<int>(node)) - at(end)).norm() > rounding::same * size_) continue;
      end = static_cast<int>(node);
      return true;
    }
    return false;
  }

  /// Moves points of the path that are near an interface onto the interface. The old tip stays, and so does an end on
  /// the outer boundary or on a fracture.
  void meet_interfaces(std::vector<int>& path, bool is_end_fixed) {
    for (std::size_t i = 1; i < path.size() - (is_end_fixed ? 1 : 0); ++i) {
      int nearest = none;
      double least = std::numeric_limits<double>::infinity();
      for (const int face : interfaces_) {
        const double d = distance(at(path[i]), segment(face));
        if (d < snap(face) && d < least) least = d, nearest = face;
      }
      if (nearest == none) continue;
      const auto [a, b] = ends(nearest);
      if (path[i] == a || path[i] == b) continue;
      const Segment face = segment(nearest);
      const int end = (at(a) - at(path[i])).norm() < (at(b) - at(path[i])).norm() ? a : b;
      if (!is_on_fracture_[end] && (at(end) - at(path[i])).norm() < snap(nearest)) {
        path[i] = end;
      } else {
        const Point along = face.to - face.from;
        result_.nodes[path[i]] = face.from + (at(path[i]) - face.from).dot(along) / along.squaredNorm() * along;
        result_.on_face[nearest].push_back(path[i]);
      }
    }
  }

  void pass_interface_nodes(std::vector<int>& path) {
    std::vector<int> passed{path.front()};
    for (std::size_t i = 0; i + 1 < path.size(); ++i) {
      const Segment s{at(path[i]), at(path[i + 1])};
      std::vector<std::pair<double, int>> found;
      for (const int face : interfaces_) {
        for (const int node : ends(face)) {
          if (is_on_fracture_[node] || std::find(path.begin(), path.end(), node) != path.end()) continue;
          if (distance(at(node), s) < snap(face)) found.emplace_back((at(node) - s.from).dot(s.to - s.from), node);
        }
      }
      std::sort(found.begin(), found.end());
      found.erase(std::unique(found.begin(), found.end()), found.end());
      for (const auto& [way, node] : found) passed.push_back(node);
      passed.push_back(path[i + 1]);
    }
    path = std::move(passed);
  }

  void cross_interfaces(std::vector<int>& path) {
    std::vector<int> crossed{path.front()};
    for (std::size_t i = 0; i + 1 < path.size(); ++i) {
      const Segment s{at(path[i]), at(path[i + 1])};
      std::vector<std::pair<double, int>> found;
      for (const int face : interfaces_) {
        Point crossing;
        if (is_on(path[i], face) || is_on(path[i + 1], face) || !cross_inside(s, segment(face), crossing)) continue;
        const int node = add(crossing);
        result_.on_face[face].push_back(node);
        found.emplace_back((crossing - s.from).norm(), node);
      }
      std::sort(found.begin(), found.end());
      for (const auto& [way, node] : found) crossed.push_back(node);
      crossed.push_back(path[i + 1]);
    }
    path = std::move(crossed);
  }

  bool is_on(int node, int face) const {
    const auto [a, b] = ends(face);
    if (node == a || node == b) return true;
    const auto found = result_.on_face.find(face);
    return found != result_.on_face.end() &&
           std::find(found->second.begin(), found->second.end(), node) != found->second.end();
  }

  /// A segment with which a path may form a narrow gap. A side or a fracture on which the path ends is no obstacle:
  /// both meet at an angle, without a gap.
  struct Obstacle {
    Segment segment;
    double least;  ///< m, the length of edges beside it that cannot change
  };
  std::vector<Obstacle> obstacles_near(const std::vector<int>& path, int fracture) const {
    int side = none;
    for (const auto& [face, nodes] : result_.on_face) {
      if (std::find(nodes.begin(), nodes.end(), path.back()) != nodes.end() && mesh_.face_side[face] != none)
        side = mesh_.face_side[face];
    }
    for (int face = 0; face < mesh_.face_count() && side == none; ++face) {
      if (mesh_.face_side[face] != none && (ends(face)[0] == path.back() || ends(face)[1] == path.back()))
        side = mesh_.face_side[face];
    }
    std::vector<Obstacle> near;
    const auto add = [&](const Segment& segment, double least) {
      for (std::size_t i = 0; i + 1 < path.size(); ++i) {
        if (distance(segment, Segment{at(path[i]), at(path[i + 1])}) >= gap_edges_ * size_) continue;
        near.push_back({segment, least});
        return;
      }
    };
    for (int face = 0; face < mesh_.face_count(); ++face) {
      if (mesh_.face_side[face] != none && mesh_.face_side[face] != side) add(segment(face), least_gap_part * size_);
    }
    std::vector<char> is_joined(mesh_.fractures.size(), false);
    for (const FractureCell& cell : mesh_.fracture_cells) {
      const auto nodes = ends(cell.faces[0]);
      if (nodes[0] == path.back() || nodes[1] == path.back()) is_joined[cell.fracture] = true;
    }
    for (const FractureCell& cell : mesh_.fracture_cells) {
      if (cell.fracture != fracture && !is_joined[cell.fracture]) add(segment(cell.faces[0]), cell.measure);
    }
    return near;
  }

  void find_narrow_places(const std::vector<int>& path, int fracture) {
    const std::vector<Obstacle> obstacles = obstacles_near(path, fracture);
    if (obstacles.empty()) return;
    for (std::size_t i = 0; i + 1 < path.size(); ++i) {
      for (int k = 0; k <= samples_of_length; ++k) {
        const Point x = at(path[i]) + k * (at(path[i + 1]) - at(path[i])) / samples_of_length;
        double size = size_;
        for (const auto& [segment, least] : obstacles)
          size = std::min(size, std::max(distance(x, segment) / gap_edges_, least));
        if (size < size_) result_.narrow.push_back({x, size});
      }
    }
  }

  std::vector<int> divide(const std::vector<int>& path) {
    // Between interfaces there may be short pieces; edges grow with the distance from these.
    std::vector<Segment> pieces;
    for (std::size_t i = 0; i + 1 < path.size(); ++i) pieces.push_back({at(path[i]), at(path[i + 1])});
    const auto wanted = [&](const Point& x) {
      double least = size_;
      for (const Segment& piece : pieces) {
        if (piece.length() < 0.5 * size_) least = std::min(least, piece.length() + growth_along * distance(x, piece));
      }
      for (const auto& [position, size] : result_.narrow)
        least = std::min(least, size + growth_along * (x - position).norm());
      return least;
    };
    std::vector<int> divided{path.front()};
    for (std::size_t i = 0; i + 1 < path.size(); ++i) {
      if (!lie_on_one_interface(path[i], path[i + 1])) {
        for (const Point& x : graded_division(pieces[i], wanted)) divided.push_back(add(x));
      }
      divided.push_back(path[i + 1]);
    }
    return divided;
  }

  bool lie_on_one_interface(int a, int b) const {
    return std::any_of(interfaces_.begin(), interfaces_.end(),
                       [&](int face) { return is_on(a, face) && is_on(b, face); });
  }

  const Mesh& mesh_;
  const std::vector<int>& merged_;
  const double size_, gap_edges_;
  std::vector<bool> is_on_fracture_;  ///< per raw node
  std::vector<int> interfaces_;
  PathNodes result_;
};

}  // namespace

PathNodes place_path_nodes(const Mesh& mesh, const RawMesh& raw, const std::vector<int>& merged,
                           const std::vector<PathExtension>& extensions, double size, double gap_edges) {
  return Placement(mesh, raw, merged, size, gap_edges).run(raw, extensions);
}

}  // namespace sprekk
