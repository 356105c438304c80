// The cells around a line, and the discrete equations of the flow in them.
#pragma once

#include <functional>
#include <map>
#include <vector>

#include "couplers/well_exchange/patch_of_cells.hpp"
#include "couplers/well_exchange/space/line_field.hpp"
#include "framework/mesh/mesh.hpp"

namespace sprekk::couplers {

/// The sides that cells touch.
struct TouchedSides {
  std::vector<ClosedPlane> planes;
  bool has_fracture = false;  ///< whether they touch a fracture as well
};
TouchedSides touched_sides(const Mesh& mesh, const std::map<int, double>& cells);

/// Up to `most_layers` layers of cells around the cells of a line, in rock of one mobility; the cells around them have
/// the pressure of the line. It touches no fracture, and no side but the planes of the line.
class LinePatch {
 public:
  /// `lengths`: of the line in its cells, m. `field` must outlive the patch. Throws std::invalid_argument as
  /// PatchOfCells does, and where there is no rock around.
  LinePatch(const Mesh& mesh, const MatrixFluxes& fluxes, const std::map<int, double>& lengths, const LineField& field,
            const Tensor& mobility, const std::vector<ClosedPlane>& planes);

  /// The pressures (see LineField) of all cells of the line, in their order, in steady flow; and their
  /// transforms.
  std::vector<double> pressures() const;
  std::vector<double> transformed_pressures(double decay) const;

 private:
  std::vector<double> solve(double decay, const std::function<double(const Point&)>& around) const;

  const LineField& field_;
  std::vector<double> lengths_;  ///< m, of the first cells
  PatchOfCells cells_;
};

}  // namespace sprekk::couplers
