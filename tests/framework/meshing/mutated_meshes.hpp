// Mesh files, and the same with mistakes drawn at random.
#pragma once

#include <random>
#include <string>
#include <vector>

namespace sprekk::test {

/// Files that gmsh writes of one small geometry with regions, sides and fractures: versions 2.2 and 4.1, text and
/// binary, with and without parameters of nodes, triangles and quadrilaterals.
std::vector<std::string> meshes_of_gmsh();

/// One to four mistakes: bytes changed, taken out, repeated or put in; numbers replaced by what is too large, negative,
/// or none; the end cut off. The same for the same state of `random` everywhere.
std::string mutated(std::string bytes, std::mt19937& random);

/// What reading the file and building the mesh of it ends with: "" for a mesh or a refusal with a message, otherwise
/// what is wrong (an exception that is no InputError, an empty message).
std::string failure_of_reading(const std::string& file);

}  // namespace sprekk::test
