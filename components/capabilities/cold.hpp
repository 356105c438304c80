// Temperatures that no rock and no fluid in it has.
#pragma once

#include <string>
#include <vector>

#include "framework/assembly/notes.hpp"
#include "framework/config/data.hpp"
#include "framework/types.hpp"

namespace sprekk {

/// Notes temperatures near absolute zero: degrees Celsius, or a temperature at the start that was left out. `at_start`:
/// K, of the cells; `given`: of sides, or of fluid that enters (those that change with place or time are not looked
/// at). No note where cells start with 0 K and all that is given is as cold: such temperatures are differences.
/// `name`: of the part to which they belong.
void note_cold(Notes& notes, const std::string& name, const Vector& at_start, const std::vector<const Data*>& given);

}  // namespace sprekk
