// The keys by which scenes give the places of fractures and regions; plane and space have different ones.
#pragma once

#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "framework/config/spec.hpp"
#include "framework/meshing/geometry.hpp"

namespace sprekk {

extern const char* const fracture_doc;   ///< what a fracture is, for `explain`
extern const char* const table_columns;  ///< what tables of fractures hold

/// What a scene says of the place of a fracture. Lengths in m, angles in rad.
struct FracturePlace {
  std::vector<Point> points;
  std::optional<Point> center;
  std::optional<double> length, angle;        ///< `angle` in a plane
  std::optional<double> strike, dip, height;  ///< in space
  std::vector<double> radius;                 ///< in space
};

/// Adds the keys of a place.
void add_place(Spec& spec, const std::shared_ptr<FracturePlace>& place);

/// Gives the fracture this place. Throws InputError for one that is not complete, or given twice.
void take_place(const FracturePlace& place, const Node& whole, FractureGeometry& fracture);

/// A region; `keep` takes it as it is read.
Spec region_spec(const std::string& name, const Origin& origin, std::function<void(RegionGeometry)> keep);

}  // namespace sprekk
