// A state that goes over to another mesh under tips that grow: nothing but the discretization tells that there was a
// change.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <memory>
#include <optional>
#include <stdexcept>
#include <string>
#include <vector>

#include "framework/remeshing/continued_mesh.hpp"
#include "framework/remeshing/move_tips.hpp"
#include "framework/scene/change_mesh.hpp"
#include "tests/verification/scene_run.hpp"

namespace sprekk::testing {
namespace {

constexpr double hour = 3600, toughness = 0.7e6;  // s, Pa sqrt(m)

/// The wings of section 5.2 of the paper, turned with their fracture by an angle.
std::vector<Override> wings(const std::string& angle) {
  return {{"geometry.fractures.main.angle", angle}, {"couplers.4.propagation_threshold", "0.25"}};
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
    const int point = model.mesh().fracture_cells[last].points[path.at_end ? 1 : 0];
    path.points.back() = model.mesh().fracture_points[point].position;
  }
  return paths;
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

/// What a change of the mesh under tips at rest, with a second in which all is free, does to the state.
struct Kick {
  bool keeps_cells;  ///< not even a cell is divided
  double load, slip, pressure;
};

std::optional<Kick> kick_of(SceneRun& run) {
  const double time = run.time();
  const StepTime last{time - hour, hour, time}, next{time, 1, time + 1};
  const std::unique_ptr<Model> before = restarted(run.model(), run.model().scene());
  const std::array<double, 2> old = loads(*before, last);
  const std::vector<PathExtension> paths = paths_at_rest(*before, next);
  if (paths.empty()) return std::nullopt;
  const std::optional<GrownMesh> same = continued_mesh(before->mesh(), paths, cavity_of(*before, 0));
  std::optional<GrownMesh> moved = same ? move_tips(before->mesh(), *same, paths, cavity_of(*before, 0)) : std::nullopt;
  if (!moved) return std::nullopt;
  const MeshChange change = moved->change;
  const MeshChangeResult changed = change_mesh(*before, 0, std::move(*moved), last);
  // A change of the mesh alone moves no walls.
  EXPECT_LT(
      change_of(before->fields().at("contact.jump"), changed.model->fields().at("contact.jump"), change.fracture_cell),
      1e-12);
  changed.model->growing()[0]->choose(GrowStep::Holding::never);
  EXPECT_TRUE(changed.model->attempt(next).converged);
  const std::array<double, 2> now = loads(*changed.model, next);
  const auto moves = [&](const std::string& field, const std::vector<int>& origin) {
    return change_of(before->fields().at(field), changed.model->fields().at(field), origin);
  };
  return Kick{std::ranges::all_of(paths, [](const PathExtension& path) { return path.points.size() == 1; }),
              std::max(std::abs(now[0] / old[0] - 1), std::abs(now[1] / old[1] - 1)),
              moves("contact.jump", change.fracture_cell), moves("pore.pressure", change.cell)};
}

class CarriedState : public ::testing::TestWithParam<const char*> {};

TEST_P(CarriedState, IsThatOfTheMeshBeforeAndHasTheToughness) {
  SceneRun run("paper/wing_cracks.yaml", wings(GetParam()));
  std::vector<Override> finer = wings(GetParam());
  finer.push_back({"components.tips.mesh_ratio", "0.25"});
  finer.push_back({"components.tips.size", "0.6 m"});
  const Scene fine = SceneRun("paper/wing_cracks.yaml", finer).model().scene();
  int tips = 0, kicks = 0, kept = 0;
  auto cells = run.mesh().cell_nodes;
  run.run_until(7 * hour, [&] {
    const bool has_same_cells = run.mesh().cell_nodes == cells;
    cells = run.mesh().cell_nodes;
    if (run.time() < hour) return;  // the first millimetres are followed by the fine level alone
    if (has_same_cells && run.quantity("tips.main_first.speed") > 0) ++kept;
    const std::unique_ptr<Model> model = restarted(run.model(), fine);
    for (const double load : loads(*model, {run.time() - hour, hour, run.time()})) {
      EXPECT_NEAR(load, 1, 0.01) << run.time() / hour;
      ++tips;
    }
    const std::optional<Kick> kick = kick_of(run);
    if (!kick || !kick->keeps_cells) return;
    ++kicks;
    EXPECT_LT(kick->load, 3e-3) << run.time() / hour;
    EXPECT_LT(kick->slip, 1e-3) << run.time() / hour;
    EXPECT_LT(kick->pressure, 1e-4) << run.time() / hour;
  });
  EXPECT_GT(tips, 10);
  EXPECT_GE(kicks, 3);
  EXPECT_GE(kept, 3);  // steps of growth in which no cell was made anew
}

INSTANTIATE_TEST_SUITE_P(Angles, CarriedState, ::testing::Values("45 deg", "-45 deg"));

}  // namespace
}  // namespace sprekk::testing
