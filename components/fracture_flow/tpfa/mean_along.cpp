#include "components/fracture_flow/tpfa/mean_along.hpp"

#include <algorithm>
#include <array>
#include <utility>

namespace sprekk::fracture_flow {

const EndRule& end_rule() {
  static const EndRule rule = [] {
    // Abramowitz and Stegun, table 25.4.
    constexpr std::array<double, 5> place = {0.148874338981631211, 0.433395394129247191, 0.679409568299024406,
                                             0.865063366688984511, 0.973906528517171720};
    constexpr std::array<double, 5> weight = {0.295524224714752870, 0.269266719309996355, 0.219086362515982044,
                                              0.149451349150580593, 0.066671344308688138};
    EndRule made;
    for (int i = 0; i < EndRule::count; ++i) {
      const int k = i % 5;
      const double u = i < 5 ? -place[k] : place[k];
      made.x[i] = 0.5 * u * (3 - u * u);
      made.weight[i] = 0.75 * (1 - u * u) * weight[k];
    }
    return made;
  }();
  return rule;
}

namespace {

Piece piece_of(const Mesh& mesh, int i, const Point& from, const Point& to) {
  const Place place = fracture_cell_place(mesh, i);
  return {from, to, place.region, place.fracture};
}

}  // namespace

std::vector<Piece> whole_cells(const Mesh& mesh) {
  std::vector<Piece> pieces;
  for (int i = 0; i < mesh.fracture_cell_count(); ++i) {
    const FractureCell& cell = mesh.fracture_cells[i];
    if (dimension == 2) {
      const Point half = 0.5 * cell.measure * cell.tangents.col(0);
      pieces.push_back(piece_of(mesh, i, cell.center - half, cell.center + half));
    } else {
      pieces.push_back(piece_of(mesh, i, cell.center, cell.center));
      for (const int node : mesh.face_nodes[cell.faces[0]]) pieces.back().corners.push_back(mesh.nodes[node]);
    }
  }
  return pieces;
}

std::vector<Piece> parts_of_cells(const Mesh& mesh, int place) {
  if (dimension == 3) {
    std::vector<Piece> pieces;
    for (int i = 0; i < mesh.fracture_cell_count(); ++i) {
      const FractureCell& cell = mesh.fracture_cells[i];
      const int ridge = cell.ridges[place < static_cast<int>(cell.ridges.size()) ? place : 0];
      pieces.push_back(piece_of(mesh, i, cell.center, mesh.ridges[ridge].center));
    }
    return pieces;
  }
  std::vector<Piece> pieces = whole_cells(mesh);
  for (Piece& piece : pieces) {
    const Point center = 0.5 * (piece.from + piece.to);
    (place == 0 ? piece.to : piece.from) = center;
  }
  return pieces;
}

int most_ridges(const Mesh& mesh) {
  std::size_t most = 0;
  for (const FractureCell& cell : mesh.fracture_cells) most = std::max<std::size_t>(most, cell.ridges.size());
  return static_cast<int>(most);
}

MeansAlong::MeansAlong(const Data& data, std::vector<Piece> pieces, Mean mean, double start)
    : data_(data), pieces_(std::move(pieces)), mean_(mean) {
  set([&](const Point& x, const Piece& piece) { return data_.at({x, piece.region, start, piece.fracture}); });
}

void MeansAlong::evaluate(const StepTime& step) {
  if (data_.depends_on_time())
    set([&](const Point& x, const Piece& piece) {
      return value_in_step(data_, {x, piece.region, 0, piece.fracture}, step);
    });
}

template <typename At>
void MeansAlong::set(const At& at) {
  Vector values(pieces_.size());
  for (std::size_t i = 0; i < pieces_.size(); ++i) {
    const Piece& piece = pieces_[i];
    if (!data_.depends_on_space()) {
      values[i] = at(0.5 * (piece.from + piece.to), piece);
    } else if (mean_ == Mean::of_values) {
      values[i] = mean_along(piece, [&](const Point& x) { return at(x, piece); });
    } else {
      values[i] = 1 / mean_along(piece, [&](const Point& x) { return 1 / at(x, piece); });
    }
  }
  values_ = std::move(values);
}

}  // namespace sprekk::fracture_flow
