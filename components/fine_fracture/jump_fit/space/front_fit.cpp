#include "components/fine_fracture/jump_fit/space/front_fit.hpp"

#include <Eigen/QR>
#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>

namespace sprekk::fine_fracture {

namespace {

/// A cell of the strip, from its place, in sizes of the cells there.
struct Sample {
  double behind, along;
  int cell;
};

/// The weights of samples in the value that a fit of 1, r, s and s² has at the place itself.
struct Weights {
  Eigen::VectorXd of_samples;
  bool has_line = false;  ///< whether samples lie at several distances
};

Weights weights_at_front(const std::vector<Sample>& samples) {
  const int count = static_cast<int>(samples.size());
  constexpr double spread = 0.2;  // least, of samples in what a term adds, in cells: one row of cells has no slope
  Eigen::MatrixXd columns(count, 4), directions(count, 4);
  int kept = 0;
  Weights weights;
  if (samples.empty()) return weights;
  for (int power = 0; power < 4; ++power) {
    Eigen::VectorXd column(count);
    for (int i = 0; i < count; ++i)
      column[i] = power == 0 ? 1 : power == 1 ? samples[i].behind : std::pow(samples[i].along, power - 1);
    const auto before = directions.leftCols(kept);
    const Eigen::VectorXd rest = column - before * (before.transpose() * column);
    // A line goes through two places; along the front two for each column, so that single cells do not decide.
    if (count < 2 * kept || rest.norm() < spread * std::sqrt(count)) continue;
    columns.col(kept) = column;
    directions.col(kept++) = rest.normalized();
    weights.has_line |= power == 1;
  }
  const Eigen::MatrixXd used = columns.leftCols(kept);
  weights.of_samples = used.completeOrthogonalDecomposition().pseudoInverse().row(0).transpose();
  return weights;
}

/// The places of one piece of a front.
class PieceFit {
 public:
  PieceFit(const Mesh& mesh, const std::vector<CellBehind>& seen, const FrontPiece& piece, int number,
           const JumpFitOptions& options)
      : mesh_(mesh), seen_(seen), piece_(piece), options_(options) {
    for (int edge = 0; edge < piece.count(); ++edge) {
      depths_.push_back(depth_behind(mesh, piece.edges[edge]));
      ways_.push_back(way_behind(mesh, piece.fracture, piece.ridges[edge], piece.edges[edge]));
    }
    const Fracture& fracture = mesh.fractures[piece.fracture];
    for (int cell = fracture.first_cell; cell < fracture.first_cell + fracture.cell_count; ++cell)
      if (seen[cell].piece == number) cells_.push_back(cell);
    std::ranges::sort(cells_, {}, [&](int cell) { return seen[cell].distance; });
  }

  FrontPlace at(int edge) {
    const Strip strip{(piece_.arc[edge] + piece_.arc[edge + 1]) / 2, size_at(edge),
                      std::max(size_at(edge), piece_.length(edge))};
    FrontPlace place{piece_.ridges[edge], piece_.fracture, piece_.edges[edge].cell, strip.arc, {}, {}};
    // Half a cell at a time: rows of triangles have centres at a third and two thirds.
    for (double leave_out = options_.leave_out; leave_out >= 0; leave_out -= 0.5) {
      constexpr double margin = 0.1;  // in sizes: centres of structured meshes, at halves, are not to lie on limits
      const double begin = (leave_out - margin) * strip.size;
      // Near the middle of a disc the place on the front that is nearest says little.
      constexpr double reach = 0.4;  // of the way to the next end
      const double end = std::min(begin + options_.cells * strip.size, reach * ways_[edge].length);
      const auto samples = samples_in(strip, begin, end);
      const Weights weights = weights_at_front(samples);
      if (!is_good(weights)) continue;
      place.fitted = sum_of(samples, weights);
      const auto less = samples_in(strip, begin, end - strip.size);
      if (const Weights others = weights_at_front(less); others.has_line) place.with_one_less = sum_of(less, others);
      return place;
    }
    const auto samples = nearest(strip, edge);
    place.fitted = sum_of(samples, {Eigen::VectorXd::Constant(std::ssize(samples), 1.0 / std::ssize(samples)), false});
    return place;
  }

