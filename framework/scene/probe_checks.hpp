// Refuses probes that cannot be measured, or have no column of their own.
#pragma once

#include <memory>
#include <vector>

#include "framework/scene/component.hpp"
#include "framework/scene/probe.hpp"
#include "framework/scene/scene.hpp"

namespace sprekk {

/// The cells, or fracture cells, in which a probe that names no place measures: where its component has values, one
/// flag each; empty for all.
const std::vector<char>& cells_with_values(const ProbeOptions& probe,
                                           const std::vector<std::unique_ptr<Component>>& components);
/// Refuses a probe at a place where the component that it measures has no value, because the component has values in a
/// part of the mesh only (LivesInPart). A probe that names no place measures where there are values. Throws InputError.
void require_values_at_probes(const OutputOptions& options, const std::vector<std::unique_ptr<Component>>& components,
                              const Mesh& mesh);
/// Refuses a probe with the name of another column of history.csv: readers find columns by their names. `probes`: in
/// the order of `options`; `others`: the other columns. Throws InputError.
void require_own_columns(const OutputOptions& options, const std::vector<Probe>& probes,
                         const std::vector<OutputField>& outputs, const std::vector<Quantity>& others);

}  // namespace sprekk
