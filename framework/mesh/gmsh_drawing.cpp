#include "framework/mesh/gmsh_drawing.hpp"

#include <gmsh.h>

#include <algorithm>
#include <cstdlib>

namespace sprekk {
namespace {

/// A closed loop of given lines, each of which begins where the one before ends.
int add_loop(const CanonicalDrawing& drawing, const std::vector<int>& given_lines) {
  std::vector<int> tags;
  for (const int line : given_lines)
    tags.push_back((drawing.is_reversed[line] ? -1 : 1) * (drawing.line_number[line] + 1));
  const auto lowest =
      std::min_element(tags.begin(), tags.end(), [](int a, int b) { return std::abs(a) < std::abs(b); });
  std::rotate(tags.begin(), lowest, tags.end());
  return gmsh::model::geo::addCurveLoop(tags);
}

}  // namespace

void enter_drawing(const CanonicalDrawing& drawing) {
  for (std::size_t i = 0; i < drawing.points.size(); ++i)
    gmsh::model::geo::addPoint(drawing.points[i].x(), drawing.points[i].y(), 0, 0, static_cast<int>(i) + 1);
  for (std::size_t i = 0; i < drawing.lines.size(); ++i)
    gmsh::model::geo::addLine(drawing.lines[i][0] + 1, drawing.lines[i][1] + 1, static_cast<int>(i) + 1);
}

void add_surface(const CanonicalDrawing& drawing, const std::vector<std::vector<int>>& loops,
                 const std::vector<int>& embedded) {
  const auto lowest = [&](const std::vector<int>& lines) {
    int number = drawing.line_number[lines.front()];
    for (const int line : lines) number = std::min(number, drawing.line_number[line]);
    return number;
  };
  std::vector<std::vector<int>> ordered = loops;
  std::sort(ordered.begin() + 1, ordered.end(), [&](const auto& a, const auto& b) { return lowest(a) < lowest(b); });
  std::vector<int> loop_tags, inner;
  for (const auto& loop : ordered) loop_tags.push_back(add_loop(drawing, loop));
  const int surface = gmsh::model::geo::addPlaneSurface(loop_tags);
  for (const int line : embedded) inner.push_back(drawing.line_number[line] + 1);
  std::sort(inner.begin(), inner.end());
  gmsh::model::geo::synchronize();
  if (!inner.empty()) gmsh::model::mesh::embed(1, inner, 2, surface);
}

}  // namespace sprekk
