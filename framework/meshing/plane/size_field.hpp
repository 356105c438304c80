// The wanted edge length of a mesh, as a function of place.
#pragma once

#include "framework/mesh/plane/planar.hpp"
#include "framework/meshing/geometry.hpp"
#include "framework/meshing/plane/size_sources.hpp"

namespace sprekk {

/// The wanted edge length, m. It is the smallest of
/// - the far size;
/// - for each fracture its size plus growth times the distance from it;
/// - for each fracture end inside the box the tip size plus growth times the distance from the end;
/// - for each short piece of a fracture its length plus growth (at most a half) times the distance. A piece lies
///   between points where the fracture bends or meets other lines; it is short below a tenth of the lengths above;
/// - for each narrow gap its width over gap_edges, plus growth (at most a half) times the distance. A gap is narrow
///   below the lengths above, and no longer than gap_length allows.
class SizeField {
 public:
  /// The geometry is that of a box and valid, except that sizes may still be absurdly small.
  SizeField(const Geometry& geometry, const MeshOptions& options);

  double at(const Point& x) const;
  double smallest() const;  ///< the smallest edge length anywhere, m

  /// An upper estimate of the number of triangles that the size field asks for: the integral of 4 / (sqrt(3) h^2), with
  /// the far size over the whole box, and what each source of shorter edges adds to it, as if it were alone.
  double estimated_triangles() const;

 private:
  /// Adds a source if it asks for a length below the far size.
  void add_source(const Segment& segment, double size, double growth);
  void add_short_pieces(const Geometry& geometry);
  void add_gaps(const Geometry& geometry, const MeshOptions& options);

  Box box_;
  double far_size_, growth_;
  SizeSources sources_;
};

}  // namespace sprekk
