// Fields: named values on the entities of the mesh, at two time levels.
#pragma once

#include <cstdint>
#include <string>

#include "framework/field/role.hpp"
#include "framework/mesh/mesh.hpp"
#include "framework/types.hpp"

namespace sprekk {

/// The entities that carry a field's values. Walls are numbered 2 i + side for fracture cell i; ridges are what lies
/// between fracture cells, or ends fractures. `listed`: entities of a list that the owner keeps, without a place on the
/// mesh; few, all on the first process, and the same after a change of the mesh.
enum class Location { cell, face, node, fracture_cell, ridge, wall, listed };
/// The number of entities in the whole mesh, not those of this process alone. Throws std::logic_error for listed
/// entities, which the mesh does not know.
int entity_count(const Mesh& mesh, Location location);

/// What a field is: its owner, name, place on the mesh, components for each entity, role and unit.
struct FieldSpec {
  std::string owner;  ///< the component's name in the scene
  std::string name;
  Location location;
  int components = 1;
  int listed = 0;  ///< the number of entities, for Location::listed only
  Role role;       ///< with the kind of its block, where it is solved for
  std::string unit;
  std::string doc;
  /// For an input that makes no sense unless a coupler determines it: the type of that coupler; else "".
  std::string needs_coupler = "";
  /// Of a derived field that keeps the cumulative balance of another (what has been stored, what has flowed out): that
  /// field's full name. Both are accepted together, also after a substep.
  std::string accepted_with = "";
  /// For fields on cells, fracture cells and walls: whether the value is an amount in the entity (m^2 of fluid), and
  /// not a density or a mean. When the mesh changes, amounts are divided by measure, and all other values are averaged
  /// (Eq. 17 of the paper). Nodes and faces have no measure to divide by.
  bool is_amount = false;
  /// Whether equations take the change of the value in a step for a path (slip, against which friction acts) and not
  /// for a rate. Both stages of a scheme with two stages then start from the same accepted value, because slip from an
  /// extrapolated start would stay.
  bool is_path_dependent = false;
  std::string full_name() const { return owner + "." + name; }
};

/// Values on entities of the mesh, at two time levels. Values are entity-major: value c of entity i is
/// values[i * components + c].
class Field {
 public:
  /// Throws std::logic_error where the kind of the block does not fit: an elastic one has `dimension` components, an
  /// elliptic one has one, and neither is on fractures; and for amounts on nodes or faces.
  Field(FieldSpec spec, int entities);

  const FieldSpec& spec() const { return spec_; }
  std::string name() const { return spec_.full_name(); }
  int entities() const { return entities_; }
  int size() const { return entities_ * spec_.components; }

  const Vector& now() const { return now_; }            ///< the current iterate
  const Vector& accepted() const { return accepted_; }  ///< at the end of the last accepted step
  std::uint64_t version() const { return version_; }    ///< changes whenever `now` does
  /// The version at which `now` had the accepted values, or a number that no version has.
  std::uint64_t accepted_version() const { return accepted_version_; }

  void set(Vector values);  ///< throws std::logic_error if the size differs
  void set_both(Vector values);
  void accept();
  void set_accepted(Vector values);
  void rewind();

  /// For inputs: the coupler that determines the field, "" when the field keeps its given value.
  const std::string& determined_by() const { return determined_by_; }
  void determine(const std::string& coupler);  ///< throws std::logic_error if another coupler does already
  /// Whether the field is solved for somewhere: an unknown, or an input that a coupler determines.
  bool is_solved() const { return spec_.role.is_unknown() || (spec_.role.is_input() && !determined_by_.empty()); }

 private:
  FieldSpec spec_;
  int entities_;
  Vector now_, accepted_;
  std::uint64_t version_ = 0, accepted_version_ = 0, given_ = 0;
  std::string determined_by_;
};

}  // namespace sprekk
