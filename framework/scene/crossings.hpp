// What a scene says about the crossings of fractures.
#pragma once

#include <map>
#include <optional>
#include <string>
#include <vector>

#include "framework/assembly/notes.hpp"
#include "framework/config/spec.hpp"
#include "framework/mesh/mesh.hpp"
#include "framework/mesh/ways_to_middle.hpp"

namespace sprekk {

/// The section `crossings` of a component that conducts along fractures: entries by name, each with the fill of the
/// crossings of some fractures.
class Crossings {
 public:
  /// Adds the section to a spec. `key`: the component's name for the conductivity of the fill; `about`: its unit and a
  /// sentence.
  void declare(Spec& spec, const std::string& key, const About& about);
  /// Throws InputError for a name that no fracture has, and for a `through` that is not among `between`.
  void check_names(const Mesh& mesh) const;
  /// The fill of each junction of the mesh. Throws InputError where two entries apply to one junction.
  std::vector<CrossingFill> fills(const Mesh& mesh) const;
  /// Notes entries without a crossing; `owner`: the name of the component.
  void note_input(const Mesh& mesh, const std::string& owner, Notes& notes) const;
  /// The origin of an entry with `through`; nullptr without one.
  const Origin* find_through() const;

 private:
  struct Entry {
    Origin origin;
    std::vector<std::string> between;  ///< names, `joints_*` for all that begin so; empty for all fractures
    std::string through;
    std::optional<double> conductivity;
  };
  /// The junctions at which only fractures of the entry meet, including the one of `through`.
  static std::vector<int> junctions_of(const Entry& entry, const Mesh& mesh);

  std::map<std::string, Entry> entries_;
};

}  // namespace sprekk
