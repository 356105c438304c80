#include "framework/field/field.hpp"

#include <stdexcept>

#include "framework/invariants.hpp"

namespace sprekk {

int entity_count(const Mesh& mesh, Location location) {
  switch (location) {
    case Location::cell:
      return mesh.cell_count();
    case Location::face:
      return mesh.face_count();
    case Location::node:
      return mesh.node_count();
    case Location::fracture_cell:
      return mesh.fracture_cell_count();
    case Location::ridge:
      return static_cast<int>(mesh.ridges.size());
    case Location::wall:
      return mesh.wall_count();
    case Location::listed:
      throw std::logic_error("the mesh does not know how long a list is");
  }
  throw std::logic_error("unknown location");
}

Field::Field(FieldSpec spec, int entities)
    : spec_(std::move(spec)), entities_(entities), now_(Vector::Zero(entities * spec_.components)), accepted_(now_) {
  SPREKK_EXPECT(entities >= 0 && spec_.components > 0, name(), entities, spec_.components);
  SPREKK_EXPECT(!spec_.owner.empty() && !spec_.name.empty(), name());
  if (spec_.is_amount && (spec_.location == Location::node || spec_.location == Location::face))
    throw std::logic_error("field " + name() + ": amounts are on cells, fracture cells or walls");
  if (spec_.role.is_derived() || !is_bulk(spec_.role.kind())) return;
  if (spec_.location != Location::cell && spec_.location != Location::face && spec_.location != Location::node &&
      spec_.location != Location::listed)
    throw std::logic_error("field " + name() + ": a block of the bulk is on its cells, faces or nodes, or listed");
  const int components = spec_.role.kind() == BlockKind::bulk_elastic ? dimension : 1;
  if (spec_.components != components)
    throw std::logic_error("field " + name() + ": a block of this kind has " + std::to_string(components) +
                           " components, not " + std::to_string(spec_.components));
}

void Field::set(Vector values) {
  if (values.size() != size()) throw std::logic_error("field " + name() + ": wrong number of values");
  now_ = std::move(values);
  ++version_;
}

void Field::set_accepted(Vector values) {
  if (values.size() != size()) throw std::logic_error("field " + name() + ": wrong number of values");
  accepted_ = std::move(values);
  accepted_version_ = ~++given_;  // never the version of current values: these count up from 0
}

void Field::accept() {
  SPREKK_ASSERT(now_.size() == size(), name(), now_.size(), size());
  if (accepted_version_ == version_) return;
  accepted_ = now_;
  accepted_version_ = version_;
}

void Field::rewind() {
  SPREKK_ASSERT(accepted_.size() == size(), name(), accepted_.size(), size());
  set(accepted_);
  accepted_version_ = version_;
}

void Field::set_both(Vector values) {
  set(std::move(values));
  accept();
}

void Field::determine(const std::string& coupler) {
  SPREKK_EXPECT(spec_.role.is_input(), name(), coupler);
  SPREKK_EXPECT(!coupler.empty(), name());
  if (!determined_by_.empty())
    throw std::logic_error(name() + " is determined by " + determined_by_ + " already, and again by " + coupler);
  determined_by_ = coupler;
}

}  // namespace sprekk
