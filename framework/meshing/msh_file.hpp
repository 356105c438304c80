// The content of a mesh file as it is in the file.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <map>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "framework/types.hpp"

namespace sprekk {

/// Nodes, faces and cells of a file in gmsh's format MSH, version 2.2 or 4.1, text or binary
/// (https://gmsh.info/doc/texinfo/gmsh.html#MSH-file-format). Elements of fewer dimensions than
/// faces and other sections are left out.
struct MshFile {
  /// A node with its number in the file.
  struct Node {
    std::uint64_t number;
    std::array<double, 3> position;  ///< m
    std::size_t place;               ///< bytes before it in the file
  };
  /// A line with two nodes, a triangle or a quadrilateral; in space also a tetrahedron, a wedge or a hexahedron.
  struct Element {
    std::array<std::uint64_t, 1 << dimension> nodes;  ///< by their numbers
    int node_count;
    int group_list;  ///< index into group_lists
    std::size_t place;
  };

  std::vector<Node> nodes;  ///< ascending by number, each once
  std::vector<Element> faces, cells;
  std::vector<std::vector<int>> group_lists;         ///< positive numbers of groups, each once
  std::map<std::pair<int, int>, std::string> names;  ///< of groups, by dimension and number

  /// Names a place for messages: "line 12" or "byte 345".
  std::string where(std::size_t place) const;
  std::string_view bytes;  ///< of the whole file
  bool is_binary = false;
};

/// Parses a mesh file. `bytes` must outlive the result. Throws InputError, beginning with the line or the byte, for a
/// malformed file: another version, a section that ends early, a count or a number of a node that does not match the
/// rest of the file, numbers that are not finite, elements of another kind, an element of an entity that the file does
/// not list.
MshFile parse_msh(std::string_view bytes);

/// 3 for a mesh file with elements that have a volume, else 2, also for what is no mesh.
int dimension_of_msh(std::string_view bytes);

}  // namespace sprekk
