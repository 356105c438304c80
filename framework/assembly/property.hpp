// Values of a datum that others compute from, with a version that says whether they are still the same.
#pragma once

#include <cstdint>
#include <vector>

#include "framework/assembly/step_time.hpp"
#include "framework/mesh/mesh.hpp"
#include "framework/types.hpp"

namespace sprekk {

/// The values of a datum at fixed places, as a step takes them (value_in_step). The version grows when a value has
/// changed, and only then: code that keeps results of the values (operators, factorizations) compares versions. A datum
/// that does not depend on time is evaluated once.
class Property {
 public:
  /// A property without values, to be filled by `set`.
  Property() = default;
  /// Evaluates the datum at `start` (s), or right after it where the datum jumps there. Throws DataError.
  Property(const Data& data, const std::vector<Place>& places, double start);

  /// Evaluates the datum for this step. Throws DataError, and then the earlier values stay.
  void evaluate(const StepTime& step);
  /// Sets values that the caller has computed.
  void set(Vector values);

  const Vector& values() const { return values_; }
  double operator[](int i) const { return values_[i]; }
  std::uint64_t version() const { return version_; }  ///< 0 as long as there are no values
  bool depends_on_time() const { return data_.depends_on_time(); }

 private:
  Data data_;
  std::vector<Place> places_;  ///< kept of data that depend on time
  Vector values_;
  std::uint64_t version_ = 0;
};

/// Where properties are evaluated: the centre of each cell of the rock, or of each cell of the fractures, whose region
/// is that of the rock on the plus side.
std::vector<Place> cell_places(const Mesh& mesh);
std::vector<Place> fracture_cell_places(const Mesh& mesh);
Place fracture_cell_place(const Mesh& mesh, int cell);

}  // namespace sprekk
