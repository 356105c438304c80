// Builds the model again on a mesh whose fractures have grown.
#pragma once

#include <memory>

#include "framework/remeshing/extend_fractures.hpp"
#include "framework/scene/model.hpp"

namespace sprekk {

/// Transfers the accepted values of all fields to the new mesh. Values on kept cells and on fractures stay to the bit.
/// A new cell gets the area-weighted mean of the old cells that it overlaps (Eq. 17 of the paper); within old cells
/// values are linear, or given by the old parts. Amounts are shared by area, so that totals stay (transferred_cells).
/// The same holds for new fracture cells that replace old ones (means are over the part that they cover); other new
/// fracture cells keep the initial values of their components. Values on new nodes and faces are those of the old field
/// at their places (transferred_in_cells).
void transfer_fields(const FieldStore& before, const MeshChange& change, const Mesh& old_mesh, const Mesh& new_mesh,
                     FieldStore& after, const std::vector<Part*>& old_parts = {});

/// The model on the new mesh, and how its equilibrium was found.
struct MeshChangeResult {
  std::unique_ptr<Model> model;  ///< its state is accepted
  double smallest_angle = 0;     ///< rad, of the new cells
  StepStatus settling;           ///< of the solve for equilibrium on the new mesh
};

/// The mesh of a model with the extensions of a step (an index into Model::growing).
GrownMesh grow_mesh(const Model& before, std::size_t grow_step, const std::vector<PathExtension>& extensions);

/// How the mesh changes around the paths of a step.
CavityOptions cavity_of(const Model& before, std::size_t grow_step);

/// Builds the model on the changed mesh, carries the accepted state over and settles it (GrowStep::settle, with data as
/// in the step `data`), so that the change of the mesh alone changes no pressure. Before the first step nothing is
/// carried over or settled: the state is the initial one of the scene.
MeshChangeResult change_mesh(const Model& before, std::size_t grow_step, GrownMesh grown, const StepTime& data,
                             IterationLog log = {});

}  // namespace sprekk
