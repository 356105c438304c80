#include "framework/schedule/relative_change.hpp"

#include <gtest/gtest.h>

#include "framework/field/field_store.hpp"
#include "framework/meshing/generate_mesh.hpp"

namespace sprekk {
namespace {

Mesh two_triangles() {
  Geometry geometry;
  geometry.box.low = Point(0, 0);
  geometry.box.high = Point(1, 1);
  MeshOptions options;
  options.kind = MeshOptions::Kind::structured;
  options.cells = {1, 1};
  return generate_mesh(geometry, options);
}

TEST(RelativeChange, IsTheLargestOfAnyUnitAndFieldsOfOneUnitShareTheirScale) {
  const Mesh mesh = two_triangles();
  FieldStore fields;
  const auto add = [&](const char* name, const char* unit) -> Field& {
    return fields.add(mesh, {.owner = "x",
                             .name = name,
                             .location = Location::cell,
                             .role = Role::unknown(BlockKind::interface),
                             .unit = unit,
                             .doc = ""});
  };
  Field &large = add("large", "m"), &small = add("small", "m"), &pressure = add("pressure", "Pa");
  const std::vector<const Field*> all = {&large, &small, &pressure};
  EXPECT_EQ(relative_change(all), 0);
  large.set_both(Vector::Constant(mesh.cell_count(), -4));
  small.set(Vector::Constant(mesh.cell_count(), 1));  // from 0
  EXPECT_DOUBLE_EQ(relative_change(all), 0.25);
  pressure.set_both(Vector::Constant(mesh.cell_count(), 10));
  pressure.set(Vector::Constant(mesh.cell_count(), 5));  // the scale is what it was
  EXPECT_DOUBLE_EQ(relative_change(all), 0.5);
}

}  // namespace
}  // namespace sprekk
