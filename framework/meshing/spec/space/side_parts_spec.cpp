#include "framework/meshing/spec/side_parts_spec.hpp"

#include <algorithm>
#include <limits>
#include <memory>
#include <optional>

#include "framework/mesh/geometry.hpp"

namespace sprekk {
namespace {

constexpr double open = std::numeric_limits<double>::infinity();

struct PartInput {
  std::string side;
  std::array<std::vector<double>, dimension> ends;  ///< along each axis
  std::optional<double> size;
};

Spec part_spec(const std::string& name, const Origin& origin, Geometry* geometry) {
  const auto input = std::make_shared<PartInput>();
  Spec spec("side", "A rectangle on a side of the box, which has conditions of its own by its name.");
  std::vector<std::pair<std::string, std::string>> choices;
  for (const char* side : box_sides) choices.emplace_back(side, "on the side " + std::string(side));
  spec.choice("side", input->side, choices, {.doc = "The side.", .required = true});
  for (int axis = 0; axis < dimension; ++axis)
    spec.quantities(axis_names[axis], input->ends[axis],
                    {.unit = "m",
                     .doc = "Where it begins and ends along " + std::string(axis_names[axis]) +
                            "; without it, where the side does."});
  spec.quantity("size", input->size,
                {.unit = "m",
                 .range = positive(),
                 .doc = "Edge length on it, in unstructured meshes; by default the mesh's size. Where what is given "
                        "changes at its border, fluxes converge slowly, and small cells help."});
  spec.check([input, name, origin, geometry](const Node& whole) {
    SidePart part{name, 0, Point::Constant(-open), Point::Constant(open), origin, input->size};
    part.side = static_cast<int>(std::ranges::find(box_sides, input->side) - box_sides.begin());
    for (int axis = 0; axis < dimension; ++axis) {
      const std::vector<double>& ends = input->ends[axis];
      if (ends.empty()) continue;
      if (axis == part.side / 2)
        throw InputError(whole.origin, "'" + name + "' has ends along " + axis_names[axis],
                         "the side '" + input->side + "' has one " + axis_names[axis], "remove them");
      if (ends.size() != 2 || !(ends[0] < ends[1]))
        throw InputError(whole.origin, "'" + name + "' does not begin and end along " + axis_names[axis],
                         "two values are needed, the smaller one first",
                         std::string("write ") + axis_names[axis] + ": [0 m, 1 m]");
      part.low[axis] = ends[0];
      part.high[axis] = ends[1];
    }
    if (geometry) geometry->side_parts.push_back(part);
  });
  return spec;
}

bool overlap(const SidePart& one, const SidePart& other) {
  if (one.side != other.side) return false;
  for (int axis = 0; axis < dimension; ++axis)
    if (axis != one.side / 2 && !(one.low[axis] < other.high[axis] && other.low[axis] < one.high[axis])) return false;
  return true;
}

}  // namespace

void declare_side_parts(Spec& spec, Geometry& geometry) {
  spec.named_sections(
      "sides", part_spec("", {}, nullptr),
      [&geometry](const std::string& name, const Origin& origin) { return part_spec(name, origin, &geometry); },
      {.doc = "Parts of the sides of the box, by name, for conditions of their own."});
}

void complete_side_parts(Geometry& geometry) {
  const Box& box = geometry.box;
  if (!geometry.is_imported() && box.size().minCoeff() <= 0) return;  // validate_geometry says so
  for (SidePart& part : geometry.side_parts) {
    if (geometry.is_imported())
      throw InputError(part.origin, "'" + part.name + "' is a part of a side of a mesh file",
                       "the file holds its sides as groups of surfaces", "draw it into the file");
    if (std::ranges::count(box_sides, part.name) > 0)
      throw InputError(part.origin, "a part of a side is called '" + part.name + "'",
                       "that is the name of a whole side", "give it another name");
    for (int axis = 0; axis < dimension; ++axis) {
      if (part.low[axis] == -open) part.low[axis] = box.low[axis];
      if (part.high[axis] == open) part.high[axis] = box.high[axis];
      if (part.low[axis] < box.low[axis] || part.high[axis] > box.high[axis])
        throw InputError(part.origin, "'" + part.name + "' leaves its side along " + axis_names[axis],
                         "the box reaches from " + to_text(box.low) + " to " + to_text(box.high), "move it inside");
    }
  }
  for (const SidePart& one : geometry.side_parts)
    for (const SidePart& other : geometry.side_parts)
      if (&one < &other && overlap(one, other))
        throw InputError(other.origin, "'" + other.name + "' overlaps '" + one.name + "'",
                         "a place of a side has one condition", "let them end at one another");
}

}  // namespace sprekk
