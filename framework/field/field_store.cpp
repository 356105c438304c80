#include "framework/field/field_store.hpp"

#include <stdexcept>

#include "framework/invariants.hpp"

namespace sprekk {

Field& FieldStore::add(const Mesh& mesh, FieldSpec spec) {
  const std::string name = spec.full_name();
  if (has(name)) throw std::logic_error("field " + name + " exists already");
  const int entities = spec.location == Location::listed ? spec.listed : entity_count(mesh, spec.location);
  fields_.push_back(std::make_unique<Field>(std::move(spec), entities));
  by_name_[name] = fields_.back().get();
  SPREKK_ASSERT(by_name_.size() == fields_.size(), by_name_.size(), fields_.size());
  return *fields_.back();
}

Field& FieldStore::at(const std::string& full_name) {
  const auto found = by_name_.find(full_name);
  if (found == by_name_.end()) throw std::out_of_range("there is no field " + full_name);
  return *found->second;
}

const Field& FieldStore::at(const std::string& full_name) const { return const_cast<FieldStore*>(this)->at(full_name); }

bool FieldStore::has(const std::string& full_name) const { return by_name_.count(full_name) > 0; }

void FieldStore::accept() {
#ifdef SPREKK_ASSERTIONS
  for (const auto& field : fields_) SPREKK_EXPECT(is_finite(field->now()), field->name());
#endif
  for (auto& field : fields_) field->accept();
}

void FieldStore::rewind() {
  for (auto& field : fields_) field->rewind();
}

}  // namespace sprekk
