#include "framework/remeshing/healed_mesh.hpp"

#include <algorithm>
#include <stdexcept>
#include <string>

#include "framework/invariants.hpp"
#include "framework/mesh/build_mesh.hpp"
#include "framework/remeshing/same_ridges.hpp"
#include "framework/round_off.hpp"

namespace sprekk {
namespace {

using Reason = ExtensionError::Reason;

/// The cells that an extension replaces, from the anchor on.
class ReplacedCells {
 public:
  ReplacedCells(const Mesh& mesh, const PathExtension& extension, int index)
      : mesh_(mesh), extension_(extension), index_(index) {
    const auto& [name, first, count] = mesh.fractures[extension.fracture];
    const int last = first + count - 1;
    for (int n = extension.replaced; n-- > 0;) cells_.push_back(extension.at_end ? last - n : first + n);
  }

  std::vector<int> checked() const {
    if (cells_.empty()) return {};
    const Ridge& tip = mesh_.ridges[outer_point(cells_.back())];
    if (tip.kind != Ridge::Kind::tip)
      refuse(Reason::no_tip, tip.center, "already ends",
             tip.kind == Ridge::Kind::junction ? "at another fracture" : "on the outer boundary");
    double replaced_length = 0;
    for (const int cell : cells_) {
      const Ridge& point = mesh_.ridges[inner_point(cell)];
      if (!mesh_.fracture_cells[cell].grown)
        refuse(Reason::not_replaceable, mesh_.fracture_cells[cell].center, "would close", "it has not grown there");
      if (point.kind == Ridge::Kind::junction)
        refuse(Reason::not_replaceable, point.center, "would close", "another fracture meets it there");
      replaced_length += mesh_.fracture_cells[cell].measure;
    }
    check_length(replaced_length);
    return cells_;
  }

  std::vector<Segment> scars() const {
    std::vector<Segment> scars;
    for (const int cell : cells_)
      scars.push_back({mesh_.ridges[inner_point(cell)].center, mesh_.ridges[outer_point(cell)].center});
    return scars;
  }

 private:
  int inner_point(int cell) const { return mesh_.fracture_cells[cell].ridges[extension_.at_end ? 0 : 1]; }
  int outer_point(int cell) const { return mesh_.fracture_cells[cell].ridges[extension_.at_end ? 1 : 0]; }

  void check_length(double replaced_length) const {
    if (extension_.points.empty()) return;  // refused later, like all paths without points
    Point from = mesh_.ridges[inner_point(cells_.front())].center;
    double length = 0;
    for (const Point& to : extension_.points) length += (to - from).norm(), from = to;
    if (length < (1 - rounding::same) * replaced_length)
      refuse(Reason::not_replaceable, from, "becomes shorter",
             "the new path has " + std::to_string(length / replaced_length) + " of the length of what it replaces");
  }

  [[noreturn]] void refuse(Reason reason, const Point& where, const std::string& problem,
                           const std::string& why) const {
    throw ExtensionError(reason, index_, where,
                         "fracture '" + mesh_.fractures[extension_.fracture].name + "' cannot be extended: it " +
                             problem + " at " + to_text(where) + " (" + why + ")");
  }

  const Mesh& mesh_;
  const PathExtension& extension_;
  const int index_;
  std::vector<int> cells_;
};

void check_number(const Mesh& mesh, const PathExtension& extension) {
  if (!is_index(extension.fracture, static_cast<long>(mesh.fractures.size())))
    throw std::invalid_argument("extension of fracture " + std::to_string(extension.fracture) +
                                ", which does not exist");
  if (extension.replaced < 0 || extension.replaced >= mesh.fractures[extension.fracture].cell_count)
    throw std::invalid_argument("extension that replaces " + std::to_string(extension.replaced) +
                                " fracture cells (one or more must be left)");
}

}  // namespace

HealedMesh heal_ends(const Mesh& mesh, const std::vector<PathExtension>& extensions) {
  HealedMesh healed;
  RawMesh raw = to_raw_mesh(mesh);
  std::vector<char> is_closed(mesh.fracture_cells.size(), false);
  for (int e = 0; e < static_cast<int>(extensions.size()); ++e) {
    check_number(mesh, extensions[e]);
    const ReplacedCells replaced(mesh, extensions[e], e);
    healed.replaced.push_back(replaced.checked());
    healed.scars.push_back(replaced.scars());
    for (const int cell : healed.replaced.back()) is_closed[cell] = true;
  }
  for (std::size_t f = 0; f < mesh.fractures.size(); ++f) {
    const auto& [name, first, count] = mesh.fractures[f];
    std::vector<int> chain;
    for (int i = 0; i < count; ++i) {
      if (is_closed[first + i]) continue;
      if (chain.empty()) chain.push_back(raw.fractures[f].nodes[i]);
      chain.push_back(raw.fractures[f].nodes[i + 1]);
      healed.fracture_cell.push_back(first + i);
    }
    if (chain.empty()) throw std::invalid_argument("extensions that replace all cells of fracture '" + name + "'");
    raw.fractures[f].nodes = std::move(chain);
  }
  healed.mesh = build_mesh(raw);
  SPREKK_ASSERT(healed.mesh.cell_count() == mesh.cell_count(), healed.mesh.cell_count(), mesh.cell_count());
  healed.mesh.cell_rank = mesh.cell_rank;
  for (std::size_t i = 0; i < healed.fracture_cell.size(); ++i)
    healed.mesh.fracture_cells[i].grown = mesh.fracture_cells[healed.fracture_cell[i]].grown;
  healed.ridge = same_ridges(mesh, healed.mesh, healed.fracture_cell);
  healed.face.assign(healed.mesh.face_count(), none);
  for (int cell = 0; cell < mesh.cell_count(); ++cell) {
    for (int k = 0; k < mesh.cell_faces[cell].size(); ++k) {
      const int face = mesh.cell_faces[cell][k], fracture_cell = mesh.face_fracture_cell[face];
      if (fracture_cell == none || !is_closed[fracture_cell]) healed.face[healed.mesh.cell_faces[cell][k]] = face;
    }
  }
  return healed;
}

}  // namespace sprekk
