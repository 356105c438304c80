// Properties, sources, boundary and initial values: anything that may vary in space and time.
#pragma once

#include <array>
#include <functional>
#include <stdexcept>
#include <string>
#include <vector>

#include "framework/types.hpp"

namespace sprekk {

/// Where (m) and when (s) a datum is evaluated. `region` indexes Mesh::region_names; `fracture` indexes
/// Mesh::fractures, and is -1 elsewhere.
struct Place {
  Point x = Point::Zero();
  int region = 0;
  double t = 0;
  int fracture = -1;
};

/// A mistake of the scene that is found when a datum is evaluated: it has no finite value, or leaves its range.
class DataError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// A scalar in SI units: a number, an expression (of place and time, and of the state where the parameter may be a
/// formula), a value per region or fracture, a table (CSV), or windows in time. `at` throws DataError when the function
/// has no finite value there or leaves the parameter's range.
class Data {
 public:
  Data(double constant = 0);  // NOLINT: a number is a datum
  using Function = std::function<double(const Place&)>;
  /// `switch_times` (s): the times at which the function jumps; kept sorted, each once.
  Data(Function function, bool depends_on_time, bool depends_on_space, std::vector<double> switch_times = {});

  double at(const Place& place) const { return function_ ? function_(place) : constant_; }
  bool is_constant() const { return !function_; }
  bool is_zero() const { return !function_ && constant_ == 0; }
  bool depends_on_time() const { return depends_on_time_; }
  bool depends_on_space() const { return depends_on_space_; }
  /// The ends of the time windows (s), sorted; time steps end there exactly. A window [from, to) has its value at
  /// `from` and zero at `to`: the value at a switch time is the value right after it. So a step that ends at a switch
  /// time should take the value from before that time (value_in_step). Jumps inside of an expression, if(t < 6*h, …),
  /// are not included.
  const std::vector<double>& switch_times() const { return switch_times_; }

 private:
  double constant_ = 0;
  Function function_;
  bool depends_on_time_ = false;
  bool depends_on_space_ = false;
  std::vector<double> switch_times_;
};

/// The symmetric tensor with these components, as symmetric_axes has them.
Tensor symmetric_tensor(const std::array<double, symmetric_components>& components);

/// The switch times (s) of several data, sorted, each once.
std::vector<double> merged_switch_times(const std::vector<const Data*>& data);

/// A vector of data, a component for each axis.
struct VectorData {
  std::array<Data, dimension> component;
  Point at(const Place& place) const;
  bool is_zero() const;
  bool depends_on_time() const;
  bool depends_on_space() const;
  std::vector<double> switch_times() const;
};

/// A symmetric tensor of data: written as a scalar (isotropic), by its components ({xx:, yy:, xy:} in a plane), or by
/// principal values and their direction: {along:, across:, angle:} in a plane; in space {along:, across:, strike:,
/// dip:}, of layers.
struct TensorData {
  std::array<Data, symmetric_components> component;  ///< as symmetric_axes has them

  TensorData() = default;
  TensorData(Data isotropic);                                    // NOLINT: a scalar is isotropic
  TensorData(double isotropic) : TensorData(Data(isotropic)) {}  // NOLINT: so is a number
  Tensor at(const Place& place) const;
  bool is_zero() const;
  bool is_constant() const;
  bool is_diagonal() const;  ///< whether all components off the diagonal are zero everywhere
  bool depends_on_time() const;
  std::vector<double> switch_times() const;
};

}  // namespace sprekk
