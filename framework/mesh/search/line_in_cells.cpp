#include "framework/mesh/search/line_in_cells.hpp"

#include <algorithm>
#include <functional>
#include <limits>
#include <stdexcept>

#include "framework/invariants.hpp"
#include "framework/mesh/geometry.hpp"
#include "framework/mesh/search/point_location.hpp"

namespace sprekk {
namespace {

constexpr double step = 0.25;         // in heights of cells: the longest part whose ends alone are located
constexpr double shortest = 1e-12;    // of the line: the error of the place where it enters a cell
constexpr double negligible = 1e-10;  // of the line: pieces between cells that touch there

/// The height over the largest face, m, of a box; a third of that of a tetrahedron.
double height(const Mesh& mesh, int cell) {
  double largest = 0;
  for (const int face : mesh.cell_faces[cell]) largest = std::max(largest, mesh.face_measure[face]);
  return mesh.cell_measure[cell] / largest;
}

}  // namespace

std::vector<PieceInCell> line_in_cells(const Mesh& mesh, const std::vector<Point>& line) {
  SPREKK_EXPECT(line.size() > 1, line.size());
  double length = 0;
  for (std::size_t k = 1; k < line.size(); ++k) length += (line[k] - line[k - 1]).norm();
  SPREKK_EXPECT(length > 0, length);
  const PointLocation location(mesh);
  const auto cell_at = [&](const Point& x) {
    const int cell = location.cell_at(x);
    if (cell == none) throw std::invalid_argument("there is no cell at " + to_text(x));
    return cell;
  };
  std::vector<PieceInCell> pieces;
  std::size_t first = 0;  // of the straight part
  const std::function<void(const Point&, int, const Point&, int)> add = [&](const Point& from, int at_from,
                                                                            const Point& to, int at_to) {
    const double part = (to - from).norm();
    const bool is_in_one = at_from == at_to && part <= step * height(mesh, at_from);
    const double round_off =
        4 * std::numeric_limits<double>::epsilon() * std::max(from.cwiseAbs().maxCoeff(), to.cwiseAbs().maxCoeff());
    if (!is_in_one && part > std::max(shortest * length, round_off)) {
      const Point middle = 0.5 * (from + to);
      const int at_middle = cell_at(middle);
      add(from, at_from, middle, at_middle);
      add(middle, at_middle, to, at_to);
    } else if (pieces.size() > first && pieces.back().cell == at_from) {
      pieces.back().to = to;
    } else {
      pieces.push_back({at_from, from, to});
    }
  };
  for (std::size_t k = 1; k < line.size(); ++k) {
    first = pieces.size();
    add(line[k - 1], cell_at(line[k - 1]), line[k], cell_at(line[k]));
  }
  std::erase_if(pieces, [&](const PieceInCell& piece) { return (piece.to - piece.from).norm() < negligible * length; });
  return pieces;
}

}  // namespace sprekk
