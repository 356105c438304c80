#include "framework/meshing/spec/geometry_spec.hpp"

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <memory>

#include "framework/config/usual_range.hpp"
#include "framework/mesh/medium.hpp"
#include "framework/meshing/fracture_table.hpp"
#include "framework/meshing/random/random_fractures_spec.hpp"

namespace sprekk {
namespace {

Origin origin_of(const Node& whole, const std::string& key) {
  const Node* value = whole.find(key);
  return value ? value->origin : whole.origin;
}

struct BoxInput {
  std::vector<double> x, y;
};

Spec box_spec(const std::shared_ptr<BoxInput>& input, Box& box) {
  Spec spec("box", "A rectangle; its sides are called left, right, bottom and top.");
  spec.quantities("x", input->x, {.unit = "m", .doc = "Where it begins and ends along x.", .required = true});
  spec.quantities("y", input->y, {.unit = "m", .doc = "Where it begins and ends along y.", .required = true});
  spec.check([input, &box](const Node& whole) {
    for (const auto& [key, ends] : {std::pair("x", &input->x), std::pair("y", &input->y)}) {
      if (ends->size() == 2) continue;
      throw InputError(origin_of(whole, key), std::string("the box needs two values along ") + key,
                       std::to_string(ends->size()) + " are given", std::string("write ") + key + ": [0 m, 1 m]");
    }
    box.low = {input->x[0], input->y[0]};
    box.high = {input->x[1], input->y[1]};
    box.origin = whole.origin;
  });
  return spec;
}

struct FractureInput {
  std::string table;
  bool is_random = false;
  RandomFractures random;
  std::vector<Point> points;
  std::optional<Point> center;
  std::optional<double> length, size, angle;
};

/// Takes the fractures of a scene as they are read.
struct FractureKeeper {
  std::function<void(FractureGeometry)> keep;
  std::function<void(RandomFractures)> keep_set;
};

/// Throws InputError for further parameters beside a key that gives a whole set.
void require_alone(const Node& whole, const std::string& name, const std::string& how, const std::string& key) {
  if (whole.keys().size() > 1)
    throw InputError(whole.origin, "the fractures '" + name + "' are given twice",
                     "they " + how + " and have further parameters", "keep " + key + " alone");
}

Spec fracture_spec(const std::string& name, const Origin& origin, const std::string& folder, FractureKeeper keeper) {
  const auto input = std::make_shared<FractureInput>();
  Spec spec("fracture",
            "A polyline, given by its points or as a straight line by center, length and angle; or a set of fractures, "
            "from a table or drawn at random.");
  spec.points("points", input->points,
              {.unit = "m", .doc = "The points of the polyline; the plus side is to its left."});
  spec.point("center", input->center, {.unit = "m", .doc = "The middle of a straight fracture."});
  spec.quantity("length", input->length,
                {.unit = "m", .range = positive(), .doc = "The length of a straight fracture."});
  spec.quantity(
      "angle", input->angle,
      {.unit = "rad", .doc = "The direction of a straight fracture, counter-clockwise from the x axis; by default 0."});
  usually(spec, "angle", usual_angle());
  spec.quantity("size", input->size,
                {.unit = "m", .range = positive(), .doc = "The length of its cells; else the mesh's fracture_size."});
  spec.text("table", input->table,
            {.doc = "A CSV file beside the scene with many fractures: a row for each with the columns x1, y1, x2, y2, "
                    "or for each point of a polyline with name, x, y; also name and size. They are called NAME_1, "
                    "NAME_2, … where they have no names. Data may take further columns by {column: …}."});
  input->random.name = name;
  input->random.origin = origin;
  spec.section("random", random_fractures_spec(input->random),
               {.doc = "A set that is drawn at random: NAME_1, NAME_2, …, the longest first."}, &input->is_random);
  spec.check([input, name, origin, folder, keeper = std::move(keeper)](const Node& whole) {
    if (!input->table.empty()) {
      require_alone(whole, name, "come from a table", "the table");
      for (FractureGeometry& fracture : read_fracture_table({input->table, folder, name, origin}))
        keeper.keep(std::move(fracture));
      return;
    }
    if (input->is_random) {
      require_alone(whole, name, "are random", "'random'");
      return keeper.keep_set(input->random);
    }
    FractureGeometry fracture{name, input->points, input->size, origin};
    const bool has_points = !input->points.empty(), has_center = input->center.has_value();
    const bool has_line = has_center || input->length || input->angle;
    if (has_points && has_line) {
      throw InputError(whole.origin, "fracture '" + name + "' is given twice",
                       "it has points and also center, length or angle", "keep one of the two");
    }
    if (!has_points && !(has_center && input->length)) {
      throw InputError(whole.origin, "fracture '" + name + "' is not given completely",
                       "it needs points, or center and length",
                       "write points: [[x, y], [x, y]] or center: [x, y], length: …, angle: …");
    }
    if (has_center) {
      const double angle = input->angle.value_or(0);
      const Point half = 0.5 * *input->length * Point(std::cos(angle), std::sin(angle));
      fracture.points = {*input->center - half, *input->center + half};
    }
    keeper.keep(std::move(fracture));
  });
  return spec;
}

/// Draws the random sets once everything else is known.
void draw_sets(const std::vector<RandomFractures>& sets, Geometry& geometry) {
  for (const RandomFractures& set : sets) {
    if (geometry.is_imported())
      throw InputError(set.origin, "the random set '" + set.name + "' is given together with a mesh file",
                       "the file holds all fractures as groups of curves", "draw them into the file");
    if (geometry.box.size().minCoeff() <= 0) return;  // validate_geometry says so
    draw_fractures(set, geometry);
  }
}

Spec region_spec(const std::string& name, const Origin& origin, std::function<void(RegionGeometry)> keep) {
  const auto polygon = std::make_shared<std::vector<Point>>();
  Spec spec("region", "A part of the " + medium_name() + " that may have properties of its own.");
  spec.points("polygon", *polygon,
              {.unit = "m", .doc = "The corners in order, not repeating the first.", .required = true});
  spec.check([polygon, name, origin, keep = std::move(keep)](const Node&) { keep({name, *polygon, origin}); });
  return spec;
}

}  // namespace

Spec geometry_spec(Geometry& geometry, const std::string& folder) {
  Spec spec("geometry", "The " + medium_name() + ", the fractures in it, and its regions.");
  spec.section("box", box_spec(std::make_shared<BoxInput>(), geometry.box),
               {.doc = "The " + medium_name() + " as a rectangle."});
  spec.text(
      "file", geometry.file,
      {.doc = "A gmsh mesh file of triangles and convex quadrilaterals instead of a box, relative to the scene: groups "
              "of curves are sides (on the boundary) or fractures (inside), groups of surfaces are regions."});
  const auto sets = std::make_shared<std::vector<RandomFractures>>();
  // The short form `fractures: {table: FILE}` has been expanded by expand_fracture_table.
  spec.named_sections(
      "fractures", fracture_spec("", {}, "", {}),
      [&geometry, folder, sets](const std::string& name, const Origin& origin) {
        return fracture_spec(name, origin, folder,
                             {[&geometry](FractureGeometry f) { geometry.fractures.push_back(std::move(f)); },
                              [sets](RandomFractures set) { sets->push_back(std::move(set)); }});
      },
      {.doc = "The fractures, by name; they may cross and touch one another inside of the " + medium_name() + "."});
  spec.named_sections("regions", region_spec("", {}, [](RegionGeometry) {}),
                      [&geometry](const std::string& name, const Origin& origin) {
                        return region_spec(name, origin,
                                           [&geometry](RegionGeometry r) { geometry.regions.push_back(std::move(r)); });
                      },
                      {.doc = "Polygons that the mesh conforms to, by name; the rest is called " + medium_name() +
                              ", and later ones cover earlier ones."});
  spec.quantity("snap", geometry.snap,
                {.unit = "m",
                 .range = non_negative(),
                 .doc = "Ends, points and crossings of fractures and regions that are nearer to one another, to a line "
                        "or to a side are joined, and parts that lie on a fracture already are left out; by default a "
                        "hundredth of the shortest cell that the mesh is asked for, and 0 joins nothing."});
  spec.check([&geometry, folder, sets](const Node& whole) {
    const bool has_box = whole.find("box"), has_file = geometry.is_imported();
    if (has_box == has_file) {
      throw InputError(whole.origin,
                       has_box ? "the geometry has a box and a file" : "the geometry has neither box nor file",
                       "it needs exactly one of them", "write box: {x: [0 m, 1 m], y: [0 m, 1 m]}");
    }
    draw_sets(*sets, geometry);
    geometry.snap_origin = origin_of(whole, "snap");
    if (!has_file) return;
    if (geometry.snap)
      throw InputError(geometry.snap_origin, "'snap' is given together with a mesh file",
                       "it joins the lines of a box before these are meshed", "remove 'snap'");
    geometry.file_origin = origin_of(whole, "file");
    if (std::filesystem::path(geometry.file).is_relative() && folder != ".") {
      geometry.file = (std::filesystem::path(folder) / geometry.file).string();
    }
  });
  return spec;
}

namespace {

/// The numbers of rectangles of a structured mesh.
void take_cells(const Node& whole, const std::vector<double>& cells, MeshOptions& options) {
  const Origin origin = origin_of(whole, "cells");
  if (options.kind != MeshOptions::Kind::structured) {
    throw InputError(origin, "an unstructured mesh has no cells along x and y", "its edges have a size",
                     "write kind: structured, or size: …");
  }
  constexpr double most = 1e7;
  if (cells.size() != 2 || cells[0] != std::floor(cells[0]) || cells[1] != std::floor(cells[1]) ||
      std::max(cells[0], cells[1]) > most) {
    throw InputError(origin, "cells are not two whole numbers", "they count the rectangles along x and y",
                     "write cells: [20, 20]");
  }
  options.cells = {static_cast<int>(cells[0]), static_cast<int>(cells[1])};
}

}  // namespace

Spec mesh_spec(MeshOptions& options) {
  struct Input {
    std::string kind = "unstructured", shape = "triangles", division = "compact";
    std::vector<double> cells;
  };
  const auto input = std::make_shared<Input>();
  Spec spec("mesh", "How the geometry is cut into cells.");
  spec.choice("kind", input->kind,
              {{"unstructured", "cells of varying size, made by gmsh"},
               {"structured",
                "equal rectangles, cut into triangles by alternating diagonals; fractures and edges of regions must "
                "lie on their lines"}},
              {.doc = "What kind of mesh."});
  spec.choice("shape", input->shape,
              {{"triangles", "triangles only"},
               {"quadrilaterals",
                "structured: whole rectangles, without diagonals; unstructured: triangles are joined in pairs "
                "where that gives good convex cells; the others stay"}},
              {.doc = "What the cells look like; a mesh file brings its own."});
  spec.quantity("size", options.size,
                {.unit = "m",
                 .range = positive(),
                 .doc = "Edge length away from fractures; by default a fiftieth of the box's longer side."});
  spec.quantity("fracture_size", options.fracture_size,
                {.unit = "m", .range = positive(), .doc = "Edge length at fractures; by default size."});
  spec.quantity(
      "tip_size", options.tip_size,
      {.unit = "m",
       .range = positive(),
       .doc = "Edge length at the ends of fractures in the " + medium_name() + "; by default that of the fracture."});
  spec.quantity("growth", options.growth,
                {.unit = "",
                 .range = Range{0, 2, false, true},
                 .doc = "By how much the edge length grows per distance from fractures and tips."});
  spec.quantity(
      "gap_edges", options.gap_edges,
      {.unit = "",
       .range = between(0, 10),
       .doc = "Unstructured: how many edges a gap between a fracture and a side, another fracture, another part "
              "of itself or an edge of a region has across, where that makes shorter ones; 0 leaves gaps, and short "
              "pieces "
              "of fractures, alone."});
  spec.quantity(
      "gap_length", options.gap_length,
      {.unit = "",
       .range = non_negative(),
       .doc = "Gaps between walls side by side that are longer than so many widths are left alone, but for their "
              "ends: they would take many cells."});
  spec.quantity("gap_size", options.gap_size,
                {.unit = "m",
                 .range = positive(),
                 .doc = "Gaps make edges no shorter than this; by default a 500th of the shortest size asked for."});
  spec.quantities(
      "cells", input->cells,
      {.unit = "", .range = positive(), .doc = "Structured: rectangles along x and y; by default as size asks."});
  spec.quantity("distortion", options.distortion,
                {.unit = "",
                 .range = between(0, 0.4),
                 .doc = "Moves inner nodes at random by up to this part of the shortest edge there, for tests."});
  spec.integer("seed", options.seed, {.doc = "Which random distortion."});
  spec.choice("division", input->division,
              {{"compact", "parts of equal size with short borders"},
               {"scattered", "each cell at random, for tests"},
               {"lopsided", "one cell at a wall for the last process and nothing for those before it, for tests"}},
              {.doc = "How cells are divided among processes."});
  spec.check([input, &options](const Node& whole) {
    options.origin = whole.origin;
    options.kind = input->kind == "structured" ? MeshOptions::Kind::structured : MeshOptions::Kind::unstructured;
    options.division = input->division == "scattered"  ? Division::scattered
                       : input->division == "lopsided" ? Division::lopsided
                                                       : Division::compact;
    options.shape = input->shape == "triangles" ? MeshOptions::Shape::triangles : MeshOptions::Shape::quadrilaterals;
    if (!input->cells.empty()) take_cells(whole, input->cells, options);
  });
  return spec;
}

}  // namespace sprekk