 private:
  struct Strip {
    double arc, size, size_along;  ///< m
  };

  /// Where few cells lie behind a place the weights are large, and amplify errors of the jumps.
  static bool is_good(const Weights& weights) {
    constexpr double largest_sum = 4;  // of weights in size: a line through 2.5, 3.5 and 4.5 cells has 3.8
    return weights.has_line && weights.of_samples.lpNorm<1>() < largest_sum;
  }

  /// m, of the cells at the front: a mean of neighbours.
  double size_at(int edge) const {
    double sum = 0;
    int count = 0;
    for (const int further : {-1, 0, 1})
      if (const int k = piece_.edge_at(edge, further); k != none) {
        sum += depths_[k];
        ++count;
      }
    return sum / count;
  }

  /// Between these distances from the front, m.
  std::vector<Sample> samples_in(const Strip& strip, double begin, double end) const {
    // In cells: a parabola along the front is one on this length, and structured meshes have five columns in it.
    constexpr double half_width = 2.2;
    std::vector<Sample> samples;
    for (const int cell : cells_) {
      if (seen_[cell].distance > end) break;
      if (seen_[cell].distance < begin) continue;
      const double along = piece_.way(strip.arc, seen_[cell].arc) / strip.size_along;
      if (std::abs(along) < half_width) samples.push_back({seen_[cell].distance / strip.size, along, cell});
    }
    return samples;
  }

  /// The cell at the front alone, where there are too few for a fit.
  std::vector<Sample> nearest(const Strip& strip, int edge) const {
    const int cell = piece_.edges[edge].cell;
    return {{seen_[cell].distance / strip.size, 0, cell}};
  }

  FrontSum sum_of(const std::vector<Sample>& samples, const Weights& weights) {
    FrontSum sum;
    for (std::size_t i = 0; i < samples.size(); ++i) {
      const int cell = samples[i].cell;
      sum.parts.push_back(
          {cell, weights.of_samples[i] * std::sqrt(2 * std::numbers::pi) / mean_root(cell), seen_[cell].axes});
    }
    return sum;
  }

  /// The mean of sqrt(r (1 − r/L)) over a cell, m^0.5, with the way L across the fracture from the front beside it.
  double mean_root(int cell) {
    double& mean = mean_roots_[cell];
    if (mean > 0) return mean;
    const WayBehind& way = ways_[seen_[cell].edge];
    const std::vector<double> distances = distances_in_cell(mesh_, piece_, seen_[cell], cell);
    for (const double r : distances) mean += std::sqrt(way.is_to_tip ? r * std::max(1 - r / way.length, 0.0) : r);
    return mean /= static_cast<double>(distances.size());
  }

  const Mesh& mesh_;
  const std::vector<CellBehind>& seen_;
  const FrontPiece& piece_;
  const JumpFitOptions& options_;
  std::vector<double> depths_;   ///< m, of the cells at the edges
  std::vector<WayBehind> ways_;  ///< from the edges
  std::vector<int> cells_;       ///< those of the piece, the nearest first
  std::map<int, double> mean_roots_;
};

}  // namespace

std::vector<FrontPlace> fit_fronts(const Mesh& mesh, const JumpFitOptions& options) {
  const std::vector<FrontPiece> pieces = pieces_of_fronts(mesh);
  const std::vector<CellBehind> seen = cells_behind(mesh, pieces);
  std::vector<FrontPlace> places;
  for (int number = 0; number < static_cast<int>(pieces.size()); ++number) {
    PieceFit fit(mesh, seen, pieces[number], number, options);
    for (int edge = 0; edge < pieces[number].count(); ++edge) places.push_back(fit.at(edge));
  }
  return places;
}

}  // namespace sprekk::fine_fracture
