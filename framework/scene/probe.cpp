#include "framework/scene/probe.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <map>

#include "framework/discretization/along_fracture.hpp"
#include "framework/discretization/quadratic_fit.hpp"
#include "framework/field/component_names.hpp"
#include "framework/field/weights_in_cell.hpp"
#include "framework/invariants.hpp"
#include "framework/mesh/medium.hpp"
#include "framework/mesh/search/distances.hpp"
#include "framework/mesh/search/point_location.hpp"

namespace sprekk {

Spec ProbeOptions::spec() {
  Spec spec("probe", "A figure of a field: at a point, on a fracture, over a region, or over everything.");
  spec.text("of", of,
            {.doc = "The field, for example pore.pressure."
                    " What parts write into files beside their fields can be probed, too.",
             .required = true});
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

std::vector<std::string> names_of(const FieldStore& fields, const std::vector<OutputField>& outputs) {
  std::vector<std::string> names;
  for (const auto& field : fields.all()) names.push_back(field->name());
  for (const OutputField& output : outputs) names.push_back(output.name);
  return names;
}

const OutputField* find(const std::vector<OutputField>& outputs, const std::string& name) {
  const auto found = std::ranges::find(outputs, name, &OutputField::name);
  return found == outputs.end() ? nullptr : &*found;
}

}  // namespace

Probe::Probe(const std::string& name, const ProbeOptions& options, const Mesh& mesh, const FieldStore& fields,
             const std::vector<OutputField>& outputs, const std::vector<char>& has_values)
    : name_(name), take_(options.take), of_(options.of) {
  if (fields.has(of_)) {
    field_ = &fields.at(of_);
    location_ = field_->spec().location;
    components_ = field_->spec().components;
    unit_ = field_->spec().unit;
  } else if (const OutputField* output = find(outputs, of_)) {
    location_ = output->location;
    components_ = output->components;
    unit_ = output->unit;
    is_a_choice_ = output->is_a_choice;
  } else {
    throw unknown_name(options.origin, "field", of_, names_of(fields, outputs));
  }
  if (!is_in_cells(location_) && location_ != Location::fracture_cell)
    throw InputError(options.origin, "the field " + options.of + " cannot be probed",
                     "it has no values in cells or along fractures", "choose another field");
  check_names(mesh, options);
  if (options.at)
    set_point_weights(mesh, options);
  else
    set_domain_weights(mesh, options, has_values);
}

void Probe::check_names(const Mesh& mesh, const ProbeOptions& options) const {
  const bool on_fracture = location_ == Location::fracture_cell;
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
  if (location_ == Location::fracture_cell) {
    const int best = nearest_fracture_cell(mesh, *options.at, [&](int cell) {
      return options.fracture.empty() || mesh.fractures[mesh.fracture_cells[cell].fracture].name == options.fracture;
    });
    if (best == none)
      throw InputError(options.origin, "probe '" + name_ + "' finds no fracture", "there is none of this name");
    const double away = distance_to_fracture_cell(mesh, best, *options.at);
    if (away > mesh.fracture_cells[best].size())
      throw InputError(options.origin, "probe '" + name_ + "' lies away from the fractures",
                       fmt::format("the nearest one is {:.3g} m away", away), "choose a point on a fracture");
    if (is_a_choice_)
      weights_ = {{best, 1.0}};
    else
      weights_ = along_fracture(mesh, best, *options.at);
    return;
  }
  const int home = PointLocation(mesh).cell_at(*options.at);
  if (home != none)
    weights_ = location_ == Location::cell ? quadratic_fit(mesh, home, *options.at)
                                           : weights_in_cell(mesh, location_, home, *options.at);
  if (weights_.empty())
    throw InputError(options.origin, "probe '" + name_ + "' lies outside the " + medium_name(),
                     "there is no cell at its position", "move it inside");
}

void Probe::set_domain_weights(const Mesh& mesh, const ProbeOptions& options, const std::vector<char>& has_values) {
  const auto counts = [&](int cell) { return has_values.empty() || has_values[cell]; };
  if (location_ == Location::fracture_cell) {
    for (int i = 0; i < mesh.fracture_cell_count(); ++i)
      if (counts(i) &&
          (options.fracture.empty() || mesh.fractures[mesh.fracture_cells[i].fracture].name == options.fracture))
        weights_.emplace_back(i, mesh.fracture_cells[i].measure);
  } else {
    std::map<int, double> shares;  // of the entities in the measures of cells
    for (int c = 0; c < mesh.cell_count(); ++c)
      if (counts(c) && (options.region.empty() || mesh.region_names[mesh.cell_region[c]] == options.region))
        for (const auto& [entity, weight] : weights_in_cell(mesh, location_, c, mesh.cell_center[c]))
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

void Probe::measure(std::vector<Quantity>& quantities, const std::vector<OutputField>& outputs) const {
  const OutputField* const output = field_ ? nullptr : find(outputs, of_);
  SPREKK_EXPECT(field_ || output, of_);
  const Vector& values = field_ ? field_->now() : output->values;
  const bool on_fracture = location_ == Location::fracture_cell;
  const std::vector<std::string> names =
      on_fracture ? component_names_on_fractures(components_) : component_names(components_);
  for (int k = 0; k < components_; ++k) {
    const auto value = [&](int entity) { return values[entity * components_ + k]; };
    double result = 0;
    if (take_ == "smallest" || take_ == "largest") {
      const double sign = take_ == "largest" ? 1 : -1;
      result = value(weights_.front().first);
      for (const auto& [entity, weight] : weights_)
        if (sign * value(entity) > sign * result) result = value(entity);
    } else {
      double smallest = value(weights_.front().first), largest = smallest;
      for (const auto& [entity, weight] : weights_) {
        result += weight * value(entity);
        smallest = std::min(smallest, value(entity));
        largest = std::max(largest, value(entity));
      }
      // Next to closed or sticking cells the polynomial would swing to the other side of zero.
      if (on_fracture && smallest >= 0) result = std::max(result, 0.0);
      if (on_fracture && largest <= 0) result = std::min(result, 0.0);
    }
    std::string unit = unit_;
    if (take_ == "integral") {
      const int power = on_fracture ? dimension - 1 : dimension;
      unit += power == 1 ? "*m" : "*m^" + std::to_string(power);
    }
    quantities.push_back({components_ == 1 ? name_ : name_ + "." + names[k], unit, result});
  }
}

}  // namespace sprekk
