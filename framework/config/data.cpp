#include "framework/config/data.hpp"

#include <algorithm>

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

}  // namespace sprekk
