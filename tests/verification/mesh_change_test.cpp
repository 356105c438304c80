// What a change of the mesh costs in a scene, and that it costs no bit of the answer.
#include <gtest/gtest.h>

#include <algorithm>
#include <cstring>

#include "components/capabilities/matrix_fluid.hpp"
#include "components/capabilities/poroelastic_rock.hpp"
#include "framework/assembly/counts_work.hpp"
#include "framework/scene/plane/change_mesh.hpp"
#include "tests/verification/scene_run.hpp"
#include "tests/verification/values_of_paper.hpp"

namespace sprekk::testing {
namespace {

bool same_bits(const SparseMatrix& a, const SparseMatrix& b) {
  const auto same = [](const auto* x, const auto* y, Eigen::Index count) {
    return std::memcmp(x, y, count * sizeof *x) == 0;
  };
  return a.rows() == b.rows() && a.cols() == b.cols() && a.nonZeros() == b.nonZeros() &&
         same(a.outerIndexPtr(), b.outerIndexPtr(), a.rows() + 1) &&
         same(a.innerIndexPtr(), b.innerIndexPtr(), a.nonZeros()) && same(a.valuePtr(), b.valuePtr(), a.nonZeros());
}

void expect_same(const LinearExpression& a, const LinearExpression& b) {
  ASSERT_EQ(a.terms.size(), b.terms.size());
  EXPECT_EQ(a.constant, b.constant);
  for (std::size_t i = 0; i < a.terms.size(); ++i)
    EXPECT_TRUE(same_bits(a.terms[i].matrix.entries(), b.terms[i].matrix.entries())) << i;
}

template <class Capability>
const Capability& the(const Model& model) {
  for (const auto& component : model.components())
    if (const auto* found = dynamic_cast<const Capability*>(component.get())) return *found;
  throw std::logic_error("no component has the capability");
}

long count(const Model& model, const std::string& name) {
  for (const auto* part : parts_with<CountsWork>(model.parts())) {
    const auto counts = part->counts();
    if (const auto found = counts.find(name); found != counts.end()) return found->second;
  }
  return 0;
}

/// The scene of section 5.2 of the paper shortly after its start, and again with one wing of 20 mm.
MeshChangeResult grow_a_wing(SceneRun& run) {
  run.run_until(200);
  const Mesh& mesh = run.mesh();
  const Fracture& fracture = mesh.fractures[0];
  const int end = mesh.fracture_cells[fracture.first_cell + fracture.cell_count - 1].ridges[1];
  const Point tip = mesh.ridges[end].center;
  return change_mesh(run.model(), 0, grow_mesh(run.model(), 0, {{0, true, {tip + Point(0.018, -0.008)}}}),
                     {-3600, 3600, run.time()});
}

TEST(ChangeOfMesh, HasTheBitsOfAModelThatIsBuiltOnTheNewMesh) {
  SceneRun run("paper/wing_cracks.yaml", with_values_of_paper({{"schedule.1.update", "after_step"}}));
  const MeshChangeResult changed = grow_a_wing(run);
  // As a restart does.
  Model fresh(run.model().scene(), changed.model->mesh());
  begin_step(fresh.parts(), {-3600, 3600, run.time()});
  for (const std::string name : {"stress discretizations: cells", "flux discretizations: cells"}) {
    EXPECT_EQ(count(fresh, name), fresh.mesh().cell_count());
    EXPECT_LT(count(*changed.model, name), fresh.mesh().cell_count() / 2);
  }
  expect_same(the<PoroelasticRock>(*changed.model).volume_change(), the<PoroelasticRock>(fresh).volume_change());
  expect_same(the<RockWalls>(*changed.model).displacement_jump(), the<RockWalls>(fresh).displacement_jump());
  expect_same(the<MatrixWalls>(*changed.model).wall_pressure(), the<MatrixWalls>(fresh).wall_pressure());
}

TEST(ChangeOfMesh, DiscretizesNothingFarFromTheWing) {
  // The same fracture with about the same cells around it, in squares of 2 m and of 4 m.
  for (const std::string box : {"{x: [0 m, 2 m], y: [0 m, 2 m]}", "{x: [-1 m, 3 m], y: [-1 m, 3 m]}"}) {
    SceneRun run("paper/wing_cracks.yaml", with_values_of_paper({{"mesh.size", "80 mm"},
                                                                 {"geometry.box", box},
                                                                 {"output.probes", "{}"},
                                                                 {"schedule.1.update", "after_step"}}));
    const MeshChangeResult changed = grow_a_wing(run);
    const Mesh& mesh = changed.model->mesh();
    // The cavity reaches 0.1 m from the wing, or 0.2 m when a larger one gives better angles; then there are three
    // rings of cells: those next to it, those that share a row with their nodes, and those that touch these.
    const Point tip = mesh.fracture_cells.back().center;
    const double reach = 0.2 + 3 * 0.08;
    const long near = std::count_if(mesh.cell_center.begin(), mesh.cell_center.end(),
                                    [&](const Point& center) { return (center - tip).norm() < reach; });
    EXPECT_GT(count(*changed.model, "stress discretizations: cells"), 0);
    for (const std::string name : {"stress discretizations: cells", "flux discretizations: cells"})
      EXPECT_LT(count(*changed.model, name), near) << mesh.cell_count() << " cells in all";
  }
}

}  // namespace
}  // namespace sprekk::testing
