#include "components/matrix_flow/storage_formula.hpp"

#include <array>
#include <cmath>
#include <numbers>
#include <utility>

#include "framework/assembly/property.hpp"

namespace sprekk::matrix_flow {
namespace {

constexpr std::size_t of_pressure = 0;  // among rock_variables()
constexpr int points = 5, pieces = 8;   // exact to degree 9; a kink inside of a piece leaves a thousandth of S there

/// A place between 0 and 1 with its weight.
struct Sample {
  double at, weight;
};

/// The points of Gauss-Legendre in all pieces of [0, 1].
std::array<Sample, points * pieces> samples() {
  std::array<Sample, points * pieces> all{};
  for (int k = 0; k < points; ++k) {
    constexpr double shift = 0.75;  // Tricomi's estimate of the zeros of the polynomial of Legendre
    constexpr int enough = 10;      // iterations of Newton's method from there
    double x = std::cos(std::numbers::pi * (k + shift) / (points + 0.5)), slope = 0;
    for (int repeat = 0; repeat < enough; ++repeat) {
      double last = 1, now = x;
      for (int n = 2; n <= points; ++n) last = std::exchange(now, ((2 * n - 1) * x * now - (n - 1) * last) / n);
      slope = points * (x * now - last) / (x * x - 1);
      x -= now / slope;
    }
    for (int piece = 0; piece < pieces; ++piece)
      all[static_cast<std::size_t>(points * piece + k)] = {(piece + (1 + x) / 2) / pieces,
                                                           1 / ((1 - x * x) * slope * slope * pieces)};
  }
  return all;
}

}  // namespace

std::unique_ptr<StorageFormula> StorageFormula::find(const Data& data, const Mesh& mesh, const Field& pressure,
                                                     const History* history, const Origin& where) {
  std::unique_ptr<StorageFormula> found(new StorageFormula(data, mesh, pressure, history));
  for (std::size_t k = 0; history && k < history->variables().size(); ++k)
    if ((found->formula_.recalled() >> k & 1U) != 0)
      throw InputError(where,
                       "the formula of 'storage' names " + quoted(history->variables()[k].name) + ", which remembers",
                       "what rock stores is the integral of its storage over the pressure, and follows the state alone",
                       "give a porosity that remembers, or a storage that does not");
  return found->formula_.is_formula() ? std::move(found) : nullptr;
}

StorageFormula::StorageFormula(const Data& data, const Mesh& mesh, const Field& pressure, const History* history)
    : mesh_(mesh), pressure_(pressure), formula_(data, rock_variables(), cell_places(mesh), history), state_(mesh) {
  state_.let_name(formula_);
}

bool StorageFormula::evaluate(const StepTime& step, const Vector& initial_pressure, const std::vector<char>& inside) {
  static const auto all = samples();
  const bool has_changed = state_.take(step), is_other_time = formula_.set_time(step);
  if (!has_changed && !is_other_time && pressures_.size() > 0 && pressures_ == pressure_.now()) return false;
  Vector stored = Vector::Zero(mesh_.cell_count()), by_pressure = stored;
  std::vector<Vector> by(state_.variable_count(), stored);
  std::vector<double> of_state(rock_variables().size());
  state_.visit(inside, [&](int c, std::vector<double>& state) {
    const double before = initial_pressure[c], change = pressure_.now()[c] - before;
    for (const Sample& sample : all) {
      state[of_pressure] = before + sample.at * change;
      const double storage = formula_.at(c, state, of_state);
      stored[c] += sample.weight * change * storage;
      by_pressure[c] += sample.weight * (storage + sample.at * change * of_state[of_pressure]);
      for (std::size_t k = 0; k < by.size(); ++k) by[k][c] += sample.weight * change * of_state[state_.variable(k)];
    }
  });
  pressures_ = pressure_.now();
  stored_ = std::move(stored);
  by_pressure_ = std::move(by_pressure);
  by_ = std::move(by);
  return true;
}

}  // namespace sprekk::matrix_flow
