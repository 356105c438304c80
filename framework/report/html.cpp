#include "framework/report/html.hpp"

#include "framework/output/build_info.hpp"
#include "framework/report/page_files.hpp"

namespace sprekk {

std::string html_section(const std::string& id, const std::string& title, const std::string& content) {
  if (content.empty()) return "";
  return "<section id=\"" + id + "\">\n<h2>" + escaped_markup(title) + "</h2>\n" + content + "</section>\n";
}

std::string html_table(const std::vector<std::vector<std::string>>& rows, std::size_t numbers_from, bool has_head) {
  std::string text = "<table>\n";
  for (std::size_t r = 0; r < rows.size(); ++r) {
    const std::string cell = r == 0 && has_head ? "th" : "td";
    text += "<tr>";
    for (std::size_t c = 0; c < rows[r].size(); ++c)
      text += "<" + cell + (c >= numbers_from ? " class=\"number\">" : ">") + escaped_markup(rows[r][c]) + "</" + cell +
              ">";
    text += "</tr>\n";
  }
  return text + "</table>\n";
}

std::string html_panels(const std::vector<Panel>& panels) {
  if (panels.empty()) return "";
  std::string text = "<div class=\"panels\">\n";
  for (const Panel& panel : panels) text += "<figure>" + svg(panel) + "</figure>\n";
  return text + "</div>\n";
}

std::string html_paragraph(const std::string& text) { return "<p>" + escaped_markup(text) + "</p>\n"; }

std::string html_page(const std::string& title, const SectionTitles& sections, const std::string& body) {
  std::string links;
  for (const auto& [id, heading] : sections)
    if (body.find("<section id=\"" + id + "\"") != std::string::npos)
      links += "<a href=\"#" + id + "\">" + heading + "</a>\n";
  const std::string name = escaped_markup(title);
  return "<!DOCTYPE html>\n<html lang=\"en\">\n<head>\n<meta charset=\"utf-8\">\n"
         "<meta name=\"viewport\" content=\"width=device-width, initial-scale=1\">\n"
         "<link rel=\"icon\" href=\"data:,\">\n<title>" +
         name + "</title>\n<style>\n" + page_style + "</style>\n</head>\n<body>\n<header>\n<h1>" + name +
         "</h1>\n<nav>\n" + links + "</nav>\n</header>\n<main>\n" + body + "</main>\n<footer>Written by sprekk " +
         escaped_markup(build_info().version + " " + build_info().git_commit) + "</footer>\n<script>\n" + page_script +
         "</script>\n</body>\n</html>\n";
}

}  // namespace sprekk
