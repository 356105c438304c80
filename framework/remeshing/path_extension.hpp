// A path along which a fracture is to grow, and the error for one that it cannot take.
#pragma once

#include <stdexcept>
#include <string>
#include <vector>

#include "framework/mesh/mesh.hpp"

namespace sprekk {

/// New segments at an end of a fracture.
struct PathExtension {
  int fracture;               ///< index into Mesh::fractures
  bool at_end;                ///< at the last (true) or the first point of the polyline
  std::vector<Point> points;  ///< m, from the old tip, or the anchor of replaced cells, (exclusive) on
  /// So many fracture cells at this end, counted from the tip, are given up: the rock closes there, and the path begins
  /// at the fracture point before them, the anchor. They must be grown cells, and the path as long as they are.
  int replaced = 0;
  /// Each segment becomes one fracture cell, however long it is; more only where it crosses or follows an interface
  /// between regions.
  bool whole_segments = false;
  bool divides = false;  ///< the first point lies on the replaced cells: it divides them
};

/// A path that a fracture cannot take, with place and reason, so that the caller can stop the growth of that fracture.
class ExtensionError : public std::runtime_error {
 public:
  /// Why the path is refused.
  enum class Reason {
    no_tip,            ///< the end lies on the outer boundary or on another fracture, or the end is extended twice
    no_path,           ///< no points, points that are not finite, or segments without length
    turns_back,        ///< turns by more than 90 degrees
    leaves_mesh,       ///< crosses the outer boundary
    crosses_fracture,  ///< crosses or touches a fracture (another, itself, an extension) other than at a fracture point
    too_near,          ///< passes a fracture or the outer boundary at less than least_gap sizes
    not_replaceable    ///< gives up cells that have not grown, or that others join, or more length than it gets
  };
  ExtensionError(Reason reason, int extension, const Point& where, const std::string& what)
      : std::runtime_error(what), reason_(reason), extension_(extension), where_(where) {}
  Reason reason() const { return reason_; }
  int extension() const { return extension_; }  ///< index into the list that was given
  const Point& where() const { return where_; }

 private:
  Reason reason_;
  int extension_;
  Point where_;
};

}  // namespace sprekk
