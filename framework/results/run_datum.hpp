// Data from the fields of another run: one-way coupling.
#pragma once

#include "framework/config/data_reader.hpp"

namespace sprekk {

/// {run: FOLDER, of: FIELD} is the field of another run at the same time, and {…, at: TIME} at a time of its own, or at
/// its end with `at: end`. Throws InputError where the folder has no such field, or where the field has a physical
/// dimension other than the datum.
Data read_run_datum(const Node& node, const DataRequest& request);

}  // namespace sprekk
