// The properties of rock and fluid, what follows from them, and checks of them.
#include <algorithm>
#include <stdexcept>

#include "components/matrix_flow/matrix_flow.hpp"
#include "framework/discretization/linear_fit.hpp"
#include "framework/discretization/principal_axes.hpp"
#include "framework/invariants.hpp"
#include "framework/mesh/separated_mesh.hpp"

namespace sprekk::matrix_flow {

std::vector<const Data*> MatrixFlow::properties() const {
  const TensorData& k = options_.permeability;
  std::vector<const Data*> data = {&options_.viscosity};
  for (const Data& component : k.component) data.push_back(&component);
  for (const std::optional<Data>* given : {&options_.storage, &options_.porosity, &options_.fluid_compressibility})
    if (*given) data.push_back(&**given);
  return data;
}

void MatrixFlow::use_properties() {
  if (!options_.storage && !pores_) storage_.set(porosity_.values().cwiseProduct(compressibility_.values()));
  if (by_state_) {  // take_permeability does the rest
    if (well_cells_.empty()) place_wells();
    return;
  }
  std::uint64_t version = viscosity_.version();
  for (const Property& entry : permeability_) version += entry.version();
  if (version == mobility_version_) return;
  mobility_.resize(mesh_.cell_count());
  for (int c = 0; c < mesh_.cell_count(); ++c) {
    std::array<double, symmetric_components> permeability;
    for (int k = 0; k < symmetric_components; ++k) permeability[k] = permeability_[k][c];
    mobility_[c] = symmetric_tensor(permeability) / viscosity_[c];
    SPREKK_ASSERT(viscosity_[c] > 0 && mobility_[c].allFinite(), c, viscosity_[c]);
  }
  check_mobility();
  place_wells();
  mobility_version_ = version;  // at the end: a mobility may be refused
}

void MatrixFlow::check_mobility() {
  long sealed = 0, cells = 0;
  for (int c = 0; c < mesh_.cell_count(); ++c) {
    if (!is_in_cell(c)) continue;
    const Tensor& mobility = mobility_[c];
    ++cells;
    sealed += mobility.isZero(0);
    if (!mobility.isZero(0) && !(mobility.determinant() > 0))
      throw DataError(InputError(origin_, "the permeability is not positive definite",
                                 "fluid could not flow in one direction", "raise it in that direction")
                          .what());
  }
  is_sealed_ = sealed == cells;
  if (sealed > 0 && !is_sealed_)
    throw DataError(InputError(origin_, "the permeability is zero in a part of the rock",
                               "there is no pressure at the face of a cell that lets no fluid through",
                               "give that part a very small permeability, or name the others in 'regions'")
                        .what());
}

void MatrixFlow::check_sides() const {
  for (const auto& [side, condition] : options_.boundary)
    if (std::find(mesh_.side_names.begin(), mesh_.side_names.end(), side) == mesh_.side_names.end())
      throw unknown_name(condition.origin, "side of the boundary", side, mesh_.side_names);
  for (const auto& [name, well] : options_.wells) {
    for (const auto& [cell, weight] : well_cells_.at(name))
      if (!is_in_cell(cell))
        throw InputError(well.origin, "well '" + name + "' lies in rock without a flow",
                         "the region " + mesh_.region_names[mesh_.cell_region[cell]] + " is not one of 'regions'",
                         "move it, or name the region");
  }
  for (const auto& [side, condition] : options_.boundary) {
    bool is_reached = false;
    for (int f = 0; f < mesh_.face_count() && !is_reached; ++f)
      is_reached = mesh_.face_side[f] != none && mesh_.side_names[mesh_.face_side[f]] == side &&
                   is_in_cell(mesh_.face_cells[f][0]);
    if (!is_reached)
      throw InputError(condition.origin, "the condition on side '" + side + "' has no effect",
                       options_.regions.empty() ? "its parts cover it" : "none of 'regions' reaches this side",
                       options_.regions.empty() ? "remove it" : "remove it, or name the region there");
  }
}

void MatrixFlow::find_regions() {
  if (options_.regions.empty()) return;
  std::vector<char> is_named(mesh_.region_names.size(), 0);
  for (const std::string& region : options_.regions) {
    const auto found = std::find(mesh_.region_names.begin(), mesh_.region_names.end(), region);
    if (found == mesh_.region_names.end())
      throw unknown_name(options_.regions_origin, "region", region, mesh_.region_names);
    is_named[found - mesh_.region_names.begin()] = 1;
  }
  std::vector<char> inside(mesh_.cell_count());
  for (int c = 0; c < mesh_.cell_count(); ++c) inside[c] = is_named[mesh_.cell_region[c]];
  const auto cells = std::count(inside.begin(), inside.end(), 1);
  if (cells == 0)
    throw InputError(options_.regions_origin, "there is no flow anywhere", "no cell is in these regions",
                     "name others");
  if (cells == mesh_.cell_count()) return;
  separated_ = separated_mesh(mesh_, inside);
  inside_ = std::move(inside);
}

void MatrixFlow::place_wells() {
  const auto is_like = [&](int cell, int other) {
    if (by_state_) return mesh_.cell_region[cell] == mesh_.cell_region[other];
    return is_sealed_ || conduct_alike(mobility_[cell], mobility_[other]);
  };
  for (const auto& [name, well] : options_.wells) {
    std::string why = "there is no cell at its position";
    auto& cells = well_cells_[name];
    try {
      cells = well.at ? linear_fit(mesh_, *well.at, is_like) : line_source(mesh_, well.points, is_like);
    } catch (const std::invalid_argument& outside) {
      why = outside.what();
    }
    if (cells.empty())
      throw InputError(well.origin, "well '" + name + "' lies outside the rock", why, "move it inside");
  }
}

void MatrixFlow::use_storage() {
  if (capacity_version_ == storage_.version()) return;
  capacity_version_ = storage_.version();
  SPREKK_ASSERT(storage_.values().size() == mesh_.cell_count(), storage_.values().size(), mesh_.cell_count());
  SPREKK_ASSERT(storage_.values().size() == 0 || storage_.values().minCoeff() >= 0, storage_.values().minCoeff());
  capacity_ = storage_.values().cwiseProduct(Eigen::Map<const Vector>(mesh_.cell_measure.data(), mesh_.cell_count()));
  // In cells without flow any positive storage keeps the pressure.
  const double largest = capacity_.maxCoeff();
  for (int c = 0; c < mesh_.cell_count(); ++c)
    if (!is_in_cell(c)) capacity_[c] = largest > 0 ? largest : 1;
  if (!stores_by_state()) capacity_of_pressure_ = Operator(diagonal_matrix(capacity_));
}

double MatrixFlow::diffusivity(int cell) const {
  const double best = principal_axes(mobility_[cell]).values.maxCoeff();
  return best / storage_[cell];
}

}  // namespace sprekk::matrix_flow
