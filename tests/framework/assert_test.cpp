// Assertions fire in builds that have them, and cost nothing in others.
#include "framework/assert.hpp"

#include <gtest/gtest.h>

#include <type_traits>
#include <vector>

#include "framework/assembly/assembly.hpp"
#include "framework/assembly/operator.hpp"
#include "framework/field/field_store.hpp"
#include "framework/invariants.hpp"
#include "framework/mesh/build_mesh.hpp"
#include "framework/mesh/expect_sound_mesh.hpp"

namespace sprekk {
namespace {

#ifdef SPREKK_ASSERTIONS

TEST(AssertDeathTest, SaysExpressionValuesFileAndLine) {
  const int cell = 7, cells = 4;
  EXPECT_DEATH(SPREKK_EXPECT(cell < cells, cell, cells),
               "assert_test.cpp:[0-9]+: a broken precondition: cell < cells \\(cell, cells = 7, 4\\)");
  EXPECT_DEATH(SPREKK_ASSERT(cells == cell), "assert_test.cpp:[0-9]+: a broken invariant: cells == cell");
  SPREKK_ASSERT(cell > cells, cell);
}

Mesh two_cells() {
  RawMesh raw;
  raw.nodes = {{0, 0}, {1, 0}, {1, 1}, {0, 1}};
  raw.cells = {Ring(0, 1, 2), Ring(0, 2, 3)};
  raw.regions = {0, 0};
  raw.region_names = {"all"};
  raw.side_names = {"outside"};
  for (int k = 0; k < 4; ++k) raw.boundary_faces.push_back({{k, (k + 1) % 4}, 0});
  return build_mesh(raw);
}

FieldSpec unknown(int components) {
  return {.owner = "part",
          .name = "value",
          .location = Location::cell,
          .components = components,
          .role = Role::unknown(BlockKind::interface),
          .unit = "",
          .doc = ""};
}

// What follows went on without a sound before.

TEST(AssertDeathTest, FiresWhereAFieldIsNoNumberWhenItIsAccepted) {
  FieldStore fields;
  fields.add(two_cells(), unknown(1)).set(Vector::Constant(2, std::nan("")));
  EXPECT_DEATH(fields.accept(), "field_store.cpp:[0-9]+: a broken precondition: .*part.value");
}

TEST(AssertDeathTest, FiresForAMeshWhoseCellHasNoArea) {
  Mesh mesh = two_cells();
  expect_sound(mesh);
  mesh.cell_measure[1] = 0;
  EXPECT_DEATH(expect_sound(mesh),
               "a broken invariant: mesh.cell_measure.cell. > 0 .cell, mesh.cell_measure.cell. = 1, 0");
}

TEST(AssertDeathTest, FiresForWeightsOfTheWrongLength) {
  const Field field(unknown(1), 2);
  Assembly assembly({&field}, Assembly::Request::residual);
  const Operator identity(diagonal_matrix(Vector::Ones(2)));
  const Vector weights = Vector::Ones(1);
  EXPECT_DEATH(assembly.linear(field, identity, field, 1, &weights), "assembly.cpp:[0-9]+: a broken precondition");
}

TEST(AssertDeathTest, FiresForAnExchangeThatLosesSomething) {
  SparseMatrix entries(2, 2), leaving(2, 2);
  entries.insert(0, 0) = 1;
  entries.insert(1, 0) = -0.5;
  EXPECT_DEATH(Operator(entries, leaving), "columns_add_up_alike");
  leaving.insert(0, 0) = 0.5;
  Operator(entries, leaving);
}

TEST(AssertDeathTest, StandardContainersLookAtIndices) {
  const std::vector<int> two = {1, 2};
  volatile std::size_t beyond = 2;
  EXPECT_DEATH(static_cast<void>(two[beyond]), "");
}

#else

TEST(Assert, EvaluatesNothingInOtherBuilds) {
  int evaluated = 0;
  SPREKK_ASSERT(++evaluated > 10);
  SPREKK_EXPECT(++evaluated > 10, evaluated);
  EXPECT_EQ(evaluated, 0);
}

#endif

TEST(Invariants, OfLists) {
  EXPECT_TRUE(is_index(0, 1));
  EXPECT_FALSE(is_index(1, 1));
  EXPECT_FALSE(is_index(-1, 1));
  EXPECT_TRUE(are_indices(std::vector<int>{0, 2, 1}, 3));
  EXPECT_FALSE(are_indices(std::vector<int>{0, 3}, 3));
  EXPECT_TRUE(is_ascending(std::vector<int>{}));
  EXPECT_TRUE(is_ascending(std::vector<double>{1, 2, 3}));
  EXPECT_FALSE(is_ascending(std::vector<double>{1, 2, 2}));
}

TEST(Invariants, OfMatrices) {
  Eigen::MatrixXd matrix(2, 2);
  matrix << 1, 2, 2, 1;
  EXPECT_TRUE(is_symmetric(matrix));
  matrix(0, 1) += 1e-6;
  EXPECT_FALSE(is_symmetric(matrix));
  EXPECT_FALSE(is_symmetric(Eigen::MatrixXd::Zero(2, 3)));
  SparseMatrix sparse(2, 2);
  sparse.insert(0, 1) = 1;
  EXPECT_FALSE(is_well_formed(sparse));
  sparse.makeCompressed();
  EXPECT_TRUE(is_well_formed(sparse));
  EXPECT_TRUE(is_finite(sparse));
  sparse.coeffRef(0, 1) = HUGE_VAL;
  EXPECT_FALSE(is_finite(sparse));
}

}  // namespace
}  // namespace sprekk
