// list, explain and schema: all types, their parameters, and both as a JSON schema for editors. All three follow from
// the declared specs.
#pragma once

#include <iosfwd>
#include <string>
#include <vector>

namespace sprekk {

void print_list(std::ostream& out);  ///< the names of all types and sections, by kind
/// Prints all parameters of types, steps of the schedule and sections of a scene; of other names the parameters, laws
/// and accelerators that are called so. Throws InputError for a name that is none of them.
void print_explanations(const std::vector<std::string>& names, std::ostream& out);
void print_schema(std::ostream& out);        ///< of scenes
void print_study_schema(std::ostream& out);  ///< of the files of studies
/// Writes one Markdown page a type into a folder.
void write_reference(const std::string& folder);

}  // namespace sprekk
