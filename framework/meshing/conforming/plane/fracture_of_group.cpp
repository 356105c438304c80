#include <algorithm>
#include <map>

#include "framework/config/input_error.hpp"
#include "framework/meshing/conforming/face_group.hpp"

namespace sprekk {
namespace {

/// Orders lines into one path.
class Path {
 public:
  explicit Path(const FaceGroup& group) : group_(group) {
    for (const auto& [a, b] : group.faces) {
      neighbours_[a].push_back(b);
      neighbours_[b].push_back(a);
    }
  }

  std::vector<int> nodes() const {
    int ends = 0;
    for (const auto& [node, joined] : neighbours_) {
      if (joined.size() > 2) throw InputError("fracture '" + group_.name + "' branches (a fracture is one line)");
      if (joined.size() == 1) ++ends;
    }
    if (ends == 0) throw InputError("fracture '" + group_.name + "' is a closed loop (a fracture has two ends)");
    const auto [first, second] = group_.faces.front();
    auto nodes = walk(second, first);
    std::reverse(nodes.begin(), nodes.end());
    const auto ahead = walk(first, second);
    nodes.insert(nodes.end(), ahead.begin(), ahead.end());
    if (nodes.size() != group_.faces.size() + 1) {
      throw InputError("fracture '" + group_.name +
                       "' is in several parts (a fracture is one line) give each its own group");
    }
    return nodes;
  }

 private:
  /// The nodes of the path from `node` to the end that is not on the side of `previous`.
  std::vector<int> walk(int previous, int node) const {
    std::vector<int> nodes{node};
    while (nodes.size() <= group_.faces.size()) {
      const auto& joined = neighbours_.at(node);
      if (joined.size() < 2) break;
      const int next = joined[0] == previous ? joined[1] : joined[0];
      previous = node;
      node = next;
      nodes.push_back(node);
    }
    return nodes;
  }

  const FaceGroup& group_;
  std::map<int, std::vector<int>> neighbours_;
};

}  // namespace

RawMesh::Fracture fracture_of(const FaceGroup& group) { return {group.name, Path(group).nodes()}; }

}  // namespace sprekk
