// One backward-Euler step of Biot's equations from rest, put together from the operators of MPFA and MPSA.
#pragma once

#include <umfpack.h>

#include <Eigen/UmfPackSupport>
#include <stdexcept>
#include <vector>

#include "components/matrix_flow/mpfa/mpfa.hpp"
#include "components/poromechanics/mpsa/mpsa.hpp"
#include "tests/components/meshes.hpp"

namespace sprekk::test {

struct BiotStep {
  const Mesh& mesh;
  std::vector<Tensor> mobility;
  std::vector<poromechanics::Stiffness> stiffness;
  std::vector<matrix_flow::FlowCondition> flow_conditions;
  std::vector<poromechanics::FaceConditions> mechanical_conditions;
  double alpha = 1, storage = 0, time_step = 1;
  poromechanics::MpsaLimits mechanical_limits = {};
  Vector flow_boundary, flow_change, mechanical_boundary;  ///< as the operators take them
  Vector force, source;  ///< on every cell, integrated: body force (N/m) and fluid volume (m^2)
  Vector old_fluid;      ///< alpha div u + S p before the step, integrated over every cell (m^2)

  explicit BiotStep(const Mesh& m)
      : mesh(m),
        mobility(m.cell_count(), Tensor::Identity()),
        stiffness(m.cell_count(), poromechanics::isotropic_stiffness(1, 1)),
        flow_conditions(m.face_count(), matrix_flow::FlowCondition::none),
        mechanical_conditions(m.face_count()),
        flow_boundary(Vector::Zero(m.face_count())),
        flow_change(Vector::Zero(m.face_count())),
        mechanical_boundary(Vector::Zero(2 * m.face_count())),
        force(Vector::Zero(2 * m.cell_count())),
        source(Vector::Zero(m.cell_count())),
        old_fluid(Vector::Zero(m.cell_count())) {}
};

struct BiotState {
  Vector displacement, pressure, fluxes, forces;
  Vector walls;  ///< displacement of faces with one cell (m)
  Vector fluid;  ///< alpha div u + S p, integrated over every cell (m^2)
};

/// The matrix of a step and its factors, for steps that differ in what is given only.
class BiotSystem {
 public:
  explicit BiotSystem(const BiotStep& step)
      : flow_(matrix_flow::discretize_mpfa(step.mesh, step.mobility, step.flow_conditions)),
        stress_(poromechanics::discretize_mpsa(step.mesh, step.stiffness, step.mechanical_conditions, {},
                                               step.mechanical_limits)),
        force_sum_(divergence(step.mesh, 2)),
        flux_sum_(divergence(step.mesh, 1)) {
    const int cells = step.mesh.cell_count();
    const SparseMatrix uu = force_sum_ * stress_.force_displacement, us = force_sum_ * stress_.force_stress;
    const SparseMatrix outflow = flux_sum_ * flow_.flux_cell;
    std::vector<Triplet> entries;
    const auto place = [&](const SparseMatrix& block, int row, int column, double factor) {
      for (int i = 0; i < block.outerSize(); ++i)
        for (SparseMatrix::InnerIterator entry(block, i); entry; ++entry)
          entries.emplace_back(row + i, column + static_cast<int>(entry.col()), factor * entry.value());
    };
    place(uu, 0, 0, 1);
    place(us, 0, 2 * cells, step.alpha);
    place(stress_.volume_displacement, 2 * cells, 0, step.alpha);
    place(stress_.volume_stress, 2 * cells, 2 * cells, step.alpha * step.alpha);
    place(outflow, 2 * cells, 2 * cells, step.time_step);
    for (int c = 0; c < cells; ++c)
      entries.emplace_back(2 * cells + c, 2 * cells + c, step.storage * step.mesh.cell_measure[c]);
    matrix_.resize(3 * cells, 3 * cells);
    matrix_.setFromTriplets(entries.begin(), entries.end());
    solver_.compute(matrix_);
    if (solver_.info() != Eigen::Success) throw std::runtime_error("singular Biot system");
  }

  BiotState solve(const BiotStep& step) const {
    const int cells = step.mesh.cell_count();
    Vector right(3 * cells);
    right.head(2 * cells) = -step.force - force_sum_ * (stress_.force_boundary * step.mechanical_boundary);
    right.tail(cells) = step.source + step.old_fluid - step.alpha * stress_.volume_boundary * step.mechanical_boundary -
                        step.time_step * (flux_sum_ * flow_of_sides(step));
    const Vector solution = solver_.solve(right);
    BiotState state{solution.head(2 * cells), solution.tail(cells), {}, {}, {}, {}};
    const Vector s = step.alpha * state.pressure;
    state.fluxes = flow_.flux_cell * state.pressure + flow_of_sides(step);
    state.forces = stress_.force_displacement * state.displacement + stress_.force_stress * s +
                   stress_.force_boundary * step.mechanical_boundary;
    state.walls = stress_.trace_displacement * state.displacement + stress_.trace_stress * s +
                  stress_.trace_boundary * step.mechanical_boundary;
    state.fluid = step.alpha * (stress_.volume_displacement * state.displacement + stress_.volume_stress * s +
                                stress_.volume_boundary * step.mechanical_boundary);
    for (int c = 0; c < cells; ++c) state.fluid[c] += step.storage * step.mesh.cell_measure[c] * state.pressure[c];
    return state;
  }

 private:
  Vector flow_of_sides(const BiotStep& step) const {
    return flow_.flux_boundary * step.flow_boundary + flow_.flux_change * step.flow_change;
  }

  matrix_flow::FluxOperators flow_;
  poromechanics::StressOperators stress_;
  SparseMatrix force_sum_, flux_sum_;
  Eigen::SparseMatrix<double> matrix_;  // the solver refines its solutions with it
  Eigen::UmfPackLU<Eigen::SparseMatrix<double>> solver_;
};

}  // namespace sprekk::test
