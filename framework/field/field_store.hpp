// All fields of a run. A snapshot of the store and the clock is the rewind point and the checkpoint.
#pragma once

#include <map>
#include <memory>
#include <string>
#include <vector>

#include "framework/field/field.hpp"

namespace sprekk {

/// Owns the fields of a model, in the order in which they were added, and accepts or rewinds all of them together.
class FieldStore {
 public:
  /// Adds a field of zeros. Throws std::logic_error if the name exists.
  Field& add(const Mesh& mesh, FieldSpec spec);
  Field& at(const std::string& full_name);  ///< throws std::out_of_range naming the field
  const Field& at(const std::string& full_name) const;
  bool has(const std::string& full_name) const;

  const std::vector<std::unique_ptr<Field>>& all() const { return fields_; }
  void accept();
  void rewind();

 private:
  std::vector<std::unique_ptr<Field>> fields_;
  std::map<std::string, Field*> by_name_;
};

}  // namespace sprekk
