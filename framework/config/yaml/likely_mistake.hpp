// The commonest mistakes in YAML, which the parser does not name.
#pragma once

#include <optional>
#include <string>

#include "framework/config/input_error.hpp"

namespace sprekk {

/// The mistake of a text that the parser has refused: a tab or a wrong depth of indentation,
/// a quotation mark or a bracket that is never closed, with its own place. Nothing where none of these is there.
std::optional<InputError> likely_mistake(const std::string& text, const std::string& source);

/// What is wrong in the line at which the parser has stopped, or in the one above: no key, another sign than ':', or
/// deeper than a line that has its value. Nothing where none of these is there.
std::optional<InputError> mistake_above(const std::string& text, int line, const std::string& source);

/// A quotation mark that is never closed, which the parser takes for closed where the text ends.
std::optional<InputError> unclosed_quote(const std::string& text, const std::string& source);

}  // namespace sprekk
