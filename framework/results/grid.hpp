// Fields that a run has written (.pvd, .vtu), read back.
#pragma once

#include <array>
#include <filesystem>
#include <string>
#include <vector>

#include "framework/output/vtk_module/vtk_module.hpp"

namespace sprekk {

/// Triangles or lines with arrays on them, to be drawn: a quadrilateral becomes two triangles with its values.
struct Grid {
  /// The entities that carry an array.
  enum class Place { cell, point };
  /// An array of the file.
  struct Values {
    std::string name;  ///< "quantity[unit]"
    Place place;
    int components;
    std::vector<double> values;                     ///< the components of an entity stand together
    std::vector<std::string> component_names = {};  ///< one for each component, or none: files of earlier versions
  };

  std::vector<std::array<double, 2>> points;
  int points_per_cell = 0;
  std::vector<int> cells;    ///< points of a cell stand together
  std::vector<int> sources;  ///< of each cell, the number of the cell of the file that it is, or is a part of
  std::vector<Values> arrays;

  int cell_count() const { return points_per_cell == 0 ? 0 : static_cast<int>(cells.size()) / points_per_cell; }
  /// nullptr when there is none.
  const Values* find(const std::string& name) const;
};

/// Reads a file that write_matrix_vtu or write_fracture_vtu has written. Throws std::runtime_error. Points lose their
/// z.
Grid read_grid(const std::filesystem::path& vtu);

/// What such a file holds. Throws std::runtime_error for one that cannot be read or is not whole.
GridData read_whole(const std::filesystem::path& vtu);

/// Adds the arrays of a file to a grid whose points, cells and sources are there.
void add_arrays(const GridData& read, Grid& grid);

/// A written time and its file.
struct Snapshot {
  double time;  ///< s
  std::filesystem::path file;
};

/// The written times of an index file, in their order; none when it does not exist.
std::vector<Snapshot> read_index(const std::filesystem::path& pvd);

/// `count` of them, evenly chosen, the first and the last among them; all if there are fewer.
std::vector<Snapshot> evenly_chosen(const std::vector<Snapshot>& all, std::size_t count);

}  // namespace sprekk
