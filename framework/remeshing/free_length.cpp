#include "framework/remeshing/free_length.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>

#include "framework/remeshing/obstacles.hpp"
#include "framework/round_off.hpp"

namespace sprekk {

FreeLength free_length(const Mesh& mesh, int fracture, bool at_end, const Point& from, const Point& direction) {
  if (!(direction.norm() > 0)) throw std::invalid_argument("free_length: the direction has no length");
  const Point u = direction.normalized();
  FreeLength free{std::numeric_limits<double>::infinity(), FreeLength::Met::nothing, none, from};
  const auto meet = [&](const Segment& s, FreeLength::Met met, int index) {
    const Point v = s.to - s.from, w = s.from - from;
    const double determinant = cross(u, v), length = v.norm();
    double t;
    if (std::abs(determinant) > rounding::of_terms * length) {
      t = cross(w, v) / determinant;
      const double along = cross(w, u) / determinant;
      if (along < -rounding::same || along > 1 + rounding::same) return;
    } else {
      // A parallel segment is met, at its nearer end, only if it lies ahead on the same line.
      if (std::abs(cross(w, u)) > rounding::same * length) return;
      t = std::min(w.dot(u), (w + v).dot(u));
    }
    if (t < 0 || t >= free.length) return;
    free = {t, met, index, from + t * u};
  };
  for (int face = 0; face < mesh.face_count(); ++face) {
    if (mesh.face_side[face] != none) {
      meet(face_segment(mesh, face), FreeLength::Met::boundary, mesh.face_side[face]);
    }
  }
  const auto& own = mesh.fractures.at(fracture);
  const int own_last = at_end ? own.first_cell + own.cell_count - 1 : own.first_cell;
  for (int cell = 0; cell < mesh.fracture_cell_count(); ++cell) {
    if (cell != own_last) meet(cell_segment(mesh, cell), FreeLength::Met::fracture, mesh.fracture_cells[cell].fracture);
  }
  return free;
}

}  // namespace sprekk
