// page.css and page.js as texts; CMake makes the source from the files (SprekkEmbed.cmake).
#pragma once

namespace sprekk {

extern const char* const page_style;
extern const char* const page_script;

}  // namespace sprekk
