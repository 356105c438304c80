// The state on a new mesh around tips that grow differs from that before by no more than the discretization error.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <memory>
#include <optional>
#include <stdexcept>
#include <string>
#include <vector>

#include "framework/run/plane/trial_meshes.hpp"
#include "tests/verification/scene_run.hpp"
#include "tests/verification/values_of_paper.hpp"

namespace sprekk::testing {
namespace {

constexpr double hour = 3600, toughness = 0.7e6;  // s, Pa sqrt(m)

/// Whose steps, increments and sizes the wings of section 5.2 of the paper have.
enum class Values { of_scene, of_paper };

/// These wings, turned with their fracture by an angle.
std::vector<Override> wings(const std::string& angle, Values values) {
  const std::vector<Override> turned = {{"geometry.fractures.main.angle", angle},
                                        {"couplers.4.propagation_threshold", "0.25"}};
  return values == Values::of_paper ? with_values_of_paper(turned) : turned;
}

/// The accepted state on its mesh, as after a restart, of a scene with the same fields.
std::unique_ptr<Model> restarted(const Model& model, const Scene& scene) {
  auto again = std::make_unique<Model>(scene, model.mesh());
  for (const auto& field : again->fields().all()) field->set_both(model.fields().at(field->name()).accepted());
  again->restore_extra_state(model.extra_state());
  return again;
}

double quantity(const Model& model, const std::string& name) {
  for (const Quantity& quantity : model.quantities())
    if (quantity.name == name) return quantity.value;
  throw std::out_of_range(name);
}

/// K_eq over the toughness, of both tips, on fine levels that are made for the present state.
std::array<double, 2> loads(Model& model, const StepTime& step) {
  begin_step(model.parts(), step);
  model.growing()[0]->component().examine(step);
  return {quantity(model, "tips.main_first.K_eq") / toughness, quantity(model, "tips.main_last.K_eq") / toughness};
}

/// The paths of a step that begins here, with the tips where they are.
std::vector<PathExtension> paths_at_rest(const Model& model, const StepTime& step) {
  const std::unique_ptr<FrontSearch> search = model.growing()[0]->component().search_front(step, true, true);
  if (!search) return {};
  std::vector<PathExtension> paths = search->paths();
  for (PathExtension& path : paths) {
    const Fracture& fracture = model.mesh().fractures[path.fracture];
    const int last = path.at_end ? fracture.first_cell + fracture.cell_count - 1 : fracture.first_cell;
    const int point = model.mesh().fracture_cells[last].ridges[path.at_end ? 1 : 0];
    path.points.back() = model.mesh().ridges[point].center;
  }
  return paths;
}

/// For each centre the one at the same place, or none.
template <class Centers>
std::vector<int> same_places(const Centers& before, const Centers& after) {
  std::vector<int> origin(after.size(), none);
  for (std::size_t i = 0; i < after.size(); ++i)
    for (std::size_t j = 0; j < before.size() && origin[i] == none; ++j)
      if (before[j] == after[i]) origin[i] = static_cast<int>(j);
  return origin;
}

std::vector<Point> middles_of_fracture_cells(const Mesh& mesh) {
  std::vector<Point> middles;
  for (const FractureCell& cell : mesh.fracture_cells) middles.push_back(cell.center);
  return middles;
}

/// The largest difference of components of a field on kept entities, over the largest value.
double change_of(const Field& before, const Field& after, const std::vector<int>& origin) {
  const int width = before.spec().components;
  double largest = 0;
  for (std::size_t i = 0; i < origin.size(); ++i)
    if (origin[i] != none)
      largest = std::max(largest,
                         (after.now().segment(width * i, width) - before.accepted().segment(width * origin[i], width))
                             .lpNorm<Eigen::Infinity>());
  return largest / before.accepted().lpNorm<Eigen::Infinity>();
}

/// How far from the last cell the point lies at which a path divides it, over the length of the path.
double bend(const Mesh& mesh, const std::vector<PathExtension>& paths) {
  double largest = 0;
  for (const PathExtension& path : paths) {
    if (path.points.size() != 2) continue;
    const Fracture& fracture = mesh.fractures[path.fracture];
    const int last = path.at_end ? fracture.first_cell + fracture.cell_count - 1 : fracture.first_cell;
    const Point anchor = mesh.ridges[mesh.fracture_cells[last].ridges[path.at_end ? 0 : 1]].center;
    const Point chord = path.points[1] - anchor, part = path.points[0] - anchor;
    largest = std::max(largest, std::abs(chord[0] * part[1] - chord[1] * part[0]) / chord.squaredNorm());
  }
  return largest;
}

/// How the state changes when tips at rest get other cells around them, and one second is solved with everything free.
struct Kick {
  double bend;  ///< of what has parted, over the length of the last cell; 0 where no cell is divided
  double load, slip, pressure;
};

std::optional<Kick> kick_of(SceneRun& run, TrialMeshes::Cells cells) {
  const double time = run.time();
  const StepTime last{time - hour, hour, time}, next{time, 1, time + 1};
  const std::unique_ptr<Model> before = restarted(run.model(), run.model().scene());
  const std::array<double, 2> old = loads(*before, last);
  const std::vector<PathExtension> paths = paths_at_rest(*before, {time, hour, time + hour});
  TrialMeshes meshes(*before, 0, time, {}, {});
  if (paths.empty() || !meshes.rest(paths, cells)) return std::nullopt;
  Model& after = meshes.base();
  const std::vector<int> cell = same_places(before->mesh().cell_center, after.mesh().cell_center),
                         fracture_cell = same_places(middles_of_fracture_cells(before->mesh()),
                                                     middles_of_fracture_cells(after.mesh()));
  const auto moves = [&](const std::string& field, const std::vector<int>& origin) {
    return change_of(before->fields().at(field), after.fields().at(field), origin);
  };
  // Other cells alone change nothing on the walls.
  EXPECT_LT(moves("contact.jump", fracture_cell), 1e-12);
  EXPECT_LT(moves("contact.traction", fracture_cell), 1e-12);
  EXPECT_LT(moves("conduit.pressure", fracture_cell), 1e-12);
  before->growing()[0]->component().prepare(after.growing()[0]->component());
  after.growing()[0]->choose(GrowStep::Holding::never);
  EXPECT_TRUE(after.attempt(next).converged);
  const std::array<double, 2> now = loads(after, next);
  return Kick{bend(before->mesh(), paths), std::max(std::abs(now[0] / old[0] - 1), std::abs(now[1] / old[1] - 1)),
              moves("contact.jump", fracture_cell), moves("pore.pressure", cell)};
}

struct Case {
  const char* angle;
  Values values;
  double hours;
  double load;  ///< most by which K moves; asked: 3e-3
};

class CarriedState : public ::testing::TestWithParam<Case> {};

TEST_P(CarriedState, IsThatOfTheMeshBeforeAndHasTheToughness) {
  std::vector<Override> choices = wings(GetParam().angle, GetParam().values);
  SceneRun run("paper/wing_cracks.yaml", choices);
  choices.push_back({"components.tips.mesh_ratio", "0.25"});
  if (GetParam().values == Values::of_paper) choices.push_back({"components.tips.size", "0.6 m"});
  const Scene fine = SceneRun("paper/wing_cracks.yaml", choices).model().scene();
  int tips = 0, kept = 0;
  std::array<int, 2> kicks{}, divided{};
  auto cells = run.mesh().cell_nodes;
  run.run_until(GetParam().hours * hour, [&] {
    const bool has_same_cells = run.mesh().cell_nodes == cells;
    cells = run.mesh().cell_nodes;
    if (run.time() < hour) return;  // the first millimetres are followed by the fine level alone
    if (has_same_cells && run.quantity("tips.main_first.speed") > 0) ++kept;
    const std::unique_ptr<Model> model = restarted(run.model(), fine);
    for (const double load : loads(*model, {run.time() - hour, hour, run.time()})) {
      EXPECT_NEAR(load, 1, 0.01) << run.time() / hour;
      ++tips;
    }
    for (const auto made : {TrialMeshes::Cells::same, TrialMeshes::Cells::anew}) {
      const std::optional<Kick> kick = kick_of(run, made);
      if (!kick) continue;
      const bool is_anew = made == TrialMeshes::Cells::anew;
      ++kicks[is_anew];
      EXPECT_LT(kick->slip, 1e-3) << run.time() / hour << " h, " << is_anew;
      EXPECT_LT(kick->pressure, 1e-4) << run.time() / hour << " h, " << is_anew;
      divided[is_anew] += kick->bend > 0;
      EXPECT_LT(kick->load, GetParam().load) << run.time() / hour << " h, " << is_anew;
    }
  });
  EXPECT_GT(tips, 12);
  EXPECT_GE(kept, 3);  // steps of growth in which no cell was made anew
  for (const int count : kicks) EXPECT_GE(count, 7);
  for (const int count : divided) EXPECT_GE(count, 2);
}

std::string name_of(const ::testing::TestParamInfo<Case>& info) {
  const std::string text = info.param.angle;
  return (text[0] == '-' ? "minus_" : "") + text.substr(text[0] == '-', 2);
}

// At 20 degrees segments that turn are divided until 14 h.
INSTANTIATE_TEST_SUITE_P(
    WithValuesOfPaper, CarriedState,
    ::testing::Values(Case{"45 deg", Values::of_paper, 19, 2e-3}, Case{"-45 deg", Values::of_paper, 9, 2.5e-3},
                      Case{"30 deg", Values::of_paper, 9, 2e-3}, Case{"-30 deg", Values::of_paper, 9, 2.1e-3},
                      Case{"20 deg", Values::of_paper, 14, 2e-3}, Case{"38 deg", Values::of_paper, 9, 2e-3}),
    name_of);

// Steps and increments are long beside the wing. At 20 degrees it would turn by 0.15 rad in 3 h; growth makes the steps
// shorter.
INSTANTIATE_TEST_SUITE_P(InLongSteps, CarriedState,
                         ::testing::Values(Case{"45 deg", Values::of_scene, 26, 2.5e-3},
                                           Case{"-45 deg", Values::of_scene, 26, 2.5e-3},
                                           Case{"20 deg", Values::of_scene, 26, 2.5e-3},
                                           Case{"30 deg", Values::of_scene, 26, 2.5e-3}),
                         name_of);

// Edges of the fracture are 20 mm long. A kink of a quarter of that is followed by the mesh, a shorter one by the fine
// level alone; 0.95 of a quarter is as good.
TEST(Kinks, AreFollowedByTheMeshFromAQuarterOfAnEdgeOn) {
  SceneRun run("paper/wing_cracks.yaml", with_values_of_paper());
  const std::size_t cells = run.mesh().fracture_cells.size();
  int before = 0, after = 0;
  run.run_until(1.5 * hour, [&] {
    const double length = run.quantity("tips.main_last.length");
    if (length == 0) return;
    const bool is_followed = run.mesh().fracture_cells.size() > cells;
    ++(is_followed ? after : before);
    EXPECT_EQ(is_followed, length >= 0.95 * 0.25 * 0.02) << run.time() / hour << " h, " << length;
  });
  EXPECT_GT(before, 1);
  EXPECT_GT(after, 1);
}

}  // namespace
}  // namespace sprekk::testing
