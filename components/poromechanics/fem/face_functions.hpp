// The functions of a face: their integrals over it, and displacements that are made of them.
#pragma once

#include <vector>

#include "components/poromechanics/fem/raw_displacement.hpp"
#include "framework/types.hpp"

namespace sprekk::poromechanics {

/// A function that is not 0 on a face.
struct FaceFunction {
  int coefficient;  ///< the first of its coefficients (RawDisplacement)
  double mean;      ///< over the face
  Point flow;       ///< its integral times the normal of the face, m (m^2 in space)
};

/// The functions of the nodes of a face, in their order, those of the edges from each node to the next, if there are
/// some, and that of the face. `tips`: see tips_of_faces; may be empty.
std::vector<FaceFunction> face_functions(const RawDisplacement& raw, const std::vector<int>& tips, int face);

/// A point of integrals over a face.
struct FacePoint {
  Point x;                    ///< m
  double weight;              ///< m (m^2 in space)
  Point normal;               ///< unit, out of face_cells[f][0], at this point
  std::vector<double> value;  ///< of each of face_functions; in a plane where middle nodes are in the middle
};
std::vector<FacePoint> face_points(const RawDisplacement& raw, int face);

/// Where the function of a face is 1, m.
Point middle_of_face(const RawDisplacement& raw, int face);

/// The edges of a face, from each of its nodes to the next; empty where there are no functions of edges.
std::vector<int> edges_of_face(const RawDisplacement& raw, int face);
/// The function of each of them in the middle of the face.
double edge_in_middle(const Mesh& mesh, int face);

/// The displacement there, m. `coefficients`: all (RawDisplacement).
Point displacement_of_middle(const RawDisplacement& raw, const std::vector<int>& tips, const Vector& coefficients,
                             int face);

/// The mean of the gradient of a displacement over a cell.
Tensor mean_gradient(const RawDisplacement& raw, const std::vector<int>& tips, const Vector& coefficients, int cell);

}  // namespace sprekk::poromechanics
