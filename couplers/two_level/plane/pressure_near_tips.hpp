// The pore pressure within the cells around tips, from the means of the cells and the pressures at the walls.
#pragma once

#include <Eigen/Core>
#include <array>
#include <memory>
#include <optional>
#include <vector>

#include "framework/field/linear_pieces.hpp"
#include "framework/mesh/mesh.hpp"

namespace sprekk::couplers {

/// The pressure in the cells of some rings around each tip. Of all pressures that have the means of the cells, the
/// given pressures at the walls, and given values on the rim of the rings, it is the one with the least integral of its
/// squared gradient. So it solves −laplace p = f with one f in each cell, as the balances of cells do, and varies like
/// sqrt(r) near the tip. It is linear in the given values, and continuous in the geometry for one topology of the mesh.
/// It is found by linear elements on a triangulation of the cells, in which the nodes of an edge that ends at a tip are
/// at the parts (i/n)^2 of its length from there.
class PressureNearTips {
 public:
  /// Keeps a reference to the mesh. Throws std::runtime_error where a pressure is not determined.
  explicit PressureNearTips(const Mesh& mesh);
  ~PressureNearTips();
  /// The data of the pressure, Pa: means of the cells, pressures at the walls (none where the wall lets nothing
  /// through), and values of the nodes of the mesh, which are taken on the rim. All must stay until the next call.
  struct Given {
    Vector cells;
    std::vector<std::optional<double>> walls;
    Vector nodes;
  };
  void set(Given given);

  /// A place in the rings.
  struct Place {
    int region;
    std::array<int, 3> nodes;
    std::array<double, 3> share;
  };
  /// Nothing where the cell is in no ring.
  std::optional<Place> place(int cell, const Point& x) const;
  /// A pressure, and its weight against that of a smooth fit. The weight is 1 if the pressure stays within the range of
  /// the given ones. If fluid has reached less than about an eighth of a cell from the walls, the means do not
  /// determine how the pressure falls; the solution then leaves this range, and its weight is smaller, or 0.
  struct Value {
    double value, weight;
  };
  Value at(const Place& place);  ///< Pa
  /// Adds the pressure in all cells of the rings.
  void add_pieces(LinearPieces& pieces);

 private:
  struct Region;
  const Mesh& mesh_;
  std::vector<std::unique_ptr<Region>> regions_;
  std::vector<int> region_of_cell_;
  Given given_;
};

}  // namespace sprekk::couplers
