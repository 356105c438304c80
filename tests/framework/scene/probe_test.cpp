// Probes of fields at all places.
#include "framework/scene/probe.hpp"

#include <gtest/gtest.h>

#include "framework/config/input_error.hpp"
#include "tests/components/meshes.hpp"

namespace sprekk::test {
namespace {

double linear(const Point& x) { return 3 - 0.7 * x[0] + 2 * x[1]; }

/// Fields with linear values on cells, nodes and faces of a square of 1 m.
struct Probed {
  Mesh mesh = fractured_square();
  FieldStore fields;

  Probed() {
    const auto add = [&](Location location, const char* name, const std::vector<Point>& places) {
      Field& field = fields.add(
          mesh, {.owner = "part", .name = name, .location = location, .role = Role::derived(), .unit = "m", .doc = ""});
      Vector values(field.size());
      for (std::size_t i = 0; i < places.size(); ++i) values[static_cast<int>(i)] = linear(places[i]);
      field.set_both(values);
    };
    add(Location::cell, "cells", mesh.cell_center);
    add(Location::node, "nodes", mesh.nodes);
    add(Location::face, "faces", mesh.face_center);
    fields.add(mesh, {.owner = "part",
                      .name = "walls",
                      .location = Location::wall,
                      .role = Role::derived(),
                      .unit = "m",
                      .doc = ""});
  }
  double value(const ProbeOptions& options) const {
    std::vector<Quantity> quantities;
    Probe("probe", options, mesh, fields).measure(quantities);
    return quantities.at(0).value;
  }
};

TEST(Probe, IsExactForLinearFieldsOnCellsNodesAndFaces) {
  const Probed probed;
  for (const char* of : {"part.cells", "part.nodes", "part.faces"}) {
    ProbeOptions at, mean;
    at.of = mean.of = of;
    at.at = Point(0.37, 0.56);
    mean.take = "mean";
    EXPECT_NEAR(probed.value(at), linear(*at.at), 1e-12) << of;
    EXPECT_NEAR(probed.value(mean), linear(Point(0.5, 0.5)), 1e-12) << of;
  }
  ProbeOptions largest;
  largest.of = "part.nodes";
  largest.take = "largest";
  EXPECT_NEAR(probed.value(largest), linear(Point(0, 1)), 1e-14);
  ProbeOptions walls;
  walls.of = "part.walls";
  walls.take = "mean";
  EXPECT_THROW(probed.value(walls), InputError);
}

}  // namespace
}  // namespace sprekk::test
