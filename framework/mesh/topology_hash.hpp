// A number that tells whether two meshes have the same topology.
#pragma once

#include <cstdint>

#include "framework/mesh/mesh.hpp"

namespace sprekk {

/// A hash of numbers in their order (FNV-1a, 64 bits): other numbers give another hash, except by accident.
class TopologyHash {
 public:
  template <class Number>
  void add(Number number) {
    auto rest = static_cast<std::uint64_t>(number);
    for (std::size_t i = 0; i < sizeof(rest); ++i, rest >>= 8) value_ = (value_ ^ (rest & 0xff)) * 1099511628211u;
  }
  std::uint64_t value() const { return value_; }

 private:
  std::uint64_t value_ = 14695981039346656037u;
};

/// The hash of the corners of all cells, and of the fracture and the ridges of each fracture cell. It depends neither
/// on positions nor on the number of processes.
inline std::uint64_t topology_hash(const Mesh& mesh) {
  TopologyHash hash;
  for (const CellNodes& corners : mesh.cell_nodes)
    for (const int node : corners) hash.add(node);
  for (const FractureCell& cell : mesh.fracture_cells) {
    hash.add(cell.fracture);
    for (const int ridge : cell.ridges) hash.add(ridge);
  }
  return hash.value();
}

}  // namespace sprekk
