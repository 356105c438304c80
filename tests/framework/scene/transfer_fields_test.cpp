// Values that go over to a mesh that has grown.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>

#include "framework/assembly/follows_mesh.hpp"
#include "framework/meshing/generate_mesh.hpp"
#include "framework/remeshing/extend_fractures.hpp"
#include "framework/scene/plane/change_mesh.hpp"
#include "framework/scene/plane/transferred_cells.hpp"
#include "tests/framework/remeshing/growth_checks.hpp"

namespace sprekk::test {
namespace {

constexpr double size = 0.02;

/// Two fractures; the second one grows at its first point, so that its cells and those of walls are renumbered.
struct Case {
  Mesh mesh;
  GrownMesh grown;
};
Case grown_at_first_point() {
  Geometry geometry = box(0, 1, 0, 1);
  geometry.fractures = {fracture("still", {{0.2, 0.2}, {0.4, 0.25}}), fracture("main", {{0.5, 0.5}, {0.7, 0.6}})};
  Mesh mesh = generate_mesh(geometry, {.size = 0.1, .fracture_size = size});
  GrownMesh grown = extend_fractures(mesh, {straight(mesh, 1, false, 3 * size, 0.4)},
                                     {.radius = 5 * size, .size = size, .growth = 0.3});
  return {std::move(mesh), std::move(grown)};
}

FieldSpec spec(Location location, int components = 1, bool is_amount = false) {
  FieldSpec spec{.owner = "part",
                 .name = "value",
                 .location = location,
                 .components = components,
                 .role = Role::unknown(BlockKind::interface),
                 .unit = "",
                 .doc = ""};
  spec.is_amount = is_amount;
  return spec;
}

/// The field after the transfer; before it, the new one has `start` everywhere.
struct Transferred {
  Vector accepted, now;
};
Transferred transfer(const Case& c, const FieldSpec& spec, const Vector& values, double start = -5) {
  FieldStore before, after;
  before.add(c.mesh, spec).set_both(values);
  before.at("part.value").set(Vector::Constant(values.size(), 1e30));  // only what has been accepted goes over
  Field& field = after.add(c.grown.mesh, spec);
  field.set_both(Vector::Constant(field.size(), start));
  transfer_fields(before, c.grown.change, c.mesh, c.grown.mesh, after);
  return {field.accepted(), field.now()};
}

/// Different in every digit.
Vector varied(int count) {
  Vector values(count);
  for (int i = 0; i < count; ++i) values[i] = 2 + std::sin(1 + 1.7 * i);
  return values;
}

TEST(TransferFields, ConstantsStay) {
  const Case c = grown_at_first_point();
  Vector values(2 * c.mesh.cell_count());
  for (int i = 0; i < c.mesh.cell_count(); ++i) values.segment<2>(2 * i) = Point(3e6, -0.7);
  const Transferred result = transfer(c, spec(Location::cell, 2), values);
  ASSERT_EQ(result.accepted.size(), 2 * c.grown.mesh.cell_count());
  for (int i = 0; i < c.grown.mesh.cell_count(); ++i) {
    EXPECT_NEAR(result.accepted[2 * i], 3e6, 1e-14 * 3e6);
    EXPECT_NEAR(result.accepted[2 * i + 1], -0.7, 1e-14);
  }
  EXPECT_EQ(result.now, result.accepted);
}

TEST(TransferFields, KeptCellsStayToTheBit) {
  const Case c = grown_at_first_point();
  ASSERT_FALSE(c.grown.change.new_cells.empty());
  for (const bool is_amount : {false, true}) {
    const Vector values = varied(2 * c.mesh.cell_count());
    const Vector result = transfer(c, spec(Location::cell, 2, is_amount), values).accepted;
    for (int i = 0; i < c.grown.mesh.cell_count(); ++i)
      if (const int from = c.grown.change.cell[i]; from != none) {
        EXPECT_EQ(Point(result.segment<2>(2 * i)), Point(values.segment<2>(2 * from)));
      }
  }
}

TEST(TransferFields, TotalsStay) {
  const Case c = grown_at_first_point();
  const Vector values = varied(2 * c.mesh.cell_count());
  // Of an amount, per component; of a density, times the areas.
  const Vector amounts = transfer(c, spec(Location::cell, 2, true), values).accepted;
  const Vector densities = transfer(c, spec(Location::cell, 2), values).accepted;
  for (const int component : {0, 1}) {
    double amount_before = 0, amount_after = 0, density_before = 0, density_after = 0;
    for (int i = 0; i < c.mesh.cell_count(); ++i) {
      amount_before += values[2 * i + component];
      density_before += c.mesh.cell_measure[i] * values[2 * i + component];
    }
    for (int i = 0; i < c.grown.mesh.cell_count(); ++i) {
      amount_after += amounts[2 * i + component];
      density_after += c.grown.mesh.cell_measure[i] * densities[2 * i + component];
    }
    EXPECT_NEAR(amount_after, amount_before, 1e-13 * amount_before);
    EXPECT_NEAR(density_after, density_before, 1e-13 * density_before);
  }
}

TEST(TransferFields, NewCellsTakeTheirShare) {
  // An amount in proportion to the area is one of a constant density, whatever the overlaps are; a mean is bounded by
  // the old cells below and around.
  const Case c = grown_at_first_point();
  Vector areas(c.mesh.cell_count());
  for (int i = 0; i < areas.size(); ++i) areas[i] = c.mesh.cell_measure[i];
  const Vector amounts = transfer(c, spec(Location::cell, 1, true), areas).accepted;
  for (int i = 0; i < c.grown.mesh.cell_count(); ++i)
    EXPECT_NEAR(amounts[i], c.grown.mesh.cell_measure[i], 1e-12 * c.grown.mesh.cell_measure[i]);
  const Vector values = varied(c.mesh.cell_count());
  const Vector means = transfer(c, spec(Location::cell), values).accepted;
  for (const int i : c.grown.change.new_cells) {
    double low = 1e30, high = -1e30;
    for (SparseMatrix::InnerIterator entry(c.grown.change.overlap, i); entry; ++entry)
      for (int other = 0; other < c.mesh.cell_count(); ++other) {
        const auto has = [&](int node) { return std::ranges::count(c.mesh.cell_nodes[other], node) > 0; };
        if (!std::ranges::any_of(c.mesh.cell_nodes[entry.col()], has)) continue;
        low = std::min(low, values[other]);
        high = std::max(high, values[other]);
      }
    EXPECT_GE(means[i], low - 1e-14);
    EXPECT_LE(means[i], high + 1e-14);
  }
}

TEST(TransferFields, WhatIsSmoothIsTransferredToSecondOrder) {
  // Means of a plane over new cells; with a mean for each old cell they would be off by the slope times half of a cell.
  const Case c = grown_at_first_point();
  const auto plane = [](const Point& x) { return 2e6 + 3e6 * x[0] - 1e6 * x[1]; };
  Vector values(c.mesh.cell_count());
  for (int i = 0; i < values.size(); ++i) values[i] = plane(c.mesh.cell_center[i]);
  const Vector means = transfer(c, spec(Location::cell), values).accepted;
  double off = 0, off_by_means = 0;
  for (const int i : c.grown.change.new_cells) {
    const double exact = plane(c.grown.mesh.cell_center[i]);
    double mean = 0;
    for (SparseMatrix::InnerIterator entry(c.grown.change.overlap, i); entry; ++entry)
      mean += entry.value() / c.grown.mesh.cell_measure[i] * values[entry.col()];
    off = std::max(off, std::abs(means[i] - exact));
    off_by_means = std::max(off_by_means, std::abs(mean - exact));
  }
  EXPECT_GT(off_by_means, 0);
  EXPECT_LT(off, 0.1 * off_by_means);
}

/// A part that knows what a field is within the cells of a mesh: linear on the n^2 triangles of each.
class Knowing : public Part, public FollowsMesh {
 public:
  Knowing(const Mesh& mesh, int n, double weight, const std::function<double(const Point&)>& value) {
    for (int cell = 0; cell < mesh.cell_count(); ++cell) {
      const Ring& ring = mesh.cell_nodes[cell];
      EXPECT_EQ(ring.size(), 3u);
      const Point &a = mesh.nodes[ring[0]], ab = mesh.nodes[ring[1]] - a, ac = mesh.nodes[ring[2]] - a;
      const auto at = [&](int i, int k) { return Point(a + double(i) / n * ab + double(k) / n * ac); };
      const auto add = [&](const Point& one, const Point& two, const Point& three) {
        pieces_[cell].push_back({{one, two, three}, {value(one), value(two), value(three)}, weight});
      };
      for (int i = 0; i < n; ++i)
        for (int k = 0; i + k < n; ++k) {
          add(at(i, k), at(i + 1, k), at(i, k + 1));
          if (i + k + 1 < n) add(at(i + 1, k), at(i + 1, k + 1), at(i, k + 1));
        }
    }
  }
  void begin_step(const StepTime&) override {}
  void assemble(Assembly&, const StepTime&) const override {}
  void add_known_within_cells(const Field& field, KnownWithinCells& known) const override {
    if (field.name() == "part.value") known.pieces.insert(pieces_.begin(), pieces_.end());
  }
  /// The means of the cells.
  Vector means() const {
    Vector means(pieces_.size());
    for (const auto& [cell, pieces] : pieces_) {
      means[cell] = 0;
      for (const LinearPiece& piece : pieces)
        means[cell] += (piece.values[0] + piece.values[1] + piece.values[2]) / 3 / pieces.size();
    }
    return means;
  }

