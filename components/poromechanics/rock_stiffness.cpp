#include "components/poromechanics/rock_stiffness.hpp"

#include <fmt/format.h>

#include <Eigen/LU>
#include <algorithm>
#include <limits>
#include <utility>

#include "components/capabilities/state_of_cells.hpp"
#include "framework/dense/symmetric_eigen.hpp"
#include "framework/invariants.hpp"

namespace sprekk::poromechanics {

RockStiffness::RockStiffness(const Options& options, const Mesh& mesh, double start_time, std::string component,
                             Origin origin)
    : options_(options),
      component_(std::move(component)),
      origin_(std::move(origin)),
      excavation_(options.excavation, mesh),
      changes_(!excavation_.is_empty()),
      stiffness_(mesh.cell_count()) {
  const std::vector<Place> places = cell_places(mesh);
  for (const Data* data : data()) {
    if (StateFormula(*data, rock_variables(), places).is_formula()) {
      moduli_.emplace_back();
      moduli_.back().set(Vector::Ones(mesh.cell_count()));
    } else {
      moduli_.emplace_back(*data, places, start_time);
    }
    changes_ = changes_ || data->depends_on_time();
  }
  if (options_.is_anisotropic) {
    bulk_modulus_ = Property(options_.bulk_modulus.value_or(0), places, start_time);
    moduli_.resize(AnisotropicStiffness::entries);
  }
  compute();
}

void RockStiffness::evaluate(const StepTime& step) {
  if (!changes_) return;
  for (Property& modulus : moduli_) modulus.evaluate(step);
  excavation_.evaluate(step);
  bulk_modulus_.evaluate(step);
  compute();
}

void RockStiffness::set_initial_young_modulus(Vector values) {
  SPREKK_EXPECT(!options_.is_anisotropic, component_);
  moduli_[0].set(std::move(values));
  compute();
}

void RockStiffness::compute() {
  std::uint64_t version = excavation_.version();
  for (const Property& modulus : moduli_) version += modulus.version();
  if (version == version_) return;
  const int cells = static_cast<int>(stiffness_.size());
  for (int c = 0; c < cells; ++c) stiffness_[c] = excavation_.stiffness(c) * at(c);
  version_ = version;  // at the end, since the loop above may throw
  if (options_.is_anisotropic) return;
  Vector bulk_modulus(cells);
  for (int c = 0; c < cells; ++c) bulk_modulus[c] = moduli_[0][c] / (3 * (1 - 2 * moduli_[1][c]));
  bulk_modulus_.set(std::move(bulk_modulus));
}

double RockStiffness::unequal_expansion() const {
  double most = 1;
  for (int c = 0; options_.is_anisotropic && c < static_cast<int>(stiffness_.size()); ++c) {
    const SymmetricTensor strain = at(c).inverse() * isotropic_components();
    Tensor tensor;
    for (int k = 0; k < symmetric_components; ++k) {
      const auto [i, j] = symmetric_axes[k];
      tensor(i, j) = tensor(j, i) = i == j ? strain[k] : 0.5 * strain[k];
    }
    const Eigen::VectorXd along_axes = symmetric_eigenvalues(tensor);
    const double least = along_axes[0], largest = along_axes[dimension - 1];
    most = std::max(most, least > 0 ? largest / least : std::numeric_limits<double>::infinity());
  }
  return most;
}

std::optional<LameParameters> RockStiffness::lame(int cell) const {
  SPREKK_EXPECT(is_index(cell, static_cast<int>(stiffness_.size())), cell, stiffness_.size());
  if (options_.is_anisotropic) return std::nullopt;
  return LameParameters{stiffness_[cell](0, 1), stiffness_[cell](dimension, dimension)};
}

Stiffness RockStiffness::at(int c) const {
  if (!options_.is_anisotropic) {
    const double young = moduli_[0][c], poisson = moduli_[1][c];
    return isotropic_stiffness(young * poisson / ((1 + poisson) * (1 - 2 * poisson)), young / (2 * (1 + poisson)));
  }
  Stiffness stiffness;
  for (int row = 0; row < symmetric_components; ++row)
    for (int column = row; column < symmetric_components; ++column)
      stiffness(row, column) = stiffness(column, row) = moduli_[AnisotropicStiffness::number_of(row, column)][c];
  const Eigen::VectorXd eigenvalues = symmetric_eigenvalues(stiffness);
  if (eigenvalues[0] <= 0)
    throw DataError(InputError(origin_, "the stiffness of component '" + component_ + "' is not positive definite",
                               "the rock would give way by itself; its smallest eigenvalue is " +
                                   fmt::format("{:.3g} Pa", eigenvalues[0]),
                               "raise its diagonal entries, or lower the others")
                        .what());
  return stiffness;
}

std::vector<const Data*> RockStiffness::data() const {
  if (!options_.is_anisotropic) return {&*options_.young_modulus, &*options_.poisson_ratio};
  std::vector<const Data*> data;
  for (const Data& entry : options_.stiffness.entry) data.push_back(&entry);
  if (options_.bulk_modulus) data.push_back(&*options_.bulk_modulus);
  return data;
}

}  // namespace sprekk::poromechanics
