// The derivatives that parts of a scene give, against differences of what they assemble.
#pragma once

#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "framework/assembly/assemble_all.hpp"
#include "framework/assembly/assembly.hpp"
#include "framework/assembly/part.hpp"
#include "tests/verification/scene_run.hpp"

namespace sprekk::testing {

/// Values of a field, spread evenly and without any order between two bounds.
struct Spread {
  std::string field;
  double low, high;
};

/// Gives the fields values and compares every block of the Jacobian of the given rows by all of them with central
/// differences of the residuals, in its largest entry. The blocks of `full` (pairs of row and column) must not be zero.
inline void expect_derivatives(SceneRun& run, const std::vector<Spread>& spreads, int rows,
                               const std::vector<std::pair<std::string, std::string>>& full) {
  FieldStore& fields = run.model().fields();
  std::vector<const Field*> unknowns;
  unsigned state = 1;
  const auto random = [&] { return (state = state * 1664525u + 1013904223u) / 4294967296.0; };
  for (const auto& [name, low, high] : spreads) {
    Field& field = fields.at(name);
    Vector values = field.now();
    for (double& value : values) value = low + (high - low) * random();
    field.set(values);
    unknowns.push_back(&field);
  }
  const StepTime step{0, 1, 1};
  const std::vector<Part*> parts = run.model().parts();
  begin_step(parts, step);
  const auto assemble = [&](Assembly& assembly) {
    follow_state(parts, assembly);
    for (const Part* part : parts) part->assemble(assembly, step);
  };
  Assembly assembly(unknowns, Assembly::Request::residual_and_derivatives);
  assemble(assembly);
  const int count = static_cast<int>(unknowns.size());
  // Of each column; copied at once, as parts may make their blocks anew for another state.
  std::vector<std::vector<Eigen::MatrixXd>> given_by(count);
  for (int column = 0; column < count; ++column)
    for (int row = 0; row < rows; ++row)
      given_by[column].emplace_back(Eigen::MatrixXd::Zero(unknowns[row]->size(), unknowns[column]->size()));
  for (const Assembly::Block& block : assembly.blocks()) {
    if (block.row >= rows) continue;
    Eigen::MatrixXd entries = block.factor * Eigen::MatrixXd(*block.matrix);
    if (block.weights) entries = block.weights->asDiagonal() * entries;
    given_by[block.column][block.row] += entries;
  }
  for (int column = 0; column < count; ++column) {
    const std::vector<Eigen::MatrixXd>& given = given_by[column];
    std::vector<Eigen::MatrixXd> differences;
    for (int row = 0; row < rows; ++row)
      differences.emplace_back(Eigen::MatrixXd::Zero(unknowns[row]->size(), unknowns[column]->size()));
    Field& field = fields.at(unknowns[column]->name());
    const Vector values = field.now();
    const double h = 1e-5 * (spreads[column].high - spreads[column].low);
    for (int i = 0; i < field.size(); ++i) {
      for (const double sign : {1.0, -1.0}) {
        Vector moved = values;
        moved[i] += sign * h;
        field.set(moved);
        Assembly there(unknowns, Assembly::Request::residual);
        assemble(there);
        for (int row = 0; row < rows; ++row) differences[row].col(i) += sign / (2 * h) * there.residual(row);
      }
    }
    field.set(values);
    for (int row = 0; row < rows; ++row) {
      const std::string name = unknowns[row]->name() + " by " + unknowns[column]->name();
      const double largest = differences[row].size() ? differences[row].lpNorm<Eigen::Infinity>() : 0;
      EXPECT_LE((given[row] - differences[row]).lpNorm<Eigen::Infinity>(), 1e-7 * largest + 1e-10) << name;
      for (const auto& [full_row, full_column] : full) {
        if (full_row != unknowns[row]->name() || full_column != unknowns[column]->name()) continue;
        EXPECT_GT(largest, 1e-3) << name;
      }
    }
  }
}

}  // namespace sprekk::testing
