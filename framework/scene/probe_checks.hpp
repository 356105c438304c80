// What is asked of the probes of a scene.
#pragma once

#include <memory>
#include <vector>

#include "framework/scene/component.hpp"
#include "framework/scene/probe.hpp"
#include "framework/scene/scene.hpp"

namespace sprekk {

/// Refuses a probe of a component that has no value there (LivesInPart). Throws InputError.
void require_values(const OutputOptions& options, const std::vector<std::unique_ptr<Component>>& components,
                    const Mesh& mesh);
/// Refuses a probe that is called as another column of history.csv: readers find columns by their names. `probes`: in
/// the order of `options`; `others`: the other columns. Throws InputError.
void require_own_columns(const OutputOptions& options, const std::vector<Probe>& probes,
                         const std::vector<OutputField>& outputs, const std::vector<Quantity>& others);

}  // namespace sprekk