 private:
  LinearPieces pieces_;
};

/// Around a tip at which sqrt(r) begins: new cells have its means, which linear functions in whole cells do not give.
TEST(TransferFields, WhatIsKnownWithinCellsGoesOver) {
  const Case c = grown_at_first_point();
  const Point tip(0.5, 0.5);
  const auto root = [&](const Point& x) { return std::sqrt((x - tip).norm()); };
  const auto moved = [&](double weight) {
    Knowing known(c.mesh, 8, weight, root);
    FieldStore before, after;
    before.add(c.mesh, spec(Location::cell)).set_both(known.means());
    Field& field = after.add(c.grown.mesh, spec(Location::cell));
    transfer_fields(before, c.grown.change, c.mesh, c.grown.mesh, after, {&known});
    return Vector(field.accepted());
  };
  const Vector exact = Knowing(c.grown.mesh, 64, 1, root).means(), old = Knowing(c.mesh, 8, 1, root).means();
  const Vector plain = transfer(c, spec(Location::cell), old).accepted, known = moved(1), half = moved(0.5);
  double off = 0, off_when_linear = 0, total = 0, total_before = 0;
  for (int i = 0; i < c.grown.mesh.cell_count(); ++i) {
    total += c.grown.mesh.cell_measure[i] * known[i];
    EXPECT_NEAR(half[i], (known[i] + plain[i]) / 2, 1e-14);
    if (const int from = c.grown.change.cell[i]; from != none) {
      EXPECT_EQ(known[i], old[from]);
      continue;
    }
    off = std::max(off, std::abs(known[i] - exact[i]));
    off_when_linear = std::max(off_when_linear, std::abs(plain[i] - exact[i]));
  }
  for (int i = 0; i < c.mesh.cell_count(); ++i) total_before += c.mesh.cell_measure[i] * old[i];
  EXPECT_NEAR(total, total_before, 1e-13 * total_before);
  EXPECT_LT(off, 0.01 * std::sqrt(size));
  EXPECT_GT(off_when_linear, 5 * off);
}

/// Beside a fracture from which a value falls on both sides, no cell has as much as the walls: only with the values
/// there are the cells at the walls inclined.
TEST(TransferFields, ValuesAtWallsGoOver) {
  const Case c = grown_at_first_point();
  const Point from(0.5, 0.5), along = Point(0.2, 0.1).normalized(), normal(-along[1], along[0]);
  const auto value = [&](const Point& x) { return 5 - std::abs(normal.dot(x - from)); };
  FieldStore before;
  Field& field = before.add(c.mesh, spec(Location::cell));
  Vector values(c.mesh.cell_count());
  for (int i = 0; i < values.size(); ++i) values[i] = value(c.mesh.cell_center[i]);
  field.set_both(values);
  KnownWithinCells known;
  const Fracture& main = c.mesh.fractures[1];
  for (int k = 0; k < main.cell_count; ++k)
    for (const int face : c.mesh.fracture_cells[main.first_cell + k].faces) known.at_faces[face] = 5;
  const Vector plain = transferred_cells(field, c.grown.change, c.mesh, c.grown.mesh),
               better = transferred_cells(field, c.grown.change, c.mesh, c.grown.mesh, known);
  double off = 0, off_without = 0, total = 0, total_before = 0;
  for (int i = 0; i < c.grown.mesh.cell_count(); ++i) {
    total += c.grown.mesh.cell_measure[i] * better[i];
    EXPECT_LE(better[i], 5);
    const Point& x = c.grown.mesh.cell_center[i];
    const double place = along.dot(x - from);
    // Where the value is linear in all cells around.
    if (place < 1.5 * size || place > 0.2 || c.grown.change.cell[i] != none) continue;
    off = std::max(off, std::abs(better[i] - value(x)));
    off_without = std::max(off_without, std::abs(plain[i] - value(x)));
  }
  for (int i = 0; i < c.mesh.cell_count(); ++i) total_before += c.mesh.cell_measure[i] * values[i];
  EXPECT_NEAR(total, total_before, 1e-13 * total_before);
  EXPECT_GT(off_without, 0.02 * size);
  EXPECT_LT(off, 1e-12) << off_without;
}

/// Where pieces have nothing in common with a new cell, as with a part that is a line but for rounding.
TEST(TransferFields, PiecesThatAreElsewhereCountForNothing) {
  const Case c = grown_at_first_point();
  FieldStore before;
  Field& field = before.add(c.mesh, spec(Location::cell));
  field.set_both(varied(c.mesh.cell_count()));
  KnownWithinCells known;
  for (int i = 0; i < c.mesh.cell_count(); i += 2)
    known.pieces[i] = {{{Point(5, 5), Point(6, 5), Point(5, 6)}, {1e9, 1e9, 1e9}, 1}};
  const Vector plain = transferred_cells(field, c.grown.change, c.mesh, c.grown.mesh);
  EXPECT_EQ(transferred_cells(field, c.grown.change, c.mesh, c.grown.mesh, known), plain);
}

/// The old fracture cell with the same middle, found by place.
int same_place(const Mesh& old, const FractureCell& cell) {
  for (int i = 0; i < old.fracture_cell_count(); ++i)
    if ((old.fracture_cells[i].center - cell.center).norm() < 1e-12) return i;
  return none;
}

TEST(TransferFields, FracturesAndWallsFollowAGrowthAtTheFirstPoint) {
  const Case c = grown_at_first_point();
  const Vector cells = varied(2 * c.mesh.fracture_cell_count()), walls = varied(2 * c.mesh.wall_count());
  const Vector new_cells = transfer(c, spec(Location::fracture_cell, 2), cells).accepted;
  const Vector new_walls = transfer(c, spec(Location::wall, 2), walls).accepted;
  int kept = 0, moved = 0;
  for (int i = 0; i < c.grown.mesh.fracture_cell_count(); ++i) {
    const FractureCell& cell = c.grown.mesh.fracture_cells[i];
    const int from = same_place(c.mesh, cell);
    if (from == none) {
      EXPECT_EQ(Point(new_cells.segment<2>(2 * i)), Point(-5, -5));
      EXPECT_EQ(Eigen::Vector4d(new_walls.segment<4>(4 * i)), Eigen::Vector4d::Constant(-5));
      continue;
    }
    ++kept;
    moved += from != i ? 1 : 0;
    EXPECT_EQ(Point(new_cells.segment<2>(2 * i)), Point(cells.segment<2>(2 * from)));
    for (const int side : {0, 1}) {
      // The wall on the same side: its normal is the same.
      const Point normal = c.grown.mesh.face_normal[cell.faces[side]];
      const int old_side = normal.dot(c.mesh.face_normal[c.mesh.fracture_cells[from].faces[0]]) > 0 ? 0 : 1;
      EXPECT_EQ(Point(new_walls.segment<2>(2 * (2 * i + side))), Point(walls.segment<2>(2 * (2 * from + old_side))));
    }
  }
  EXPECT_EQ(kept, c.mesh.fracture_cell_count());
  EXPECT_EQ(c.grown.mesh.fracture_cell_count() - kept, 3);
  EXPECT_EQ(moved, c.mesh.fractures[1].cell_count);
}

TEST(TransferFields, FracturePointsFollow) {
  const Case c = grown_at_first_point();
  const Vector values = varied(static_cast<int>(c.mesh.ridges.size()));
  const Vector result = transfer(c, spec(Location::ridge), values).accepted;
  int fresh = 0;
  for (std::size_t i = 0; i < c.grown.mesh.ridges.size(); ++i) {
    int from = none;
    for (std::size_t k = 0; k < c.mesh.ridges.size(); ++k)
      if (c.mesh.ridges[k].center == c.grown.mesh.ridges[i].center) from = static_cast<int>(k);
    fresh += from == none ? 1 : 0;
    EXPECT_EQ(result[static_cast<int>(i)], from == none ? -5 : values[from]);
  }
  EXPECT_EQ(fresh, 3);
}

TEST(TransferFields, LinearFieldsOnNodesAndFacesStay) {
  const Case c = grown_at_first_point();
  const auto linear = [](const std::vector<Point>& places) {
    Vector values(2 * static_cast<int>(places.size()));
    for (std::size_t i = 0; i < places.size(); ++i)
      values.segment<2>(2 * static_cast<int>(i)) =
          Point(3 - 0.7 * places[i].x() + 2 * places[i].y(), 1 + places[i].x());
    return values;
  };
  const Vector on_nodes = transfer(c, spec(Location::node, 2), linear(c.mesh.nodes)).accepted;
  ASSERT_EQ(on_nodes.size(), 2 * c.grown.mesh.node_count());
  EXPECT_LT((on_nodes - linear(c.grown.mesh.nodes)).lpNorm<Eigen::Infinity>(), 1e-13);
  const Vector on_faces = transfer(c, spec(Location::face, 2), linear(c.mesh.face_center)).accepted;
  ASSERT_EQ(on_faces.size(), 2 * c.grown.mesh.face_count());
  EXPECT_LT((on_faces - linear(c.grown.mesh.face_center)).lpNorm<Eigen::Infinity>(), 1e-13);
}

TEST(TransferFields, NodesAndFacesOfKeptCellsStayToTheBit) {
  const Case c = grown_at_first_point();
  const Vector nodes = varied(c.mesh.node_count()), faces = varied(c.mesh.face_count());
  const Vector new_nodes = transfer(c, spec(Location::node), nodes).accepted;
  const Vector new_faces = transfer(c, spec(Location::face), faces).accepted;
  int kept = 0;
  for (int cell = 0; cell < c.grown.mesh.cell_count(); ++cell) {
    const int from = c.grown.change.cell[cell];
    if (from == none) continue;
    ++kept;
    for (int k = 0; k < c.grown.mesh.cell_nodes[cell].size(); ++k) {
      EXPECT_EQ(new_nodes[c.grown.mesh.cell_nodes[cell][k]], nodes[c.mesh.cell_nodes[from][k]]);
      EXPECT_EQ(new_faces[c.grown.mesh.cell_faces[cell][k]], faces[c.mesh.cell_faces[from][k]]);
    }
  }
  EXPECT_GT(kept, c.mesh.cell_count() / 2);
}

TEST(TransferFields, BothWallsOfAGrownPathStartFromTheContinuousField) {
  const Case c = grown_at_first_point();
  Vector values(c.mesh.node_count());
  for (int i = 0; i < c.mesh.node_count(); ++i) values[i] = c.mesh.nodes[i].x() * c.mesh.nodes[i].y();
  const Vector result = transfer(c, spec(Location::node), values).accepted;
  int grown = 0;
  for (int i = 0; i < c.grown.mesh.fracture_cell_count(); ++i) {
    if (c.grown.change.fracture_cell[i] != none) continue;
    ++grown;
    const auto [plus, minus] = c.grown.mesh.fracture_cells[i].faces;
    for (const int k : {0, 1})  // faces of the two walls run in opposite directions
      EXPECT_NEAR(result[c.grown.mesh.face_nodes[plus][k]], result[c.grown.mesh.face_nodes[minus][1 - k]], 1e-15);
  }
  EXPECT_EQ(grown, 3);
}

}  // namespace
}  // namespace sprekk::test
