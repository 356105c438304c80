#include "framework/scene/crossings.hpp"

#include <algorithm>

#include "framework/mesh/geometry.hpp"
#include "framework/mesh/search/point_location.hpp"
#include "framework/scene/fracture_set.hpp"

namespace sprekk {

void Crossings::declare(Spec& spec, const std::string& key, const About& about) {
  static Entry example;
  const auto entry_spec = [key, about](Entry& entry) {
    Spec inner("crossing", "What fills the crossings of some fractures.");
    inner.texts("between", entry.between,
                {.doc = "The fractures that meet there, `joints_*` for all that begin so; without it all."});
    inner.text("through", entry.through, {.doc = "The fracture that goes through: all others end at its walls."});
    inner.quantity(key, entry.conductivity, about);
    inner.check([key, &entry](const Node& node) {
      if (entry.through.empty() == !entry.conductivity)
        throw InputError(node.origin, "'" + node.path + "' does not say what fills the crossing",
                         "it is one of 'through' and '" + key + "'", "give one of them");
    });
    return inner;
  };
  spec.named_sections("crossings", entry_spec(example),
                      [this, entry_spec](const std::string& name, const Origin& origin) {
                        entries_[name].origin = origin;
                        return entry_spec(entries_[name]);
                      },
                      {.doc = "What fills crossings, by any names."});
}

void Crossings::check_names(const Mesh& mesh) const {
  for (const auto& [name, entry] : entries_) {
    const std::vector<char> among = fracture_set(mesh, entry.between, entry.origin);
    if (entry.through.empty()) continue;
    const int through = find_fracture(mesh, entry.through);
    if (through == none) {
      std::vector<std::string> names;
      for (const Fracture& fracture : mesh.fractures) names.push_back(fracture.name);
      throw unknown_name(entry.origin, "fracture", entry.through, names);
    }
    if (!among.empty() && !among[mesh.fractures[through].first_cell])
      throw InputError(entry.origin, "'" + entry.through + "' goes through crossings that it has no part in",
                       "it is not one of 'between'", "add it there, or name another fracture");
  }
}

std::vector<int> Crossings::junctions_of(const Entry& entry, const Mesh& mesh) {
  const std::vector<char> among = fracture_set(mesh, entry.between, entry.origin);
  const int through = entry.through.empty() ? none : find_fracture(mesh, entry.through);
  std::vector<int> junctions;
  for (std::size_t j = 0; j < mesh.junctions.size(); ++j) {
    const std::vector<int>& cells = mesh.junctions[j].cells;
    const bool has_all = among.empty() || std::ranges::all_of(cells, [&](int cell) { return among[cell] != 0; });
    const bool has_through = through == none || std::ranges::any_of(cells, [&](int cell) {
                               return mesh.fracture_cells[cell].fracture == through;
                             });
    if (has_all && has_through) junctions.push_back(static_cast<int>(j));
  }
  return junctions;
}

std::vector<CrossingFill> Crossings::fills(const Mesh& mesh) const {
  std::vector<CrossingFill> fills(mesh.junctions.size());
  std::vector<const std::string*> said_by(mesh.junctions.size(), nullptr);
  for (const auto& [name, entry] : entries_)
    for (const int j : junctions_of(entry, mesh)) {
      if (said_by[j])
        throw InputError(entry.origin, "'" + name + "' says what fills a crossing that is filled",
                         "'" + *said_by[j] + "' says it for the crossing at " +
                             to_text(mesh.ridges[mesh.junctions[j].ridges.front()].center),
                         "name the fractures under 'between', so that each crossing belongs to one of them");
      said_by[j] = &name;
      if (entry.conductivity) fills[j].resistivity = 1 / *entry.conductivity;
      if (!entry.through.empty()) fills[j].through = find_fracture(mesh, entry.through);
    }
  return fills;
}

void Crossings::note_input(const Mesh& mesh, const std::string& owner, Notes& notes) const {
  for (const auto& [name, entry] : entries_)
    if (junctions_of(entry, mesh).empty())
      notes.add(owner + ".crossings." + name + " without effect",
                entry.origin.text() + ": '" + name + "' of '" + owner +
                    ".crossings' has no effect (its fractures do not meet) remove it, or name fractures that cross");
}

const Origin* Crossings::find_through() const {
  for (const auto& [name, entry] : entries_)
    if (!entry.through.empty()) return &entry.origin;
  return nullptr;
}

}  // namespace sprekk
