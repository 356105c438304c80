// Values at faces by limited linear reconstruction in the cell that a stream leaves.
#pragma once

#include <utility>
#include <vector>

#include "components/capabilities/carried.hpp"
#include "couplers/advection/streams.hpp"
#include "framework/mesh/mesh.hpp"

namespace sprekk::couplers {

/// By how much the value at a face, or a ridge, differs from that of the cell whose fluid passes it. The gradient of a
/// cell fits the values of its neighbours, and those that are prescribed on its sides, by least squares: it is exact
/// for linear values. The change from the centre to the face is bounded by the difference from the highest and from the
/// lowest value around the cell (in a row of cells this is the limiter MC of van Leer 1977). So a cell that is a local
/// extremum has no gradient, and the values at faces stay within those around the cell. Fluid leaves the highest of all
/// cells with the value of this cell and enters with a lower one: steps of backward Euler of any length make no new
/// extrema.
///
/// In rock, if more fluid flows out of a cell in a step than it holds, changes are multiplied by the ratio of both
/// (`weights`): a front then passes several cells in a step, backward Euler smears it farther than upwinding does, and
/// full changes would only hinder Newton's method. In fractures fluid may pass many cells in a step while the rock
/// takes up what it carries, and profiles are nearly steady: changes count in full, with half the limits.
class LimitedValues {
 public:
  /// In the rock. Neighbours do not lie behind fractures.
  LimitedValues(const Mesh& mesh, const MatrixCarried& carried);
  /// In the fractures. Neighbours do not lie behind crossings.
  LimitedValues(const Mesh& mesh, const FractureCarried& carried);

  /// To be called when the values on sides have been evaluated for a step.
  void begin_step();

  /// By how much the value at the face differs from that of the cell.
  struct Change {
    double value = 0;
    std::vector<std::pair<int, double>> by_cells = {};  ///< the derivatives by values of cells
  };
  /// The weight of changes in each cell of the rock, at most 1; empty, meaning 1, in fractures. `capacity`: what each
  /// cell holds per unit of the value; `amount`: what a unit of rate carries in the step. Collective.
  Vector weights(const std::vector<Stream>& streams, const Vector& capacity, double amount) const;
  /// The change of what the stream carries out of a cell, through a face or a ridge; none for others, and at crossings.
  /// `values`: one a cell.
  Change of(const Stream& stream, const Vector& values, const Vector& weights) const;

 private:
  /// A value to which a gradient is fitted: of a cell, or of a face or ridge on a side.
  struct Link {
    int cell, side;                  ///< exactly one is not none
    Point where;                     ///< seen from the centre of the cell, m
    Point gradient = Point::Zero();  ///< by the difference of this value from that of the cell, 1/m
  };
  struct Around {
    std::vector<Link> links;
    std::vector<int> cells;  ///< whose values bound those at faces
  };

  /// By the linear values, within their bounds.
  Change within_bounds(int cell, const Point& to_face, const Vector& values) const;
  bool is_given(int face) const { return rock_ ? rock_->side_value(face).has_value() : is_given_at_end(face); }
  bool is_given_at_end(int ridge) const { return fractures_->end_value(ridge).has_value(); }
  void look_around_in_rock();
  void look_around_in_fractures();

  const Mesh* mesh_;
  const MatrixCarried* rock_ = nullptr;
  const FractureCarried* fractures_ = nullptr;
  std::vector<Around> around_;  ///< one a cell
  Vector given_;                ///< of each face or ridge on a side with a value
};

}  // namespace sprekk::couplers
