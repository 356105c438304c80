// The wanted edge length of a mesh, as a function of place.
#pragma once

#include <vector>

#include "framework/mesh/planar.hpp"
#include "framework/meshing/geometry.hpp"

namespace sprekk {

/// The wanted edge length, m. It is the smallest of: the far size; for each fracture its size plus growth times the
/// distance from it; for each fracture end inside the box the tip size plus growth times the distance from the end; for
/// each gap that is narrower than these lengths, and no longer than gap_length allows, its width over gap_edges plus
/// growth (at most a half) times the distance.
class SizeField {
 public:
  /// The geometry is that of a box and valid, except that sizes may still be absurdly small.
  SizeField(const Geometry& geometry, const MeshOptions& options);

  double at(const Point& x) const;
  double smallest() const;  ///< the smallest edge length anywhere, m

  /// An upper estimate of the number of triangles that the size field asks for: the integral of 4 / (sqrt(3) h^2),
  /// separately for the box, the fractures and their ends.
  double estimated_triangles() const;

 private:
  struct Source {
    Segment segment;  ///< a point when from == to
    double size;
    double growth;
    double reach;  ///< the distance at which the far size is reached
  };
  /// Adds a source if it asks for a length below the far size; returns whether it does.
  bool add_source(const Segment& segment, double size, double growth);
  void add_gaps(const Geometry& geometry, const MeshOptions& options);
  static double lowered(double size, const Source& source, const Point& x);
  void fill_buckets();
  void put_into_buckets(int source);
  int bucket(int axis, double coordinate) const;

  Box box_;
  double far_size_, growth_;
  std::vector<Source> sources_;
  int buckets_a_side_ = 1;
  std::vector<std::vector<int>> buckets_;  ///< the sources that reach into each part of the box
};

}  // namespace sprekk
