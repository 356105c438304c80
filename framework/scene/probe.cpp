#include "framework/scene/probe.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <map>

#include "framework/discretization/linear_fit.hpp"
#include "framework/field/weights_in_cell.hpp"
#include "framework/mesh/medium.hpp"
#include "framework/mesh/point_location.hpp"

namespace sprekk {

Spec ProbeOptions::spec() {
  Spec spec("probe", "A figure of a field: at a point, on a fracture, over a region, or over everything.");
  spec.text("of", of, {.doc = "The field, for example pore.pressure.", .required = true});
  spec.point("at", at, {.unit = "m", .doc = "A point."});
  spec.text("fracture", fracture, {.doc = "A fracture, for fields on fractures."});
  spec.text("region", region, {.doc = "A region, for fields of the matrix."});
  spec.choice("take", take,
              {{"value", "the value at the point"},
               {"mean", "the mean over the fracture or region"},
               {"integral", "the integral over it"},
               {"smallest", "the smallest value on it"},
               {"largest", "the largest value on it"}},
              {.doc = "Which figure."});
  spec.check([this](const Node& node) {
    if ((take == "value") != at.has_value())
      throw InputError(node.origin, "the probe '" + node.path + "' is not complete",
                       "a value is taken at a point, and everything else over a fracture or region",
                       at ? "remove 'take' or 'at'" : "give 'at', or 'take: mean'");
  });
  return spec;
}

namespace {

std::vector<std::string> field_names(const FieldStore& fields) {
  std::vector<std::string> names;
  for (const auto& field : fields.all()) names.push_back(field->name());
  return names;
}

}  // namespace

Probe::Probe(const std::string& name, const ProbeOptions& options, const Mesh& mesh, const FieldStore& fields)
    : name_(name), take_(options.take) {
  if (!fields.has(options.of)) throw unknown_name(options.origin, "field", options.of, field_names(fields));
  field_ = &fields.at(options.of);
  const Location location = field_->spec().location;
  if (!is_in_cells(location) && location != Location::fracture_cell)
    throw InputError(options.origin, "the field " + options.of + " cannot be probed",
                     "it has no values in cells or along fractures", "choose another field");
  check_names(mesh, options);
  if (options.at)
    set_point_weights(mesh, options);
  else
    set_domain_weights(mesh, options);
}

void Probe::check_names(const Mesh& mesh, const ProbeOptions& options) const {
  const bool on_fracture = field_->spec().location == Location::fracture_cell;
  std::vector<std::string> fractures;
  for (const Fracture& fracture : mesh.fractures) fractures.push_back(fracture.name);
  const auto check = [&](const char* what, const std::string& name, bool fits, const std::vector<std::string>& known) {
    if (name.empty()) return;
    if (!fits)
      throw InputError(options.origin, "probe '" + name_ + "' names a " + what,
                       options.of + " lives " + (on_fracture ? "on fractures" : "in the " + medium_name()),
                       "remove it");
    if (std::find(known.begin(), known.end(), name) == known.end())
      throw unknown_name(options.origin, what, name, known);
  };
  check("fracture", options.fracture, on_fracture, fractures);
  check("region", options.region, !on_fracture, mesh.region_names);
}

void Probe::set_point_weights(const Mesh& mesh, const ProbeOptions& options) {
  if (field_->spec().location == Location::fracture_cell) {
    int best = none;
    for (int i = 0; i < mesh.fracture_cell_count(); ++i) {
      if (!options.fracture.empty() && mesh.fractures[mesh.fracture_cells[i].fracture].name != options.fracture)
        continue;
      const auto distance = [&](int cell) { return (mesh.fracture_cells[cell].center - *options.at).norm(); };
      if (best == none || distance(i) < distance(best)) best = i;
    }
    if (best == none)
      throw InputError(options.origin, "probe '" + name_ + "' finds no fracture", "there is none of this name");
    const double away = (mesh.fracture_cells[best].center - *options.at).norm();
    if (away > mesh.fracture_cells[best].measure)
      throw InputError(options.origin, "probe '" + name_ + "' lies away from the fractures",
                       "the nearest fracture cell is " + fmt::format("{:.3g} m", away) + " away and only " +
                           fmt::format("{:.3g} m", mesh.fracture_cells[best].measure) + " long",
                       "choose a point on a fracture");
    weights_ = {{best, 1.0}};
    return;
  }
  const Location location = field_->spec().location;
  const int home = location == Location::cell ? none : PointLocation(mesh).cell_at(*options.at);
  if (home != none)
    weights_ = weights_in_cell(mesh, location, home, *options.at);
  else if (location == Location::cell)
    weights_ = linear_fit(mesh, *options.at);
  if (weights_.empty())
    throw InputError(options.origin, "probe '" + name_ + "' lies outside the " + medium_name(),
                     "there is no cell at its position", "move it inside");
}

void Probe::set_domain_weights(const Mesh& mesh, const ProbeOptions& options) {
  if (field_->spec().location == Location::fracture_cell) {
    for (int i = 0; i < mesh.fracture_cell_count(); ++i)
      if (options.fracture.empty() || mesh.fractures[mesh.fracture_cells[i].fracture].name == options.fracture)
        weights_.emplace_back(i, mesh.fracture_cells[i].measure);
  } else {
    std::map<int, double> shares;  // of the entities in the measures of cells
    for (int c = 0; c < mesh.cell_count(); ++c)
      if (options.region.empty() || mesh.region_names[mesh.cell_region[c]] == options.region)
        for (const auto& [entity, weight] : weights_in_cell(mesh, field_->spec().location, c, mesh.cell_center[c]))
          shares[entity] += weight * mesh.cell_measure[c];
    weights_.assign(shares.begin(), shares.end());
  }
  if (weights_.empty())
    throw InputError(options.origin, "probe '" + name_ + "' covers nothing",
                     "there is no fracture or region '" + options.fracture + options.region + "'");
  if (take_ != "mean") return;
  double total = 0;
  for (const auto& [entity, weight] : weights_) total += weight;
  for (auto& [entity, weight] : weights_) weight /= total;
}

void Probe::measure(std::vector<Quantity>& quantities) const {
  const int components = field_->spec().components;
  const bool on_fracture = field_->spec().location == Location::fracture_cell;
  static const char* const matrix_axes[] = {".x", ".y"};
  static const char* const fracture_axes[] = {".n", ".t"};
  for (int k = 0; k < components; ++k) {
    const auto value = [&](int entity) { return field_->now()[entity * components + k]; };
    double result = 0;
    if (take_ == "smallest" || take_ == "largest") {
      const double sign = take_ == "largest" ? 1 : -1;
      result = value(weights_.front().first);
      for (const auto& [entity, weight] : weights_)
        if (sign * value(entity) > sign * result) result = value(entity);
    } else {
      for (const auto& [entity, weight] : weights_) result += weight * value(entity);
    }
    std::string unit = field_->spec().unit;
    if (take_ == "integral") unit += on_fracture ? "*m" : "*m^2";
    const std::string axis = components == 1   ? ""
                             : components != 2 ? "." + std::to_string(k)
                                               : (on_fracture ? fracture_axes[k] : matrix_axes[k]);
    quantities.push_back({name_ + axis, unit, result});
  }
}

}  // namespace sprekk
