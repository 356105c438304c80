#include "framework/meshing/spec/geometry_spec.hpp"

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <memory>

#include "framework/config/usual_range.hpp"
#include "framework/mesh/medium.hpp"
#include "framework/meshing/clip_fracture.hpp"
#include "framework/meshing/fracture_table.hpp"
#include "framework/meshing/random/random_fractures_spec.hpp"
#include "framework/meshing/spec/places.hpp"
#include "framework/meshing/spec/side_parts_spec.hpp"

namespace sprekk {
namespace {

Origin origin_of(const Node& whole, const std::string& key) {
  const Node* value = whole.find(key);
  return value ? value->origin : whole.origin;
}

using BoxInput = std::array<std::vector<double>, dimension>;  ///< ends along each axis

Spec box_spec(const std::shared_ptr<BoxInput>& input, Box& box) {
  Spec spec("box", dimension == 2 ? "A rectangle; its sides are called left, right, bottom and top."
                                  : "A box; its sides are called left and right (along x), front and back (along y), "
                                    "bottom and top (along z).");
  for (int axis = 0; axis < dimension; ++axis) {
    const std::string key(1, "xyz"[axis]);
    spec.quantities(key, (*input)[axis],
                    {.unit = "m", .doc = "Where it begins and ends along " + key + ".", .required = true});
  }
  spec.check([input, &box](const Node& whole) {
    for (int axis = 0; axis < dimension; ++axis) {
      const std::string key(1, "xyz"[axis]);
      const std::vector<double>& ends = (*input)[axis];
      if (ends.size() != 2)
        throw InputError(origin_of(whole, key), "the box needs two values along " + key,
                         std::to_string(ends.size()) + " are given", "write " + key + ": [0 m, 1 m]");
      box.low[axis] = ends[0];
      box.high[axis] = ends[1];
    }
    box.origin = whole.origin;
  });
  return spec;
}

struct FractureInput {
  std::string table;
  std::optional<Point> origin;
  bool is_clipped = false;
  bool is_random = false;
  RandomFractures random;
  std::optional<double> size;
};

/// Fractures of a table that are cut off at the sides of the box.
struct ClippedTable {
  std::string file;
  Origin where;
  std::vector<FractureGeometry> fractures;
};

/// Takes the fractures of a scene as they are read.
struct FractureKeeper {
  std::function<void(FractureGeometry)> keep;
  std::function<void(RandomFractures)> keep_set;
  std::function<void(std::vector<FractureGeometry>, bool is_clipped, const std::string& file)> keep_table;
};

/// Throws InputError for further parameters beside a key that gives a whole set.
void require_alone(const Node& whole, const std::string& name, const std::string& how, const std::string& key,
                   const std::vector<std::string>& beside = {}) {
  for (const std::string& other : whole.keys())
    if (other != key && std::ranges::count(beside, other) == 0)
      throw InputError(whole.origin, "the fractures '" + name + "' are given twice",
                       "they " + how + " and have further parameters", "remove '" + other + "'");
}

/// Refuses what is for the fractures of a table.
void require_table(const Node& whole, const std::string& name, const FractureInput& input) {
  if (!input.origin && !input.is_clipped) return;
  const std::string key = input.origin ? "origin" : "clip";
  throw InputError(origin_of(whole, key), "fracture '" + name + "' has '" + key + "'",
                   "it is for the fractures of a table", "remove it");
}

Spec fracture_spec(const std::string& name, const Origin& origin, const std::string& folder, FractureKeeper keeper) {
  const auto input = std::make_shared<FractureInput>();
  Spec spec("fracture", fracture_doc);
  const auto place = std::make_shared<FracturePlace>();
  add_place(spec, place);
  spec.quantity("size", input->size,
                {.unit = "m", .range = positive(), .doc = "The length of its cells; else the mesh's fracture_size."});
  spec.text("table", input->table,
            {.doc = "A CSV file beside the scene with many fractures: " + std::string(table_columns) +
                    "; also name and size. They are called NAME_1, "
                    "NAME_2, … where they have no names. Data may take further columns by {column: …}. Or a GeoJSON "
                    "file with " +
                    (dimension == 2 ? "lines" : "polygons with z") + ", whose properties are such columns."});
  spec.point("origin", input->origin,
             {.unit = "m", .doc = "What in the coordinates of the table is the origin of the scene; by default zero."});
  if constexpr (dimension == 2)
    spec.flag("clip", input->is_clipped,
              {.doc = "Leaves out what of the fractures of a table lies outside of the box."});
  input->random.name = name;
  input->random.origin = origin;
  spec.section("random", random_fractures_spec(input->random),
               {.doc = "A set that is drawn at random: NAME_1, NAME_2, …, the longest first."}, &input->is_random);
  spec.check([input, place, name, origin, folder, keeper = std::move(keeper)](const Node& whole) {
    if (!input->table.empty()) {
      require_alone(whole, name, "come from a table", "table", {"origin", "clip"});
      std::vector<FractureGeometry> fractures =
          read_fracture_table({input->table, folder, name, origin, input->origin.value_or(Point::Zero())});
      return keeper.keep_table(std::move(fractures), input->is_clipped, input->table);
    }
    require_table(whole, name, *input);
    if (input->is_random) {
      require_alone(whole, name, "are random", "random", {"clip"});
      return keeper.keep_set(input->random);
    }
    FractureGeometry fracture{name, {}, input->size, origin};
    take_place(*place, whole, fracture);
    keeper.keep(std::move(fracture));
  });
  return spec;
}

/// Cuts tables off at the box once this is known.
void clip_tables(const std::vector<ClippedTable>& tables, Geometry& geometry) {
  if constexpr (dimension == 2)
    for (const ClippedTable& table : tables) {
      if (geometry.is_imported() || geometry.box.size().minCoeff() <= 0) return;  // validate_geometry says so
      const std::size_t before = geometry.fractures.size();
      for (const FractureGeometry& fracture : table.fractures)
        for (FractureGeometry& part : clipped(fracture, geometry.box)) geometry.fractures.push_back(std::move(part));
      if (geometry.fractures.size() > before) continue;
      Point low = table.fractures.front().points.front(), high = low;
      for (const FractureGeometry& fracture : table.fractures)
        for (const Point& point : fracture.points) {
          low = low.cwiseMin(point);
          high = high.cwiseMax(point);
        }
      throw InputError(table.where, "no fracture of the table '" + table.file + "' lies in the box",
                       "its points lie between " + to_text(low) + " and " + to_text(high) +
                           ", those of the box between " + to_text(geometry.box.low) + " and " +
                           to_text(geometry.box.high),
                       "give its 'origin'");
    }
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

}  // namespace

Spec geometry_spec(Geometry& geometry, const std::string& folder) {
  Spec spec("geometry", "The " + medium_name() + ", the fractures in it, and its regions.");
  spec.section("box", box_spec(std::make_shared<BoxInput>(), geometry.box),
               {.doc = "The " + medium_name() + (dimension == 2 ? " as a rectangle." : " as a box.")});
  spec.text(
      "file", geometry.file,
      {.doc =
           dimension == 2
               ? "A gmsh mesh file of triangles and convex quadrilaterals instead of a box, relative to the scene: "
                 "groups of curves are sides (on the boundary) or fractures (inside), groups of surfaces are regions."
               : "A gmsh mesh file of tetrahedra, wedges and hexahedra instead of a box, relative to the scene: groups "
                 "of surfaces are sides (on the boundary) or fractures (inside), groups of volumes are regions."});
  const auto sets = std::make_shared<std::vector<RandomFractures>>();
  const auto tables = std::make_shared<std::vector<ClippedTable>>();
  // The short form `fractures: {table: FILE}` has been expanded by expand_fracture_table.
  spec.named_sections(
      "fractures", fracture_spec("", {}, "", {}),
      [&geometry, folder, sets, tables](const std::string& name, const Origin& origin) {
        const auto keep_table = [&geometry, tables, origin](std::vector<FractureGeometry> fractures, bool is_clipped,
                                                            const std::string& file) {
          if (is_clipped) return tables->push_back({file, origin, std::move(fractures)});
          std::ranges::move(fractures, std::back_inserter(geometry.fractures));
        };
        return fracture_spec(name, origin, folder,
                             {[&geometry](FractureGeometry f) { geometry.fractures.push_back(std::move(f)); },
                              [sets](RandomFractures set) { sets->push_back(std::move(set)); }, keep_table});
      },
      {.doc = "The fractures, by name; they may cross and touch one another inside of the " + medium_name() + "."});
  spec.named_sections("regions", region_spec("", {}, [](RegionGeometry) {}),
                      [&geometry](const std::string& name, const Origin& origin) {
                        return region_spec(name, origin,
                                           [&geometry](RegionGeometry r) { geometry.regions.push_back(std::move(r)); });
                      },
                      {.doc = (dimension == 2 ? "Polygons" : "Bodies") +
                              std::string(" that the mesh conforms to, by name; the rest is called ") + medium_name() +
                              ", and later ones cover earlier ones."});
  if constexpr (dimension == 3) declare_side_parts(spec, geometry);
  spec.quantity(
      "snap", geometry.snap,
      {.unit = "m",
       .range = non_negative(),
       .doc = dimension == 2 ? "Ends, points and crossings of fractures and regions that are nearer to one another, to "
                               "a line or to a side are joined, and parts that lie on a fracture already are left out; "
                               "by default a hundredth of the shortest cell that the mesh is asked for, and 0 joins "
                               "nothing."
                             : "Fractures that are nearer to one another or to a side, but do not touch, are refused; "
                               "by default a millionth of the diagonal of the box."});
  spec.check([&geometry, folder, sets, tables](const Node& whole) {
    const bool has_box = whole.find("box"), has_file = geometry.is_imported();
    if (has_box == has_file) {
      throw InputError(whole.origin,
                       has_box ? "the geometry has a box and a file" : "the geometry has neither box nor file",
                       "it needs exactly one of them",
                       has_box          ? "remove one of the two"
                       : dimension == 2 ? "write box: {x: [0 m, 1 m], y: [0 m, 1 m]}"
                                        : "write box: {x: [0 m, 1 m], y: [0 m, 1 m], z: [0 m, 1 m]}");
    }
    clip_tables(*tables, geometry);
    draw_sets(*sets, geometry);
    if constexpr (dimension == 3) complete_side_parts(geometry);
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

const std::string axes = dimension == 2 ? "x and y" : "x, y and z";
const std::string cells_counted = dimension == 2 ? "rectangles" : "hexahedra";

/// The numbers of rectangles, or of hexahedra, of a structured mesh.
void take_cells(const Node& whole, const std::vector<double>& cells, MeshOptions& options) {
  const Origin origin = origin_of(whole, "cells");
  if (options.kind != MeshOptions::Kind::structured) {
    throw InputError(origin, std::string("an unstructured mesh has no cells along ") + axes, "its edges have a size",
                     "write kind: structured, or size: …");
  }
  constexpr double most = 1e7;  // along a side: no memory holds more
  const auto is_count = [](double count) { return count == std::floor(count) && count <= most; };
  if (cells.size() != dimension || !std::ranges::all_of(cells, is_count)) {
    throw InputError(
        origin, std::string("cells are not ") + (dimension == 2 ? "two" : "three") + " whole numbers",
        "they count the " + cells_counted + " along " + axes + (dimension == 2 ? "" : ", since the box has a z"),
        dimension == 2 ? "write cells: [20, 20]" : "write cells: [20, 20, 20]");
  }
  for (int axis = 0; axis < dimension; ++axis) options.cells[axis] = static_cast<int>(cells[axis]);
}

}  // namespace

namespace {

void declare_sizes(Spec& spec, MeshOptions& options) {
  spec.quantity("size", options.size,
                {.unit = "m",
                 .range = positive(),
                 .doc = "Edge length away from fractures; by default a " +
                        std::string(dimension == 2 ? "fiftieth" : "twentieth") + " of the box's longer side."});
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
       .doc = dimension == 2 ? "Unstructured: how many edges a gap between a fracture and a side, another fracture, "
                               "another part of itself or an edge of a region has across, where that makes shorter "
                               "ones; 0 leaves gaps, and short pieces of fractures, alone."
                             : "Unstructured: how many edges there are between a corner of a fracture, or a point at "
                               "which fractures cross, and the nearest edge or point of another one, where that makes "
                               "shorter ones; 0 leaves them alone."});
  if (dimension == 2)
    spec.quantity(
        "gap_length", options.gap_length,
        {.unit = "",
         .range = non_negative(),
         .doc = "Gaps between walls side by side that are longer than so many widths are left alone, but for their "
                "ends: they would take many cells."});
  spec.quantity("gap_size", options.gap_size,
                {.unit = "m",
                 .range = positive(),
                 .doc = "Gaps make edges no shorter than this; by default a " +
                        std::string(dimension == 2 ? "500th" : "20th") + " of the shortest size asked for."});
}

}  // namespace

Spec mesh_spec(MeshOptions& options) {
  struct Input {
    std::string kind = "unstructured", shape = dimension == 2 ? "triangles" : "tetrahedra", division = "compact";
    std::vector<double> cells;
  };
  const auto input = std::make_shared<Input>();
  Spec spec("mesh", "How the geometry is cut into cells.");
  spec.choice(
      "kind", input->kind,
      {{"unstructured", "cells of varying size, made by gmsh"},
       {"structured",
        dimension == 2
            ? "equal rectangles, cut into triangles by alternating diagonals; fractures and edges of regions "
              "must lie on their lines"
            : "equal hexahedra, whole or cut by alternating diagonals; fractures and borders of regions must be "
              "faces of cells"}},
      {.doc = "What kind of mesh."});
  const std::vector<std::pair<std::string, std::string>> shapes =
      dimension == 2
          ? std::vector<std::pair<std::string, std::string>>{{"triangles", "triangles only"},
                                                             {"quadrilaterals",
                                                              "structured: whole rectangles, without diagonals; "
                                                              "unstructured: triangles are joined in pairs "
                                                              "where that gives good convex cells; the others stay"}}
          : std::vector<std::pair<std::string, std::string>>{
                {"tetrahedra", "structured: six of each hexahedron; unstructured meshes have these alone"},
                {"wedges", "structured: two of each hexahedron, with triangles at bottom and top"},
                {"hexahedra", "structured: whole"}};
  spec.choice("shape", input->shape, shapes, {.doc = "What the cells look like; a mesh file brings its own."});
  declare_sizes(spec, options);
  spec.quantities("cells", input->cells,
                  {.unit = "",
                   .range = positive(),
                   .doc = "Structured: " + cells_counted + " along " + axes + "; by default as size asks."});
  if (dimension == 2) {
    spec.quantity("distortion", options.distortion,
                  {.unit = "",
                   .range = between(0, 0.4),
                   .doc = "Moves inner nodes at random by up to this part of the shortest edge there, for tests."});
    spec.integer("seed", options.seed, {.doc = "Which random distortion."});
  }
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
    using Shape = MeshOptions::Shape;
    options.shape = input->shape == "triangles"        ? Shape::triangles
                    : input->shape == "quadrilaterals" ? Shape::quadrilaterals
                    : input->shape == "tetrahedra"     ? Shape::tetrahedra
                    : input->shape == "wedges"         ? Shape::wedges
                                                       : Shape::hexahedra;
    if (!input->cells.empty()) take_cells(whole, input->cells, options);
  });
  return spec;
}

}  // namespace sprekk
