#include "couplers/advection/streams.hpp"

#include <algorithm>
#include <map>

#include "framework/parallel/parallel.hpp"

namespace sprekk::couplers {
namespace {

/// A stream from outside, with the value that is known for it.
Stream from_outside(int cell, double rate, std::optional<double> value) {
  Stream stream{cell, rate, value ? Stream::From::given : Stream::From::own};
  if (value) stream.value = *value;
  stream.is_outside = true;
  return stream;
}

Stream with_flux(Stream stream, Stream::Flux flux, int index, double by_flux) {
  stream.flux = flux;
  stream.flux_index = index;
  stream.by_flux = by_flux;
  return stream;
}

/// The streams through walls into the rock (sign 1), or into the fractures (−1).
void append_walls(const StreamSources& sources, const Vector& rates, double sign, std::vector<Stream>& streams) {
  if (rates.size() == 0) return;
  const Mesh& mesh = sources.mesh;
  const bool has_both = sources.in_rock && sources.in_fractures;
  for (int w = 0; w < mesh.wall_count(); ++w) {
    const int rock_cell = mesh.face_cells[mesh.wall_face(w)][0], fracture_cell = w / 2;
    const bool into_rock = sign > 0;
    if (into_rock && mesh.cell_rank[rock_cell] != parallel::rank()) continue;
    const double length = sign * mesh.fracture_cells[fracture_cell].measure;
    Stream stream = from_outside(into_rock ? rock_cell : fracture_cell, length * rates[w], sources.unknown);
    if (has_both) {
      stream.from = into_rock ? Stream::From::fracture_cell : Stream::From::rock_cell;
      stream.index = into_rock ? fracture_cell : rock_cell;
    }
    stream.is_outside = !has_both;
    streams.push_back(with_flux(stream, Stream::Flux::wall, w, length));
  }
}

/// The streams of sources. A source whose shares have both signs takes fluid from some cells; this mixes with the fluid
/// from outside, as in a well, and enters the other cells.
void append_sources(const StreamSources& sources, const std::vector<FluidSource>& given, Stream::From inside,
                    std::vector<Stream>& streams) {
  const auto is_here = [&](int cell) {
    return inside == Stream::From::fracture_cell || sources.mesh.cell_rank[cell] == parallel::rank();
  };
  for (const FluidSource& source : given) {
    double entering = 0, leaving = 0;
    for (const auto& [cell, rate] : source.rates) (rate > 0 ? entering : leaving) += std::abs(rate);
    const bool mixes = source.is_shared && entering > 0 && leaving > 0;
    const double larger = std::max(entering, leaving);
    const std::optional<double> outside = sources.injected_value(source.name);
    for (const auto& [cell, rate] : source.rates) {
      const double mixed = mixes ? (rate > 0 ? leaving : entering) / larger : 0;
      if (is_here(cell) && mixed < 1) streams.push_back(from_outside(cell, rate * (1 - mixed), outside));
    }
    if (!mixes) continue;
    for (const auto& [from, out] : source.rates)
      for (const auto& [to, in] : source.rates) {
        if (out >= 0 || in <= 0) continue;
        const double rate = -out * in / larger;
        if (is_here(to)) streams.push_back({to, rate, inside, from});
        if (is_here(from)) streams.push_back({from, -rate, inside, to});
      }
  }
}

/// The streams out of wells into the cells that belong to the flow with this pressure, and those between such cells
/// where a share of a rate is negative (parts_in_well).
void append_wells(const StreamSources& sources, const Vector& rates, const Field* pressure, Stream::From inside,
                  std::vector<Stream>& streams) {
  if (!sources.wells || !pressure) return;
  const auto append = [&](Stream stream, int place, double share) {
    if (inside == Stream::From::rock_cell && sources.mesh.cell_rank[stream.cell] != parallel::rank()) return;
    stream.rate = share * rates[place];
    streams.push_back(with_flux(stream, Stream::Flux::well, place, share));
  };
  for (int k = 0; k < static_cast<int>(sources.wells->places().size()); ++k) {
    const AroundWell& around = sources.wells->surroundings()[k];
    if (around.pressure != pressure) continue;
    const std::vector<std::pair<int, double>> parts = parts_in_well(around);
    for (const auto& [cell, part] : parts) {
      Stream stream{cell, 0, Stream::From::well, sources.wells->places()[k].well};
      stream.is_outside = true;
      append(stream, k, part);
    }
    for (const auto& [other, share] : around.shares)
      for (const auto& [cell, part] : parts) {
        if (share >= 0) continue;
        append({cell, 0, inside, other}, k, -share * part);
        append({other, 0, inside, cell}, k, share * part);
      }
  }
}

/// The streams between the cells at a junction. Ridges have fluxes between pairs of cells by the drops of pressure; a
/// cell with an intermediate pressure would pass on fluid that never enters it. So only the net outflow q of each cell
/// counts (inflow: q < 0), and cell i gives q_i (−q_j)/S to cell j, with S the sum of all outflows.
void append_junction(const Mesh& mesh, const Junction& junction, const Vector& fluxes, std::vector<Stream>& streams) {
  std::map<int, double> given;
  for (const int ridge : junction.ridges) {
    given[mesh.ridges[ridge].cells[0]] += fluxes[ridge];
    given[mesh.ridges[ridge].cells[1]] -= fluxes[ridge];
  }
  double all = 0;
  for (const auto& [cell, rate] : given) all += std::max(rate, 0.0);
  if (all == 0) return;
  for (const auto& [from, out] : given) {
    for (const auto& [to, minus_in] : given) {
      if (out <= 0 || minus_in >= 0) continue;
      const double in = -minus_in, rate = out * in / all;
      Stream entering{to, rate, Stream::From::fracture_cell, from};
      for (const int ridge : junction.ridges) {
        const std::vector<int>& cells = mesh.ridges[ridge].cells;
        const auto by_ridge = [&](int cell) { return cell == cells[0] ? 1.0 : cell == cells[1] ? -1.0 : 0.0; };
        const auto gives = [&](int cell) { return given.at(cell) > 0 ? by_ridge(cell) : 0.0; };
        const double all_by_ridge = gives(cells[0]) + gives(cells[1]);
        const double by = (by_ridge(from) * in - out * by_ridge(to) - rate * all_by_ridge) / all;
        if (by != 0) entering.by_ridges.emplace_back(ridge, by);
      }
      streams.push_back(entering);
      streams.push_back({from, -rate, Stream::From::fracture_cell, to});
    }
  }
}

}  // namespace

std::vector<Stream> streams_of_rock(const StreamSources& sources, const FlowRates& rates, const Vector& fluxes) {
  std::vector<Stream> streams;
  if (!sources.in_rock) return streams;
  const Mesh& mesh = sources.mesh;
  for (int c = 0; c < mesh.cell_count(); ++c) {
    if (mesh.cell_rank[c] != parallel::rank()) continue;
    for (const int f : mesh.cell_faces[c]) {
      if (mesh.face_fracture_cell[f] != none || fluxes[f] == 0) continue;
      const double sign = mesh.face_cells[f][0] == c ? -1 : 1;
      Stream stream{c, sign * fluxes[f], Stream::From::rock_cell};
      if (mesh.face_cells[f][1] == none) {
        const std::optional<double> side = sources.in_rock->side_value(f);
        stream = from_outside(c, stream.rate, side ? side : sources.unknown);
      } else {
        stream.index = mesh.face_cells[f][sign < 0 ? 1 : 0];
      }
      streams.push_back(with_flux(stream, Stream::Flux::face, f, sign));
    }
  }
  append_walls(sources, rates.walls, 1, streams);
  append_sources(sources, rates.sources_in_rock, Stream::From::rock_cell, streams);
  append_wells(sources, rates.wells, sources.rock_pressure, Stream::From::rock_cell, streams);
  return streams;
}

std::vector<Stream> streams_of_fractures(const StreamSources& sources, const FlowRates& rates) {
  std::vector<Stream> streams;
  if (!sources.fracture || !sources.in_fractures) return streams;
  const Mesh& mesh = sources.mesh;
  const Vector& fluxes = rates.points;
  std::vector<bool> at_junction(mesh.ridges.size(), false);
  for (const Junction& junction : mesh.junctions)
    for (const int ridge : junction.ridges) at_junction[ridge] = true;
  for (int p = 0; p < static_cast<int>(mesh.ridges.size()); ++p) {
    if (fluxes[p] == 0 || at_junction[p]) continue;
    const Ridge& point = mesh.ridges[p];
    for (std::size_t k = 0; k < point.cells.size(); ++k) {
      const double sign = k == 0 ? -1 : 1;
      Stream stream{point.cells[k], sign * fluxes[p], Stream::From::fracture_cell};
      if (point.cells.size() == 1) {
        const std::optional<double> end = sources.in_fractures->end_value(p);
        stream = from_outside(stream.cell, stream.rate, end ? end : sources.unknown);
      } else {
        stream.index = point.cells[1 - k];
      }
      streams.push_back(with_flux(stream, Stream::Flux::ridge, p, sign));
    }
  }
  for (const Junction& junction : mesh.junctions) append_junction(mesh, junction, fluxes, streams);
  append_walls(sources, rates.walls, -1, streams);
  append_sources(sources, rates.sources_in_fractures, Stream::From::fracture_cell, streams);
  append_wells(sources, rates.wells, sources.fracture_pressure, Stream::From::fracture_cell, streams);
  Vector net = Vector::Zero(mesh.fracture_cell_count());
  for (const Stream& stream : streams) net[stream.cell] += stream.rate;
  for (const FluidReservoir& reservoir : sources.fracture->fluid_reservoirs())
    for (const int cell : reservoir.cells)
      streams.push_back(from_outside(cell, -net[cell], sources.injected_value(reservoir.name)));
  return streams;
}

}  // namespace sprekk::couplers
