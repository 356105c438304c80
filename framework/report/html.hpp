// Pieces of HTML.
#pragma once

#include <string>
#include <utility>
#include <vector>

#include "framework/picture/line_plot.hpp"

namespace sprekk {

/// A section with its heading; "" where there is no content.
std::string html_section(const std::string& id, const std::string& title, const std::string& content);

/// A table whose first row is its head; cells are text. Columns from `numbers_from` on stand to the right.
std::string html_table(const std::vector<std::vector<std::string>>& rows, std::size_t numbers_from = 1,
                       bool has_head = true);

/// Pictures, as many beside each other as the page has room for.
std::string html_panels(const std::vector<Panel>& panels);

/// `text` as a paragraph; it is escaped.
std::string html_paragraph(const std::string& text);

/// Ids and titles of sections.
using SectionTitles = std::vector<std::pair<std::string, std::string>>;

/// A page that loads no other file, with links to those of `sections` that are in its body.
std::string html_page(const std::string& title, const SectionTitles& sections, const std::string& body);

}  // namespace sprekk
