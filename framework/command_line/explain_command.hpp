// list, explain and schema: all types, their parameters, and both as a JSON schema for editors. All three follow from
// the declared specs.
#pragma once

#include <iosfwd>
#include <string>

namespace sprekk {

void print_list(std::ostream& out);  ///< the names of all types and sections, by kind
/// Prints all parameters of a type. Throws InputError for a name that is neither a type, nor a step of the schedule,
/// nor a section of a scene.
void print_explanation(const std::string& name, std::ostream& out);
void print_schema(std::ostream& out);        ///< of scenes
void print_study_schema(std::ostream& out);  ///< of the files of studies
/// Writes one Markdown page a type into a folder.
void write_reference(const std::string& folder);

}  // namespace sprekk
