// Probes of fields at all places.
#include "framework/scene/probe.hpp"

#include <gtest/gtest.h>

#include <cmath>

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

/// A field on a straight fracture of cells of one length, and what a probe of it says at a point.
struct OnFracture {
  Mesh mesh;
  FieldStore fields;
  Field* field = nullptr;

  OnFracture() : mesh(made()) {
    field = &fields.add(mesh, {.owner = "part",
                               .name = "walls",
                               .location = Location::fracture_cell,
                               .role = Role::derived(),
                               .unit = "m",
                               .doc = ""});
  }
  static Mesh made() {
    Geometry geometry = box(1, 1);
    FractureGeometry main;
    main.name = "main";
    main.points = {Point(0.2, 0.35), Point(0.8, 0.65)};
    geometry.fractures = {main};
    return generate_mesh(geometry, unstructured(0.1));
  }
  /// At a share of the fracture.
  double value(double share, const Vector& values, bool is_a_choice = false) {
    field->set_both(values);
    ProbeOptions options;
    options.of = is_a_choice ? "part.states" : "part.walls";
    options.at = Point(0.2, 0.35) + share * Point(0.6, 0.3);
    std::vector<OutputField> outputs;
    if (is_a_choice)
      outputs.push_back({.name = "part.states",
                         .unit = "1",
                         .location = Location::fracture_cell,
                         .values = values,
                         .is_a_choice = true});
    std::vector<Quantity> quantities;
    Probe("probe", options, mesh, fields, outputs).measure(quantities, outputs);
    return quantities.at(0).value;
  }
};

TEST(Probe, IsExactForQuadraticFieldsAlongAFracture) {
  OnFracture fracture;
  const int cells = fracture.mesh.fracture_cell_count();
  Vector values(cells);
  const auto quadratic_at = [](double share) { return 2 - share + 3 * share * share; };
  for (int i = 0; i < cells; ++i) values[i] = quadratic_at((i + 0.5) / cells);
  for (const double share : {0.31, 0.5, 0.5 + 1e-9, 0.62})
    EXPECT_NEAR(fracture.value(share, values), quadratic_at(share), 1e-8);
  Vector mirrored = values.reverse();
  EXPECT_NEAR(fracture.value(0.31, values), fracture.value(0.69, mirrored), 1e-10);
  EXPECT_NEAR(fracture.value(0.5, values), fracture.value(0.5, mirrored), 1e-10);
}

TEST(Probe, KeepsTheSignOfTheCellsAround) {
  OnFracture fracture;
  const int cells = fracture.mesh.fracture_cell_count(), open = cells / 2;
  Vector opening = Vector::Zero(cells);
  for (int i = open; i < cells; ++i) opening[i] = i - open + 1.0;
  const double between_closed = (open - 1.0) / cells;
  EXPECT_EQ(fracture.value(between_closed, opening), 0);
  EXPECT_EQ(fracture.value(between_closed, -opening), 0);
}

TEST(Probe, TakesStatesFromTheCell) {
  OnFracture fracture;
  Vector states(fracture.mesh.fracture_cell_count());
  for (int i = 0; i < states.size(); ++i) states[i] = i % 3;
  for (const double share : {0.03, 0.2, 0.41, 0.5, 0.77, 0.99}) {
    const double state = fracture.value(share, states, true);
    EXPECT_EQ(state, std::round(state)) << share;
  }
}

}  // namespace
}  // namespace sprekk::test
