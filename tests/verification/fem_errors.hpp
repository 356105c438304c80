// Errors of displacements by finite elements, integrated over cells.
#pragma once

#include <cmath>
#include <functional>
#include <string>
#include <vector>

#include "components/poromechanics/fem/raw_displacement.hpp"
#include "components/poromechanics/fem/shape_functions.hpp"
#include "framework/config/yaml/load_scene.hpp"
#include "tests/verification/scene_run.hpp"

namespace sprekk::testing {

/// A scene's text with finite elements in the place of MPSA.
inline std::string with_fem(std::string scene, const std::string& order) {
  const std::string mpsa = "poromechanics/mpsa";
  scene.replace(scene.find(mpsa), mpsa.size(), "poromechanics/fem, order: " + order);
  return scene;
}

inline std::vector<Override> with_fem(const std::string& order, std::vector<Override> overrides = {}) {
  overrides.push_back({"components.rock.type", "poromechanics/fem"});
  overrides.push_back({"components.rock.order", order});
  return overrides;
}

/// Relative L2 error of the displacement, without what interior functions add.
inline double displacement_error(const SceneRun& run, const std::function<Point(const Point&)>& exact) {
  const Mesh& mesh = run.mesh();
  const poromechanics::RawDisplacement raw{mesh};
  Vector all = Vector::Zero(raw.size());
  all.head(raw.nodes_size()) = run.field("rock.displacement");
  if (const_cast<SceneRun&>(run).model().fields().has("rock.displacement_of_faces"))
    all.tail(raw.size() - raw.nodes_size()) = run.field("rock.displacement_of_faces");
  double error = 0, norm = 0;
  for (int c = 0; c < mesh.cell_count(); ++c) {
    const std::vector<int> first = raw.of_cell(c);
    for (const auto& point : poromechanics::cell_points(mesh, c)) {
      Point u = Point::Zero();
      for (std::size_t i = 0; i < first.size(); ++i)
        u += point.value[static_cast<int>(i)] * all.segment<dimension>(first[i]);
      error += point.weight * (u - exact(point.x)).squaredNorm();
      norm += point.weight * exact(point.x).squaredNorm();
    }
  }
  return std::sqrt(error / norm);
}

/// The mean stress of cells, (xx, yy, xy) each.
inline Vector stress_of_cells(SceneRun& run) {
  std::vector<OutputField> fields;
  for (const auto& component : run.model().components()) component->output(fields);
  for (const OutputField& field : fields)
    if (field.name == "rock.stress") return field.values;
  return {};
}

/// Relative L2 error of the mean stress of cells against the stress at their centres.
inline double stress_error(SceneRun& run, const std::function<Eigen::Vector3d(const Point&)>& exact) {
  const Vector stress = stress_of_cells(run);
  double error = 0, norm = 0;
  for (int c = 0; c < run.mesh().cell_count(); ++c) {
    const Eigen::Vector3d there = exact(run.mesh().cell_center[c]);
    error += run.mesh().cell_measure[c] * (stress.segment<3>(3 * c) - there).squaredNorm();
    norm += run.mesh().cell_measure[c] * there.squaredNorm();
  }
  return std::sqrt(error / norm);
}

}  // namespace sprekk::testing
