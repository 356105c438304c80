#include "couplers/two_level/plane/along_fracture.hpp"

#include <algorithm>

#include "couplers/two_level/plane/straight_piece.hpp"

namespace sprekk::couplers {

AlongFracture::AlongFracture(const Mesh& mesh, int fracture) {
  const Fracture& all = mesh.fractures[fracture];
  double length = 0;
  for (int i = all.first_cell; i < all.first_cell + all.cell_count; ++i) {
    const FractureCell& cell = mesh.fracture_cells[i];
    cells_.push_back({i, length, length + cell.measure, is_straight_on(mesh, i), cell, {}});
    length += cell.measure;
  }
  for (const Junction& junction : mesh.junctions)
    for (const int i : junction.cells) {
      const FractureCell& cell = mesh.fracture_cells[i];
      if (cell.fracture != fracture) continue;
      const Point& position = mesh.ridges[junction.ridges[0]].center;
      const int end = (position - cell.center).dot(cell.tangents) > 0 ? 1 : 0;
      cells_[i - all.first_cell].at_junction[end].emplace(mesh, junction);
    }
  const auto is_tip = [&](int point) { return mesh.ridges[point].kind == Ridge::Kind::tip; };
  tip_at_first_ = is_tip(mesh.fracture_cells[cells_.front().index].ridges[0]);
  tip_at_last_ = is_tip(mesh.fracture_cells[cells_.back().index].ridges[1]);
}

std::size_t AlongFracture::cell_at(double s) const {
  const auto after =
      std::upper_bound(cells_.begin(), cells_.end(), s, [](double at, const Cell& cell) { return at < cell.end; });
  return std::min<std::size_t>(after - cells_.begin(), cells_.size() - 1);
}

Point AlongFracture::at(double s, const Vector& values) const {
  const std::size_t i = cell_at(s);
  const Cell& cell = cells_[i];
  const double middle = 0.5 * (cell.begin + cell.end);
  Point local = values.segment<dimension>(dimension * cell.index);
  const bool ahead = s > middle;
  if (ahead ? cell.continues : (i > 0 && cells_[i - 1].continues)) {
    const Cell& other = cells_[ahead ? i + 1 : i - 1];
    const double part = (s - middle) / (0.5 * (other.begin + other.end) - middle);
    local += part * (Point(values.segment<dimension>(dimension * other.index)) - local);
  }
  return cell.frame.to_global(local);
}

Point AlongFracture::jump(double s, const Vector& values) const {
  const Cell& cell = cells_[cell_at(s)];
  const double half = 0.5 * (cell.end - cell.begin), from_middle = s - cell.begin - half;
  if (const auto& junction = cell.at_junction[from_middle > 0 ? 1 : 0]) {
    const Point middle = cell.frame.to_global(values.segment<dimension>(dimension * cell.index));
    const double part = std::min(1.0, std::abs(from_middle) / half);
    return middle + part * (junction->of(cell.index, values) - middle);
  }
  return vanishing_at_tips(s, values);
}

Point AlongFracture::vanishing_at_tips(double s, const Vector& values) const {
  const Cell &first = cells_.front(), &last = cells_.back();
  if (tip_at_first_ && s < 0.5 * (first.begin + first.end))
    return std::max(0.0, s / (0.5 * (first.begin + first.end))) * at(s, values);
  const double to_end = last.end - s, half = 0.5 * (last.end - last.begin);
  if (tip_at_last_ && to_end < half) return std::max(0.0, to_end / half) * at(s, values);
  return at(s, values);
}

}  // namespace sprekk::couplers
