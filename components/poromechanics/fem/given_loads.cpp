#include "components/poromechanics/fem/given_loads.hpp"

#include <algorithm>
#include <limits>

#include "components/poromechanics/check_conditions.hpp"
#include "components/poromechanics/fem/face_functions.hpp"
#include "components/poromechanics/fem/shape_functions.hpp"

namespace sprekk::poromechanics {

namespace {

/// Adds forces on functions of a cell to those on all coefficients.
void add_to(Vector& forces, const std::vector<int>& first, const Eigen::VectorXd& of_cell) {
  for (int i = 0; i < static_cast<int>(first.size()); ++i)
    forces.segment<dimension>(first[i]) += of_cell.segment<dimension>(dimension * i);
}

void add_forces_in_cells(const Options& options, const RawDisplacement& raw, const FemOperators& operators,
                         const Excavation& excavation, const Vector* settled, const StepTime& step, GivenLoads& loads) {
  const Mesh& mesh = raw.mesh;
  const bool has_weight = options.has_body_force();
  const bool has_stress = !options.initial_stress.is_zero() && !settled;
  int next = 0;  // in the settled forces
  if (!has_weight && !has_stress && !settled) return;
  for (int c = 0; c < mesh.cell_count(); ++c) {
    const std::vector<int> first = raw.of_cell(c);
    const int functions = static_cast<int>(first.size());
    const double support = excavation.support(c);
    Eigen::VectorXd forces = Eigen::VectorXd::Zero(dimension * (functions + 1));
    for (const CellPoint& point : cell_points(mesh, c, operators.tips, raw.edges)) {
      const Place place{point.x, mesh.cell_region[c], 0};
      const Point weight = support * options.body_force_in(step, place);
      if (!weight.isZero(0)) loads.largest_stress = std::numeric_limits<double>::infinity();
      const Tensor stress = has_stress ? Tensor(support * options.initial_stress.at(place)) : Tensor::Zero();
      for (int i = 0; i <= functions; ++i)
        forces.segment<dimension>(dimension * i) +=
            point.weight * (point.value[i] * weight - stress * point.gradient.col(i));
    }
    const Point on_interior = forces.tail<dimension>();
    const Eigen::VectorXd total =
        forces.head(dimension * functions) + operators.of_interior[c].transpose() * on_interior;
    add_to(loads.forces, first, total);
    if (!settled) continue;
    add_to(loads.forces, first, -support * settled->segment(next, dimension * functions));
    next += dimension * functions;
  }
}

void add_tractions(const SideCondition& condition, int face, const RawDisplacement& raw, const StepTime& step,
                   GivenLoads& loads) {
  const Mesh& mesh = raw.mesh;
  const int region = mesh.cell_region[mesh.face_cells[face][0]];
  const std::vector<FaceFunction> functions = face_functions(raw, {}, face);
  for (const FacePoint& point : face_points(raw, face)) {
    const Point force = point.weight * condition.traction_in(step, {point.x, region, 0}, point.normal);
    for (std::size_t k = 0; k < functions.size(); ++k)
      loads.forces.segment<dimension>(functions[k].coefficient) += point.value[k] * force;
  }
}

bool has_wall(const Mesh& mesh, int node) {
  const auto faces = mesh.node_faces[node];
  return std::any_of(faces.begin(), faces.end(), [&](int face) { return mesh.face_fracture_cell[face] != none; });
}

/// The largest stress at the start, and prescribed where displacements are not.
void find_largest_stress(const Options& options, const Mesh& mesh, const StepTime& step, GivenLoads& loads) {
  for (int f = 0; f < mesh.face_count(); ++f) {
    const Place place{mesh.face_center[f], mesh.cell_region[mesh.face_cells[f][0]], 0};
    if (!options.initial_stress.is_zero())
      loads.largest_stress =
          std::max(loads.largest_stress, (options.initial_stress.at(place) * mesh.face_normal[f]).norm());
    const SideCondition* condition = condition_of(options, mesh, f);
    if (!condition) continue;
    const Tensor axes = axes_of(condition->axes(), mesh.face_normal[f]);
    Point traction = axes.transpose() * condition->traction_in(step, place, mesh.face_normal[f]);
    for (int k = 0; k < dimension; ++k)
      if (condition->displacement_of(k)) traction[k] = 0;
    loads.largest_stress = std::max(loads.largest_stress, traction.norm());
  }
  if (!loads.displacements.isZero(0)) loads.largest_stress = std::numeric_limits<double>::infinity();
}

}  // namespace

GivenLoads given_loads(const Options& options, const RawDisplacement& raw, const Held& held,
                       const FemOperators& operators, const Excavation& excavation, const Vector* settled,
                       const StepTime& step) {
  const Mesh& mesh = raw.mesh;
  GivenLoads loads{Vector::Zero(raw.size()), Vector::Zero(raw.size()), 0};
  add_forces_in_cells(options, raw, operators, excavation, settled, step, loads);
  const auto displacement = [&](const HeldBy& by, const Point& x) {
    const Data& data = *condition_of(options, mesh, by.face)->displacement_of(by.axis);
    return by.share * value_in_step(data, {x, mesh.cell_region[mesh.face_cells[by.face][0]], 0}, step);
  };
  // Where a fracture ends the datum may jump: its value on this side continues those along the face (by a parabola).
  // Half of a triangle beyond its centre is another edge, where the datum may jump again.
  const auto beside_wall = [&](const HeldBy& by, const Point& x) {
    const Point arm = (mesh.face_center[by.face] - x) / dimension;
    return 3 * (displacement(by, x + arm) - displacement(by, x + 2 * arm)) + displacement(by, x + 3 * arm);
  };
  const auto at_node = [&](const HeldBy& by, int node) {
    if (by.pin) {
      const Place place{mesh.nodes[node], mesh.cell_region[mesh.node_cells[node][0]], 0};
      return by.share * value_in_step(*by.pin->displacement_along[by.axis], place, step);
    }
    return has_wall(mesh, node) ? beside_wall(by, mesh.nodes[node]) : displacement(by, mesh.nodes[node]);
  };
  // How much more the middle of an edge is displaced than the mean of its ends.
  const auto of_edge = [&](const HeldBy& by, int edge) {
    const auto& [from, to] = raw.edges->nodes[edge];
    const Point middle = (mesh.nodes[from] + mesh.nodes[to]) / 2 + raw.edges->shift(mesh, edge);
    const bool is_on_wall = has_wall(mesh, from) && has_wall(mesh, to);
    return (is_on_wall ? beside_wall(by, middle) : displacement(by, middle)) -
           (at_node(by, from) + at_node(by, to)) / 2;
  };
  for (int f = 0; f < mesh.face_count(); ++f) {
    if (const SideCondition* condition = condition_of(options, mesh, f)) add_tractions(*condition, f, raw, step, loads);
    for (int k = 0; k < dimension; ++k)
      for (const HeldBy& by : held.faces[f].by[k]) {
        double of_nodes = 0;
        for (const int node : mesh.face_nodes[f]) of_nodes += at_node(by, node);
        double before = of_nodes / static_cast<double>(mesh.face_nodes[f].size());
        for (const int edge : edges_of_face(raw, f)) before += edge_in_middle(mesh, f) * of_edge(by, edge);
        loads.displacements[raw.of_face(f) + k] += displacement(by, middle_of_face(raw, f)) - before;
      }
  }
  for (int node = 0; node < mesh.node_count(); ++node)
    for (int k = 0; k < dimension; ++k)
      for (const HeldBy& by : held.nodes[node].by[k]) loads.displacements[raw.of_node(node) + k] += at_node(by, node);
  for (int edge = 0; edge < raw.edge_count(); ++edge)
    for (int k = 0; k < dimension; ++k)
      for (const HeldBy& by : held.edges[edge].by[k]) loads.displacements[raw.of_edge(edge) + k] += of_edge(by, edge);
  find_largest_stress(options, mesh, step, loads);
  return loads;
}

Vector settled_forces(const Options& options, const RawDisplacement& raw, const std::vector<Stiffness>& stiffness,
                      const FemOperators& operators, const Springs& springs, const Vector& coefficients,
                      const Vector& pore_stress) {
  const Mesh& mesh = raw.mesh;
  std::vector<double> all;
  for (int c = 0; c < mesh.cell_count(); ++c) {
    const std::vector<int> first = raw.of_cell(c);
    const int functions = static_cast<int>(first.size());
    const std::vector<CellPoint> points = cell_points(mesh, c, operators.tips, raw.edges);
    Eigen::VectorXd displacement(dimension * functions);
    for (int i = 0; i < functions; ++i)
      displacement.segment<dimension>(dimension * i) = coefficients.segment<dimension>(first[i]);
    Eigen::VectorXd forces = cell_stiffness(points, stiffness[c], ElementOrder::second).of_unknowns * displacement;
    if (const auto spring = springs.find(c); spring != springs.end()) forces += spring->second * displacement;
    if (!options.initial_stress.is_zero() || pore_stress[c] != 0) {
      Eigen::VectorXd of_stress = Eigen::VectorXd::Zero(dimension * (functions + 1));
      for (const CellPoint& point : points) {
        const Tensor stress =
            options.initial_stress.at({point.x, mesh.cell_region[c], 0}) + Tensor(pore_stress[c] * Tensor::Identity());
        for (int i = 0; i <= functions; ++i)
          of_stress.segment<dimension>(dimension * i) += point.weight * stress * point.gradient.col(i);
      }
      const Point on_interior = of_stress.tail<dimension>();
      forces += of_stress.head(dimension * functions) + operators.of_interior[c].transpose() * on_interior;
    }
    all.insert(all.end(), forces.begin(), forces.end());
  }
  return Eigen::Map<const Vector>(all.data(), static_cast<Eigen::Index>(all.size()));
}

}  // namespace sprekk::poromechanics
