// Text within the quotes of an XML attribute.
#pragma once

#include <string>

namespace sprekk {

/// `text` with & < > " written as entities.
std::string xml_escaped(const std::string& text);
/// The inverse.
std::string xml_unescaped(std::string text);

}  // namespace sprekk
