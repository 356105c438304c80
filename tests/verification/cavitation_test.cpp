// A lower bound of the pressure: a film between plates that are pulled apart, by the conditions of Jakobsson, Floberg
// and Olsson.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <utility>
#include <vector>

#include "framework/config/input_error.hpp"
#include "tests/verification/scene_run.hpp"

namespace sprekk::testing {
namespace {

constexpr double half = 1;       // m, of the width of the film
constexpr double outside = 1e5;  // Pa, beside the plates; 0 where the film has parted
constexpr double viscosity = 1e-3, thinnest = 1e-3, duration = 7.76e-3;  // Pa s, m, s

double gap(double time) { return thinnest * (1 + std::pow(time / duration, 2)); }
/// In full film p'' = 2 bend, Pa/m^2.
double bend(double time) {
  const double speed = 2 * thinnest * time / (duration * duration);
  return 6 * viscosity * speed / std::pow(gap(time), 3);
}
/// Of the parted part of the film, m from its middle, as long as it becomes longer: there p = 0 and p' = 0.
double parted(double time) { return half - std::sqrt(outside / bend(time)); }

/// The film by closed form until it closes again, and then by one ordinary differential equation: what flows in over
/// the end of the full film fills what has parted, (h − h_r) db/dt = −h^3 p'(b)/(12 mu), with h_r(x) the gap when the
/// film parted at x.
class Film {
 public:
  Film() {
    for (int i = 0; i < 60; ++i) {
      const double middle = 0.5 * (last_ + first_);
      (half * half * bend(middle) < outside ? last_ : first_) = middle;
    }
    double end = parted(turn_);
    for (int i = 0; i < steps; ++i) {
      ends_.push_back(end);
      const double now = turn_ + (i + 0.5) * step_, open = gap(now) - gap(parting(end));
      end -= std::max(0.0, step_ * std::pow(gap(now), 3) * slope(now, end) / (12 * viscosity * open));
    }
    ends_.push_back(end);
  }
  /// Of one half of the film, m^2, without fluid at this time; and the pressure in the middle of the outer half, Pa.
  std::pair<double, double> at(double time) const {
    constexpr double place = 0.75 * half;  // m from the middle of the film
    if (time < first_) return {0, outside - bend(time) * (half * half - place * place)};
    const double step = std::clamp((time - turn_) / step_, 0.0, steps - 1e-9);
    const int i = static_cast<int>(step);
    const double end = time < turn_ ? parted(time) : ends_[i] + (step - i) * (ends_[i + 1] - ends_[i]);
    double empty = 0;
    const int parts = 500;
    for (int k = 0; k < parts; ++k) empty += (gap(time) - gap(parting(end * (k + 0.5) / parts))) * end / parts;
    return {empty, slope(time, end) * (place - end) + bend(time) * (place - end) * (place - end)};
  }

