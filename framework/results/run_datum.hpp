// Data from the fields of another run: one-way coupling.
#pragma once

#include "framework/config/data_reader.hpp"

namespace sprekk {

/// {run: FOLDER, of: FIELD} is the field of another run at the same time, and {…, at: TIME} at a time of its own, or at
/// its end with `at: end`. Throws InputError where the folder has no such field, or the field another dimension.
Data read_run_datum(const Node& node, const DataRequest& request);

}  // namespace sprekk
