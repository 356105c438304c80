// The entities of a mesh file of version 4.1: the points, curves, surfaces and volumes that groups are made of.
#pragma once

#include <map>
#include <optional>
#include <utility>
#include <vector>

namespace sprekk {

class MshCursor;

/// Knows the groups of each entity. An element of such a file names its entity, and not its group.
class MshEntities {
 public:
  /// Reads a section $Entities or $PartitionedEntities, and appends a list of groups to `group_lists` for each entity.
  /// Throws InputError for a malformed section.
  void read(MshCursor& cursor, bool is_partitioned, std::vector<std::vector<int>>& group_lists);
  /// The index of the list of an entity; nothing where no section has listed the entity. An entity of a partition comes
  /// before one of the whole mesh.
  std::optional<int> groups_of(int dimension, int number) const;
  bool empty() const { return entities_.empty() && partitioned_.empty(); }

 private:
  void read_entity(MshCursor& cursor, int dimension, bool is_partitioned, std::vector<std::vector<int>>& group_lists);

  std::map<std::pair<int, int>, int> entities_, partitioned_;  ///< list of groups, by dimension and number
};

}  // namespace sprekk
