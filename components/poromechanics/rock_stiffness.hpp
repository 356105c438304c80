// The stiffness of the rock in every cell.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "components/capabilities/rock_state.hpp"
#include "components/poromechanics/excavation.hpp"
#include "components/poromechanics/options.hpp"
#include "components/poromechanics/stiffness.hpp"
#include "framework/assembly/property.hpp"
#include "framework/config/input_error.hpp"

namespace sprekk::poromechanics {

/// The stiffness from the properties in `options`: at the start of the scene, and then at the end of each step that it
/// is evaluated for.
class RockStiffness {
 public:
  /// `options` outlive it. `component`, `origin`: for messages. Throws DataError where a stiffness is not positive
  /// definite.
  RockStiffness(const Options& options, const Mesh& mesh, double start_time, std::string component, Origin origin);

  /// Does nothing when no property depends on time. Throws DataError.
  void evaluate(const StepTime& step);

  /// Where Young's modulus is a formula of the state: sets its values in the initial state, Pa, one a cell. All
  /// stiffnesses here are those of the initial state. Before this call they mean nothing.
  void set_initial_young_modulus(Vector values);

  const std::vector<Stiffness>& of_cells() const { return stiffness_; }
  std::optional<LameParameters> lame(int cell) const;             ///< none for anisotropic rock
  const Property& bulk_modulus() const { return bulk_modulus_; }  ///< Pa
  double unequal_expansion() const;                               ///< as in PoroelasticRock
  const Excavation& excavation() const { return excavation_; }
  bool changes() const { return changes_; }           ///< whether a property depends on time
  std::uint64_t version() const { return version_; }  ///< grows whenever a stiffness has changed
  std::vector<const Data*> data() const;              ///< the properties

 private:
  void compute();
  Stiffness at(int cell) const;

  const Options& options_;
  std::string component_;
  Origin origin_;
  Excavation excavation_;
  std::vector<Property> moduli_;  ///< Young's modulus and Poisson's ratio, or the entries of AnisotropicStiffness
  Property bulk_modulus_;
  bool changes_ = false;
  std::vector<Stiffness> stiffness_;
  std::uint64_t version_ = 0;
};

}  // namespace sprekk::poromechanics
