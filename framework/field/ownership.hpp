// Which process answers for which entity. Fields are whole on every process; operators have only owned rows.
#pragma once

#include "framework/field/field.hpp"

namespace sprekk {

/// The rank that owns an entity. Faces and nodes belong to that of their first cell.
int entity_rank(const Mesh& mesh, Location location, int entity);
bool is_owned(const Mesh& mesh, Location location, int entity);  ///< by this process

/// Gives entities that other processes own (ghosts) the values of their owners. Collective; does nothing in a single
/// process.
void exchange(const Mesh& mesh, Location location, int components, Vector& values);

/// The sum over all entities of values, one each, as their owners have them. Collective.
double sum_owned(const Mesh& mesh, Location location, const Vector& values);

/// The nodes whose interaction regions this process has to discretize: those of its own cells, and of both walls of its
/// own fracture cells, so that the rows of these are complete. Empty, meaning all, in a single process.
std::vector<char> nodes_to_discretize(const Mesh& mesh);

}  // namespace sprekk
