// From a model to the same model on a mesh that has grown.
#pragma once

#include <memory>

#include "framework/remeshing/extend_fractures.hpp"
#include "framework/scene/model.hpp"

namespace sprekk {

/// Carries the accepted values of all fields over: what lies on cells that were kept, and on fractures, to the bit; on
/// cells that are new the area-weighted mean of what was there (Eq. 17 of the paper), of amounts the sum of their
/// shares, so that totals stay. New fracture cells have the values that their components start with. Throws
/// std::logic_error for fields on faces and nodes, which have no mapping.
void transfer_fields(const FieldStore& before, const MeshChange& change, const Mesh& old_mesh, FieldStore& after);

struct MeshChangeResult {
  std::unique_ptr<Model> model;  ///< its state is accepted
  double smallest_angle = 0;     ///< rad, of the new cells
  StepStatus settling;           ///< of the solve that put it into equilibrium
};

/// Builds the model on the mesh with the extensions of a step (an index into Model::growing), carries the
/// accepted state over and settles it (GrowStep::settle, with data as in the step `data`), so that the change of the
/// mesh alone changes no pressure.
MeshChangeResult change_mesh(const Model& before, std::size_t grow_step, const std::vector<PathExtension>& extensions,
                             const StepTime& data, IterationLog log = {});

}  // namespace sprekk
