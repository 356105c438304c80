#include "framework/results/field_of_run.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "framework/results/results_dimension.hpp"
#include "framework/types.hpp"

namespace sprekk {
namespace {

namespace fs = std::filesystem;

/// A fracture of another mesh may be off a place on it by this, over the length of its own cell there: meshes of one
/// fracture differ by far less.
constexpr double beside = 0.5;

std::string without_unit(const std::string& label) { return label.substr(0, label.find('[')); }

std::string unit_of(const std::string& label) {
  const std::size_t begin = label.find('[');
  if (begin == std::string::npos) return "";
  const std::string unit = label.substr(begin + 1, label.size() - begin - 2);
  return unit == "1" ? "" : unit;
}

/// The names by which the components of an array are asked for: "quantity", or "quantity.component".
std::vector<std::string> names_of(const Grid::Values& array) {
  const std::string name = without_unit(array.name);
  std::vector<std::string> names;
  for (const std::string& component : array.component_names) names.push_back(name + "." + component);
  if (names.size() != static_cast<std::size_t>(array.components)) names = {name};
  return names;
}

}  // namespace

/// The field at one written time.
struct FieldOfRun::Frame {
  std::size_t snapshot;
  Grid grid, walls;
  std::unique_ptr<CellSampler> cells;
  std::unique_ptr<SampledArray> array;
};

FieldOfRun::FieldOfRun(fs::path folder, const std::string& field, const Origin& where) : folder_(std::move(folder)) {
  const std::string shown = quoted(folder_.string());
  if (!fs::is_directory(folder_))
    throw InputError(where, "the run " + shown + " cannot be used",
                     fs::exists(folder_) ? "it is no folder" : "there is no such folder",
                     "give the folder of results that 'sprekk run' has named");
  if (dimension_of_results(folder_) == 3 || dimension == 3)
    throw InputError(where, "the run " + shown + " cannot be used",
                     "fields of other runs are taken in scenes in a plane, from runs in a plane, so far",
                     "write its field into a table, or give an expression");
  std::vector<std::string> known;
  for (const bool on_fractures : {false, true}) {
    const fs::path index = folder_ / (on_fractures ? "fractures.pvd" : "matrix.pvd");
    const std::vector<Snapshot> snapshots = read_index(index);
    if (snapshots.empty()) continue;
    if (!fs::is_regular_file(snapshots.front().file))
      throw InputError(where, "the run " + shown + " cannot be used",
                       quoted(snapshots.front().file.filename().string()) + " is missing, which its index names");
    const Grid first = read_grid(snapshots.front().file);
    for (const Grid::Values& array : first.arrays) {
      if (!array.name.ends_with(']')) continue;  // numbers of regions and fractures
      const std::vector<std::string> names = names_of(array);
      known.insert(known.end(), names.begin(), names.end());
      const auto found = std::ranges::find(names, field);
      if (found == names.end()) continue;
      component_ = static_cast<int>(found - names.begin());
      array_ = array.name;
      unit_ = unit_of(array.name);
      is_on_fractures_ = on_fractures;
      snapshots_ = snapshots;
      return;
    }
  }
  if (known.empty())
    throw InputError(where, "the run " + shown + " cannot be used", "it has written no fields",
                     "run it with 'output: {fields: true}', and with 'every' or 'times' for fields that change");
  throw unknown_name(where, "field of the run " + shown + ":", field, known);
}

FieldOfRun::~FieldOfRun() = default;

const FieldOfRun::Frame& FieldOfRun::frame(std::size_t snapshot) const {
  for (const auto& known : frames_)
    if (known->snapshot == snapshot) return *known;
  auto read = std::make_unique<Frame>();
  read->snapshot = snapshot;
  const auto file_of = [&](const char* kind) {
    std::string name = snapshots_[snapshot].file.filename().string();
    return folder_ / (kind + name.substr(name.find('_')));
  };
  read->grid = read_grid(snapshots_[snapshot].file);
  if (!is_on_fractures_ && fs::is_regular_file(file_of("fractures"))) read->walls = read_grid(file_of("fractures"));
  const Grid::Values* const array = read->grid.find(array_);
  if (!array) throw std::runtime_error(fmt::format("{} has no {}", snapshots_[snapshot].file.string(), array_));
  read->cells = std::make_unique<CellSampler>(read->grid, read->walls);
  read->array = std::make_unique<SampledArray>(*read->cells, *array, component_);
  if (frames_.size() == 2) frames_.erase(frames_.begin());
  frames_.push_back(std::move(read));
  return *frames_.back();
}

double FieldOfRun::at(const Position& place, int fracture, double time) const {
  const auto later = std::lower_bound(snapshots_.begin(), snapshots_.end(), time,
                                      [](const Snapshot& snapshot, double t) { return snapshot.time < t; });
  const auto value_in = [&](std::size_t snapshot) {
    const Frame& at_time = frame(snapshot);
    const std::optional<int> part = at_time.cells->part_at(place, fracture);
    const auto refuse = [&](const std::string& what) {
      throw std::runtime_error(fmt::format("({}, {}) is {} of the run {}", place[0], place[1], what, folder_.string()));
    };
    if (!part)
      refuse(is_on_fractures_ ? fmt::format("on fracture {}, which is none", fracture + 1) : "outside of the mesh");
    const int cell = at_time.grid.sources[static_cast<std::size_t>(*part)];
    if (is_on_fractures_) {
      const Position centre = at_time.cells->centre(cell);
      const double size = at_time.cells->size(cell);
      if (std::hypot(centre[0] - place[0], centre[1] - place[1]) > (0.5 + beside) * size)
        refuse(fmt::format("not on fracture {}", fracture + 1));
    }
    return at_time.array->at(place, *part);
  };
  if (later == snapshots_.begin()) return value_in(0);
  if (later == snapshots_.end()) return value_in(snapshots_.size() - 1);
  const auto after = static_cast<std::size_t>(later - snapshots_.begin());
  if (later->time == time) return value_in(after);
  const double share = (time - snapshots_[after - 1].time) / (later->time - snapshots_[after - 1].time);
  return (1 - share) * value_in(after - 1) + share * value_in(after);
}

}  // namespace sprekk
