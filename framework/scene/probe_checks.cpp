#include "framework/scene/probe_checks.hpp"

#include <cstddef>
#include <set>

#include "framework/assembly/lives_in_part.hpp"
#include "framework/mesh/search/point_location.hpp"

namespace sprekk {

namespace {

bool names_no_place(const ProbeOptions& probe) { return !probe.at && probe.fracture.empty() && probe.region.empty(); }

}  // namespace

const std::vector<char>& cells_with_values(const ProbeOptions& probe,
                                           const std::vector<std::unique_ptr<Component>>& components) {
  static const std::vector<char> all;
  if (!names_no_place(probe)) return all;
  for (const auto& component : components)
    if (const auto* partial = dynamic_cast<const LivesInPart*>(component.get());
        partial && probe.of.starts_with(component->name() + "."))
      return partial->inhabited_cells();
  return all;
}

void require_values_at_probes(const OutputOptions& options, const std::vector<std::unique_ptr<Component>>& components,
                              const Mesh& mesh) {
  for (const auto& [name, probe] : options.probes)
    for (const auto& component : components) {
      if (names_no_place(probe)) continue;  // wherever there are values
      const auto* partial = dynamic_cast<const LivesInPart*>(component.get());
      if (!partial || partial->inhabited_cells().empty() || !probe.of.starts_with(component->name() + ".")) continue;
      if (partial->lives_on_fractures()) {
        const auto fracture_of = [&](int cell) { return mesh.fractures[mesh.fracture_cells[cell].fracture].name; };
        const auto counts = [&](int cell) { return probe.fracture.empty() || fracture_of(cell) == probe.fracture; };
        for (int i = 0; !probe.at && i < mesh.fracture_cell_count(); ++i)
          if (counts(i) && !partial->inhabited_cells()[i])
            throw InputError(probe.origin, "probe '" + name + "' reaches where there is no value",
                             "'" + component->name() + "' does not live on fracture '" + fracture_of(i) + "'",
                             "take a fracture on which it does");
        const int nearest = probe.at ? nearest_fracture_cell(mesh, *probe.at, counts) : none;
        if (nearest != none && !partial->inhabited_cells()[nearest])
          throw InputError(probe.origin, "probe '" + name + "' reaches where there is no value",
                           "'" + component->name() + "' does not live on the fracture there",
                           "take a point on a fracture on which it does");
        continue;
      }
      const int home = probe.at ? PointLocation(mesh).cell_at(*probe.at) : none;
      for (int c = 0; c < mesh.cell_count(); ++c) {
        const bool counts = probe.at
                                ? c == home
                                : probe.fracture.empty() &&
                                      (probe.region.empty() || mesh.region_names[mesh.cell_region[c]] == probe.region);
        if (counts && !partial->inhabited_cells()[c])
          throw InputError(
              probe.origin, "probe '" + name + "' reaches where there is no value",
              "'" + component->name() + "' does not live in the region " + mesh.region_names[mesh.cell_region[c]],
              "take a region, or a point, in which it does");
      }
    }
}

void require_own_columns(const OutputOptions& options, const std::vector<Probe>& probes,
                         const std::vector<OutputField>& outputs, const std::vector<Quantity>& others) {
  std::set<std::string> taken = {"time", "step", "iterations", "splitting_error", "coupled_residual"};
  for (const Quantity& quantity : others)
    if (!taken.insert(quantity.name).second)
      throw InputError("two columns of history.csv have the name " + quantity.name +
                       " (a component, or a place in it, gives it its name) rename one of them");
  std::size_t i = 0;
  for (const auto& [name, probe] : options.probes) {
    std::vector<Quantity> columns;
    probes[i++].measure(columns, outputs);
    for (const Quantity& column : columns)
      if (!taken.insert(column.name).second)
        throw InputError(probe.origin, "the probe '" + name + "' has no column of its own",
                         "history.csv has a column " + column.name + " already", "give it another name");
  }
}

}  // namespace sprekk
