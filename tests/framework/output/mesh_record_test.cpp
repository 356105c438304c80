#include "framework/output/mesh_record.hpp"

#include <algorithm>

#include "framework/meshing/generate_mesh.hpp"
#include "tests/framework/output/small_case.hpp"

namespace sprekk {
namespace {

class MeshRecord : public TemporaryFolder {
 protected:
  Mesh round_trip(const Mesh& mesh) const {
    Hdf5Writer writer(folder / "mesh.h5");
    write_mesh(writer, mesh);
    writer.close();
    return read_mesh(Hdf5Reader(folder / "mesh.h5"));
  }
};

TEST_F(MeshRecord, TrianglesBesideQuadrilateralsComeBack) {
  Geometry geometry;
  geometry.box = {{0, 0}, {1, 1}, {}};
  const Mesh mesh = generate_mesh(geometry, {.shape = MeshOptions::Shape::quadrilaterals, .size = 0.2});
  const auto corners = [&](int count) {
    return std::count_if(mesh.cell_nodes.begin(), mesh.cell_nodes.end(),
                         [&](const Ring& cell) { return cell.size() == count; });
  };
  ASSERT_GT(corners(3), 0);
  ASSERT_GT(corners(4), 0);
  const Mesh read = round_trip(mesh);
  EXPECT_EQ(read.cell_nodes, mesh.cell_nodes);
  EXPECT_EQ(read.cell_faces, mesh.cell_faces);
  EXPECT_EQ(read.cell_center, mesh.cell_center);
  EXPECT_TRUE(is_same_mesh(read, mesh));
}

TEST_F(MeshRecord, EveryMemberComesBackToTheBit) {
  Mesh mesh = small_mesh();
  for (Point& node : mesh.nodes) node /= 3;  // coordinates with all bits in use; geometry is stored, not recomputed
  for (int i = 0; i < mesh.cell_count(); ++i) mesh.cell_rank[i] = i % 3;
  const Mesh read = round_trip(mesh);

  EXPECT_EQ(read.nodes, mesh.nodes);
  EXPECT_EQ(read.cell_nodes, mesh.cell_nodes);
  EXPECT_EQ(read.cell_faces, mesh.cell_faces);
  EXPECT_EQ(read.face_nodes, mesh.face_nodes);
  EXPECT_EQ(read.face_cells, mesh.face_cells);
  EXPECT_EQ(read.cell_center, mesh.cell_center);
  EXPECT_EQ(read.cell_measure, mesh.cell_measure);
  EXPECT_EQ(read.face_center, mesh.face_center);
  EXPECT_EQ(read.face_measure, mesh.face_measure);
  EXPECT_EQ(read.face_normal, mesh.face_normal);
  EXPECT_EQ(read.node_cells.offsets, mesh.node_cells.offsets);
  EXPECT_EQ(read.node_cells.items, mesh.node_cells.items);
  EXPECT_EQ(read.node_faces.offsets, mesh.node_faces.offsets);
  EXPECT_EQ(read.node_faces.items, mesh.node_faces.items);
  EXPECT_EQ(read.face_side, mesh.face_side);
  EXPECT_EQ(read.side_names, mesh.side_names);
  EXPECT_EQ(read.cell_region, mesh.cell_region);
  EXPECT_EQ(read.region_names, mesh.region_names);
  EXPECT_EQ(read.face_fracture_cell, mesh.face_fracture_cell);
  EXPECT_EQ(read.cell_rank, mesh.cell_rank);

  ASSERT_EQ(mesh.fractures.size(), 2u);
  ASSERT_EQ(read.fractures.size(), mesh.fractures.size());
  for (std::size_t i = 0; i < mesh.fractures.size(); ++i) {
    EXPECT_EQ(read.fractures[i].name, mesh.fractures[i].name);
    EXPECT_EQ(read.fractures[i].first_cell, mesh.fractures[i].first_cell);
    EXPECT_EQ(read.fractures[i].cell_count, mesh.fractures[i].cell_count);
  }
  ASSERT_EQ(mesh.fracture_cell_count(), 4);
  ASSERT_EQ(read.fracture_cell_count(), mesh.fracture_cell_count());
  for (int i = 0; i < mesh.fracture_cell_count(); ++i) {
    const FractureCell &a = read.fracture_cells[i], &b = mesh.fracture_cells[i];
    EXPECT_EQ(a.fracture, b.fracture);
    EXPECT_EQ(a.faces, b.faces);
    EXPECT_EQ(a.ridges, b.ridges);
    EXPECT_EQ(a.center, b.center);
    EXPECT_EQ(a.measure, b.measure);
    EXPECT_EQ(a.normal, b.normal);
    EXPECT_EQ(a.tangents, b.tangents);
  }
  ASSERT_EQ(read.ridges.size(), mesh.ridges.size());
  for (std::size_t i = 0; i < mesh.ridges.size(); ++i) {
    EXPECT_EQ(read.ridges[i].center, mesh.ridges[i].center);
    EXPECT_EQ(read.ridges[i].cells, mesh.ridges[i].cells);
    EXPECT_EQ(read.ridges[i].kind, mesh.ridges[i].kind);
    EXPECT_EQ(read.ridges[i].side, mesh.ridges[i].side);
  }
}

TEST_F(MeshRecord, AMeshThatIsReadHasAVersionOfItsOwn) {
  const Mesh mesh = small_mesh();
  const Mesh first = round_trip(mesh), second = round_trip(mesh);
  EXPECT_NE(first.version, mesh.version);
  EXPECT_NE(first.version, second.version);
}

TEST_F(MeshRecord, ContradictingArraysAreRefused) {
  Mesh mesh = small_mesh();
  mesh.cell_measure.pop_back();
  EXPECT_THROW(round_trip(mesh), Hdf5Error);
  mesh = small_mesh();
  mesh.node_cells.offsets[1] = 1000;
  EXPECT_THROW(round_trip(mesh), Hdf5Error);
}

TEST_F(MeshRecord, TellsTheSameMeshFromAnother) {
  const Mesh mesh = small_mesh();
  EXPECT_TRUE(is_same_mesh(mesh, round_trip(mesh)));
  Mesh other = mesh;
  other.nodes[3].x() = std::nextafter(other.nodes[3].x(), 2);
  EXPECT_FALSE(is_same_mesh(mesh, other));
  other = mesh;
  other.fracture_cells.pop_back();
  EXPECT_FALSE(is_same_mesh(mesh, other));
}

}  // namespace
}  // namespace sprekk
