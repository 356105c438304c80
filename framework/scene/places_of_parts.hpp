// The cells for which properties of a component or a coupler have values.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "framework/config/data.hpp"
#include "framework/field/field_store.hpp"
#include "framework/mesh/mesh.hpp"
#include "framework/scene/component.hpp"

namespace sprekk {

/// Finds the cells in which a component has its values: fracture cells where all of its fields are on fractures, else
/// cells of the matrix; of these, the ones that it lives in (LivesInPart).
class PlacesOfParts {
 public:
  /// All of these must outlive this object, unchanged.
  PlacesOfParts(const Mesh& mesh, const FieldStore& fields, const std::vector<std::unique_ptr<Component>>& components)
      : mesh_(mesh), fields_(fields), components_(components) {}

  /// The cells of the components with these names: of one component, or of all that a coupler stands between.
  std::vector<Place> of(const std::vector<std::string>& components) const;
  const Mesh& mesh() const { return mesh_; }

 private:
  bool is_on_fractures(const Component& component) const;

  const Mesh& mesh_;
  const FieldStore& fields_;
  const std::vector<std::unique_ptr<Component>>& components_;
};

}  // namespace sprekk
