// The part of VTK that Sprekk uses: files of unstructured grids (.vtu).
#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

namespace sprekk {

/// The content of a .vtu file.
struct GridData {
  /// Named values on points or on cells.
  struct Array {
    std::string name;
    int components;
    std::vector<double> values;                     ///< the components of an entity stand together
    bool is_integer = false;                        ///< whether the file stores them as 32-bit integers
    std::vector<std::string> component_names = {};  ///< one for each component, or none
  };
  std::vector<double> points;             ///< x, y, z of each
  std::vector<std::int64_t> cell_points;  ///< numbers of points, of one cell after the other
  std::vector<std::int64_t> cell_ends;    ///< of each cell, the number of entries of `cell_points` up to its end
  int cell_dimension = 0;                 ///< of lines 1, of triangles and quadrilaterals 2, of bodies 3
  std::vector<Array> on_points, on_cells;

  int point_count() const { return static_cast<int>(points.size() / 3); }
  int cell_count() const { return static_cast<int>(cell_ends.size()); }
};

/// The module "vtk".
class VtkModule {
 public:
  virtual ~VtkModule() = default;
  /// Reads arrays of all types of numbers; arrays without a name are left out. Throws std::runtime_error for a file
  /// that cannot be read.
  virtual GridData read(const std::filesystem::path& vtu) const = 0;
  /// The text of a .vtu file with all the bits of the numbers: appended, raw, not compressed. The shape of a
  /// cell follows from its dimension and its number of points; those of bodies are in the order of gmsh.
  virtual std::string text_of(const GridData& grid) const = 0;
};

}  // namespace sprekk
