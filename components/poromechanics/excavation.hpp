// Regions of the rock that are taken away.
#pragma once

#include <map>
#include <string>
#include <vector>

#include "framework/assembly/step_time.hpp"
#include "framework/config/spec.hpp"
#include "framework/mesh/mesh.hpp"

namespace sprekk::poromechanics {

/// When and how a region is taken away.
struct ExcavatedRegion {
  Origin origin;
  Data support;  ///< share of its initial stress that still acts on the rock around it; 1 before it is taken away
  Spec spec();
};
using ExcavatedRegions = std::map<std::string, ExcavatedRegion>;  ///< by the name of the region

/// The state of the excavations in a step. A region is taken away when its `support` is below 1. Then its stiffness
/// falls to the part `left_stiffness`, and its pore pressure no longer loads the rock. Of its initial stress and its
/// weight the part `support` is left; the rest loads what is around it (convergence and confinement, Panet and Guenot
/// 1982).
class Excavation {
 public:
  /// Nothing is taken away before `evaluate`. Throws InputError for a region that the mesh does not have.
  Excavation(const ExcavatedRegions& regions, const Mesh& mesh);

  bool is_empty() const { return regions_.empty(); }
  void evaluate(const StepTime& step);
  /// Whether the cell is taken away at some time of the run.
  bool is_excavated(int cell) const { return !regions_.empty() && region_of_cell_[cell] != none; }
  bool is_removed(int cell) const { return support(cell) < 1; }
  double support(int cell) const { return is_excavated(cell) ? support_[region_of_cell_[cell]] : 1; }
  /// Stiffness of the cell over that of its rock.
  double stiffness(int cell) const { return is_removed(cell) ? left_stiffness : 1; }
  std::uint64_t version() const { return version_; }  ///< grows whenever a region is taken away or its support changes
  std::vector<const Data*> data() const;
  /// `alpha`, one value a cell, set to zero in cells that are removed.
  Vector of_rock(Vector alpha) const;
  /// One flag a cell: whether the cell is still there.
  std::vector<char> left() const;

 private:
  /// The stiffness that is left, over that of the rock: not zero, so that displacements inside stay determined.
  /// Displacements around change by about this share.
  static constexpr double left_stiffness = 1e-6;
  std::vector<const ExcavatedRegion*> regions_;
  std::vector<int> region_of_cell_;  ///< the index of each cell's region; empty where no region is taken away
  std::vector<double> support_;
  std::uint64_t version_ = 0;
};

/// Parameters by the name of the region.
void add_excavation(Spec& spec, ExcavatedRegions& regions);

}  // namespace sprekk::poromechanics
