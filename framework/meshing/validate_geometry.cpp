#include "framework/meshing/validate_geometry.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <optional>
#include <sstream>
#include <utility>

#include "framework/mesh/geometry.hpp"
#include "framework/meshing/distinct_text.hpp"
#include "framework/meshing/validate_shapes.hpp"

namespace sprekk {
namespace {

constexpr double most_cells = 20e6;  // no memory holds more

std::string number(double value) {
  std::ostringstream out;
  out << value;
  return out.str();
}

std::string box_text(const Box& box) {
  std::string text = "the box is";
  for (int i = 0; i < dimension; ++i)
    text += std::string(i > 0 ? ", " : " ") + "xyz"[i] + " from " + number(box.low[i]) + " to " + number(box.high[i]) +
            " m";
  return text;
}

void validate_box(const Box& box) {
  if (!box.low.allFinite() || !box.high.allFinite()) {
    throw InputError(box.origin, "the box has an end that is no finite number", box_text(box));
  }
  for (int i = 0; i < dimension; ++i) {
    const std::string axis(1, "xyz"[i]);
    if (box.high[i] <= box.low[i]) {
      throw InputError(box.origin, "the box is empty along " + axis,
                       "it reaches from " + number(box.low[i]) + " to " + number(box.high[i]) + " m",
                       "write the smaller " + axis + " first");
    }
  }
}

void validate_size(const std::string& name, std::optional<double> size, const Origin& origin) {
  if (size && !(*size > 0 && std::isfinite(*size))) {
    throw InputError(origin, "mesh size '" + name + "' is " + number(*size) + " m", "edge lengths are positive");
  }
}

template <class Item>
void validate_names(const std::vector<Item>& items, const std::string& kind, Problems& problems) {
  std::map<std::string, const Item*> known;
  for (const Item& item : items) {
    const auto [first, is_new] = known.emplace(item.name, &item);
    if (is_new) continue;
    problems.push_back(InputError(item.origin, "two " + kind + "s are called '" + item.name + "'",
                                  "the other one is at " + first->second->origin.text(),
                                  "give one of them another name")
                           .what());
  }
}

void validate_options(const MeshOptions& options) {
  validate_size("size", options.size, options.origin);
  validate_size("fracture_size", options.fracture_size, options.origin);
  validate_size("tip_size", options.tip_size, options.origin);
  validate_size("gap_size", options.gap_size, options.origin);
  if (!(options.gap_edges >= 0 && std::isfinite(options.gap_edges))) {
    throw InputError(options.origin, "mesh gap_edges is " + number(options.gap_edges), "it must be 0 or more",
                     "0 leaves narrow gaps alone");
  }
  constexpr double steepest = 2, most_distorted = 0.4;  // beyond, cells are bad, or may turn over
  if (!(options.growth > 0 && options.growth <= steepest)) {
    throw InputError(options.origin, "mesh growth is " + number(options.growth),
                     "it must be greater than 0 and at most 2", "0.3 is usual");
  }
  if (!(options.distortion >= 0 && options.distortion <= most_distorted)) {
    throw InputError(options.origin, "mesh distortion is " + number(options.distortion), "it must be from 0 to 0.4");
  }
  if (dimension == 3 && options.distortion > 0)
    throw InputError(options.origin, "a mesh in space cannot be distorted", "nodes are moved in a plane only",
                     "leave distortion away");
  if (*std::ranges::min_element(options.cells) < 0) {
    throw InputError(options.origin, "the mesh has a negative number of cells along a side");
  }
}

/// What a mesh consists of.
std::string cells_of(const MeshOptions& options) {
  using Shape = MeshOptions::Shape;
  if (dimension == 2)
    return options.kind == MeshOptions::Kind::structured && options.shape == Shape::quadrilaterals ? "rectangles"
                                                                                                   : "triangles";
  return options.shape == Shape::hexahedra ? "hexahedra" : options.shape == Shape::wedges ? "wedges" : "tetrahedra";
}

/// Cells for each rectangle, or hexahedron, of a structured mesh.
int cells_of_each(MeshOptions::Shape shape) {
  using Shape = MeshOptions::Shape;
  return shape == Shape::tetrahedra ? 6 : shape == Shape::triangles || shape == Shape::wedges ? 2 : 1;
}

void validate_cell_count(const Geometry& geometry, const MeshOptions& options) {
  double estimate = 0;
  if (options.kind == MeshOptions::Kind::structured) {
    estimate = cells_of_each(options.shape);
    for (int i = 0; i < dimension; ++i) {
      estimate *= options.cells[i] > 0 ? options.cells[i] : geometry.box.size()[i] / far_size(geometry, options);
    }
  } else {
    estimate = wanted_cells(geometry, options);
  }
  if (estimate > most_cells) {
    MeshOptions without_gaps = options;
    without_gaps.gap_edges = 0;
    if (options.kind == MeshOptions::Kind::unstructured && wanted_cells(geometry, without_gaps) <= most_cells) {
      throw InputError(options.origin, "narrow gaps ask for about " + number(estimate) + " triangles",
                       "at most " + number(most_cells) + " are made",
                       "choose a larger gap_size, or gap_edges: 0 to leave gaps alone");
    }
    throw InputError(options.origin, "the mesh sizes ask for about " + number(estimate) + " " + cells_of(options),
                     "at most " + number(most_cells) + " are made", "choose larger sizes; " + box_text(geometry.box));
  }
}

}  // namespace

double depth(const Box& box, const Point& x) { return std::min((x - box.low).minCoeff(), (box.high - x).minCoeff()); }

void validate_points(const Box& box, const std::vector<Point>& points, const std::string& what, const Origin& origin) {
  for (const Point& point : points) {
    if (!point.allFinite()) throw InputError(origin, what + " has a point that is no finite number", to_text(point));
    if (depth(box, point) < -point_tolerance(box)) {
      throw InputError(origin, what + " leaves the box",
                       "its point " + distinct_text(point, point.cwiseMax(box.low).cwiseMin(box.high)) +
                           " lies outside; " + box_text(box),
                       "move the point or enlarge the box");
    }
  }
}

void validate_geometry(const Geometry& geometry, const MeshOptions& options) {
  validate_options(options);
  if (geometry.is_imported()) {
    if (!geometry.fractures.empty() || !geometry.regions.empty()) {
      throw InputError(geometry.file_origin, "fractures and regions are given together with a mesh file",
                       "the file holds them as groups of curves and surfaces", "draw them into the file");
    }
    if (options.kind == MeshOptions::Kind::structured) {
      throw InputError(options.origin, "a mesh file cannot become a structured mesh");
    }
    if (options.shape != MeshOptions().shape) {
      throw InputError(options.origin, "the cells of a mesh file keep their shape",
                       dimension == 2 ? "a file may hold triangles and quadrilaterals"
                                      : "a file may hold tetrahedra, wedges and hexahedra",
                       "leave shape away");
    }
    return;
  }
  if (dimension == 3 && options.kind == MeshOptions::Kind::unstructured &&
      options.shape != MeshOptions::Shape::tetrahedra) {
    throw InputError(options.origin, "an unstructured mesh in space has no " + cells_of(options),
                     "gmsh makes tetrahedra between fractures", "write kind: structured, or shape: tetrahedra");
  }
  validate_box(geometry.box);
  Problems problems;
  validate_names(geometry.fractures, "fracture", problems);
  validate_names(geometry.regions, "region", problems);
  const double snap = geometry.snap.value_or(0);
  for (const FractureGeometry& fracture : geometry.fractures) {
    collect(problems, [&] {
      validate_size("size", fracture.size, fracture.origin);
      validate_fracture(geometry.box, fracture, snap);
    });
  }
  validate_pairs(geometry, problems);
  for (const RegionGeometry& region : geometry.regions)
    collect(problems, [&] { validate_region(geometry.box, region); });
  if (!problems.empty()) throw InputError(problems);
  validate_cell_count(geometry, options);
}

}  // namespace sprekk
