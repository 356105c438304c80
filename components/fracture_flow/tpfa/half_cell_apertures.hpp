// The apertures of the two half cells beside a ridge, where the opening of the fracture changes from cell to cell.
#pragma once

#include <array>

namespace sprekk::fracture_flow {

/// A cell at a ridge: half of its length, its aperture a, and its opening w = a − initial aperture, m.
struct CellAperture {
  double half_length, aperture, opening;
};

/// The aperture in the middle of a half cell, and its derivatives by the apertures of both cells.
struct HalfCellAperture {
  double value;
  std::array<double, 2> by_aperture;
};

/// The apertures of the two half cells beside a ridge. The opening is linear between the centres of the two cells: at
/// the ridge it is w_f = (h_2 w_1 + h_1 w_2)/(h_1 + h_2). The initial aperture is that of each cell. So half cells in
/// series are exact where initial apertures jump, and of second order where the opening is smooth. They let fluid into
/// a closed cell: with w_2 = 0 and equal lengths the aperture of its half cell is a_2 + w_1/4. With the apertures of
/// cells, 1/(1/a_1^3 + 1/a_2^3) vanishes with a_2, so a fracture would never open into a new cell. (Codes for hydraulic
/// fractures take the mean of both apertures there: Peirce and Detournay, Comput. Methods Appl. Mech. Engrg. 197 (2008)
/// 2858.)
inline std::array<HalfCellAperture, 2> half_cell_apertures(const CellAperture& first, const CellAperture& second) {
  const auto half = [](const CellAperture& own, const CellAperture& other, bool is_first) {
    const double share = 0.5 * own.half_length / (own.half_length + other.half_length);
    const double value = own.aperture + share * (other.opening - own.opening);
    return HalfCellAperture{value, {is_first ? 1 - share : share, is_first ? share : 1 - share}};
  };
  return {half(first, second, true), half(second, first, false)};
}

}  // namespace sprekk::fracture_flow
