#include "framework/config/data.hpp"

#include <algorithm>
#include <utility>

namespace sprekk {
namespace {

void sort_unique(std::vector<double>& values) {
  std::sort(values.begin(), values.end());
  values.erase(std::unique(values.begin(), values.end()), values.end());
}

}  // namespace

Data::Data(double constant) : constant_(constant) {}

Data::Data(Function function, bool depends_on_time, bool depends_on_space, std::vector<double> switch_times)
    : function_(std::move(function)),
      depends_on_time_(depends_on_time),
      depends_on_space_(depends_on_space),
      switch_times_(std::move(switch_times)) {
  sort_unique(switch_times_);
}

std::vector<double> merged_switch_times(const std::vector<const Data*>& data) {
  std::vector<double> times;
  for (const Data* datum : data) {
    times.insert(times.end(), datum->switch_times().begin(), datum->switch_times().end());
  }
  sort_unique(times);
  return times;
}

Point VectorData::at(const Place& place) const {
  Point value;
  for (int k = 0; k < dimension; ++k) value[k] = component[k].at(place);
  return value;
}

bool VectorData::is_zero() const { return std::ranges::all_of(component, &Data::is_zero); }

bool VectorData::depends_on_time() const { return std::ranges::any_of(component, &Data::depends_on_time); }

bool VectorData::depends_on_space() const { return std::ranges::any_of(component, &Data::depends_on_space); }

std::vector<double> VectorData::switch_times() const {
  std::vector<const Data*> data;
  for (const Data& each : component) data.push_back(&each);
  return merged_switch_times(data);
}

Tensor symmetric_tensor(const std::array<double, symmetric_components>& components) {
  Tensor tensor;
  for (int k = 0; k < symmetric_components; ++k) {
    const auto& [i, j] = symmetric_axes[k];
    tensor(i, j) = tensor(j, i) = components[k];
  }
  return tensor;
}

TensorData::TensorData(Data isotropic) { std::fill_n(component.begin(), dimension, std::move(isotropic)); }

Tensor TensorData::at(const Place& place) const {
  std::array<double, symmetric_components> values;
  for (int k = 0; k < symmetric_components; ++k) values[k] = component[k].at(place);
  return symmetric_tensor(values);
}

bool TensorData::is_zero() const { return std::ranges::all_of(component, &Data::is_zero); }

bool TensorData::is_constant() const { return std::ranges::all_of(component, &Data::is_constant); }

bool TensorData::is_diagonal() const {
  return std::all_of(component.begin() + dimension, component.end(), [](const Data& each) { return each.is_zero(); });
}

bool TensorData::depends_on_time() const { return std::ranges::any_of(component, &Data::depends_on_time); }

std::vector<double> TensorData::switch_times() const {
  std::vector<const Data*> data;
  for (const Data& each : component) data.push_back(&each);
  return merged_switch_times(data);
}

}  // namespace sprekk