 private:
  /// Of the pressure where the full film ends, Pa/m.
  static double slope(double time, double end) { return outside / (half - end) - bend(time) * (half - end); }
  /// The time at which the film parted at x.
  double parting(double x) const {
    double low = first_, high = turn_;
    for (int i = 0; i < 45; ++i) {
      const double middle = 0.5 * (low + high);
      (parted(middle) < x ? low : high) = middle;
    }
    return low;
  }
  static constexpr int steps = 20000;
  double turn_ = duration / std::sqrt(5.0);   ///< where bend() is largest
  double last_ = 0, first_ = turn_;           ///< the first time at which the film parts is between these
  double step_ = (duration - turn_) / steps;  ///< s
  std::vector<double> ends_;                  ///< m, of the parted part, from turn_ on
};

std::string film(int cells, const std::string& more = "") {
  return R"(
name: film
geometry:
  box: {x: [0 m, 2 m], y: [0 m, 1 m]}
  fractures:
    film: {points: [[0 m, 0.5 m], [2 m, 0.5 m]]}
mesh: {size: 0.5 m, fracture_size: )" +
         std::to_string(2.0 / cells) + R"( m}
materials: {viscosity: 1.0e-3 Pa*s, fluid_compressibility: 0 1/Pa}
components:
  film:
    type: fracture_flow/tpfa
    initial_aperture: 1 mm
    initial_pressure: 0.1 MPa
    cavitation: 0 Pa
    boundary: {left: {pressure: 0.1 MPa}, right: {pressure: 0.1 MPa}}
)" + more +
         R"(
schedule:
  - solve: [film]
time: {end: 7.76 ms, step: )" +
         std::to_string(7.76 / cells) + " ms}\n";
}

/// The largest errors of the empty part (m^2) and of the pressure (Pa), the largest error of the balance of fluid, over
/// all that has flowed, and the mean number of iterations of a step.
struct Errors {
  double empty = 0, pressure = 0, balance = 0;
  double iterations = 0;
};

Errors errors(int cells) {
  const Film exact;
  SceneRun run = SceneRun::from_text(film(cells));
  const Mesh& mesh = run.mesh();
  EXPECT_EQ(mesh.fracture_cell_count(), cells);
  Errors errors;
  for (int step = 1; step <= cells; ++step) {
    Field& aperture = run.model().fields().at("film.aperture");
    aperture.set(Vector::Constant(cells, gap(duration * step / cells)));
    if (!run.step()) break;
    errors.iterations += static_cast<double>(run.iterations()) / cells;
    const auto [empty, pressure] = exact.at(run.time());
    double sum = 0, stored = 0;
    for (int i = 0; i < cells; ++i) {
      const double p = run.field("film.pressure")[i], e = run.field("film.empty")[i];
      EXPECT_GE(p, -1e-6);
      EXPECT_GE(e, -1e-15);
      EXPECT_LE(std::min(p / outside, e / thinnest), 1e-10);
      EXPECT_LE(e, gap(run.time()));
      sum += 0.5 * mesh.fracture_cells[i].measure * e;
      stored += mesh.fracture_cells[i].measure * (gap(run.time()) - e - thinnest);
    }
    const double there = 0.5 * (run.field("film.pressure")[cells / 8 - 1] + run.field("film.pressure")[cells / 8]);
    errors.empty = std::max(errors.empty, std::abs(sum - empty));
    errors.pressure = std::max(errors.pressure, std::abs(there - pressure));
    double flowed = 0;
    for (int i = 0; i < cells; ++i) flowed -= run.field("film.cumulative_balance")[3 * i + 2];
    errors.balance = std::max(errors.balance, std::abs(stored - flowed) / thinnest);
  }
  return errors;
}

TEST(Cavitation, AFilmThatPartsAndClosesIsThatOfReynoldsAndJfo) {
  const Errors coarse = errors(80), fine = errors(160);
  const double largest = 2e-4;  // m^2
  // Implicit Euler is of the first order: the speed of the plates is that in the middle of a step.
  EXPECT_LT(fine.empty, 0.015 * largest);
  EXPECT_LT(fine.pressure, 0.025 * outside);
  EXPECT_LT(fine.empty, 0.55 * coarse.empty);
  EXPECT_LT(fine.pressure, 0.55 * coarse.pressure);
  EXPECT_LT(fine.balance, 1e-12);
  EXPECT_LT(fine.iterations, 4);  // a film that is full takes one
}

TEST(Cavitation, PressuresBelowTheBoundAreRefused) {
  for (const auto& [from, to] :
       {std::pair<std::string, std::string>{"initial_pressure: 0.1 MPa", "initial_pressure: -1 Pa"},
        {"left: {pressure: 0.1 MPa}", "left: {pressure: -1 Pa}"},
        {"cavitation: 0 Pa", "cavitation: 0 Pa\n    gravity: [0 m/s^2, -10 m/s^2]"}}) {
    std::string scene = film(20);
    scene.replace(scene.find(from), from.size(), to);
    EXPECT_THROW(SceneRun::from_text(scene).run(), InputError) << to;
  }
}

}  // namespace
}  // namespace sprekk::testing
