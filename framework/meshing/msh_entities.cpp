#include "framework/meshing/msh_entities.hpp"

#include <algorithm>
#include <array>
#include <cstdlib>
#include <string>

#include "framework/meshing/msh_cursor.hpp"

namespace sprekk {

void MshEntities::read(MshCursor& cursor, bool is_partitioned, std::vector<std::vector<int>>& group_lists) {
  if (is_partitioned) {
    cursor.number("the number of partitions");
    const std::size_t ghosts = cursor.wide_count("the number of ghost entities", 8, 2);
    for (std::size_t i = 0; i < 2 * ghosts; ++i) cursor.integer("a ghost entity");
  }
  std::array<std::size_t, 4> counts;
  const std::size_t ints = is_partitioned ? 4 : 1;
  for (std::size_t& count : counts) {
    count = cursor.wide_count("the number of entities", 4 * ints + 32, ints + 4);
  }
  for (int dimension = 0; dimension < 4; ++dimension) {
    for (std::size_t i = 0; i < counts[dimension]; ++i) read_entity(cursor, dimension, is_partitioned, group_lists);
  }
}

void MshEntities::read_entity(MshCursor& cursor, int dimension, bool is_partitioned,
                              std::vector<std::vector<int>>& group_lists) {
  const std::size_t begin = cursor.position();
  const int number = cursor.integer("an entity's number");
  if (is_partitioned) {
    cursor.integer("the parent's dimension");
    cursor.integer("the parent's number");
    const std::size_t partitions = cursor.wide_count("the number of partitions", 4, 1);
    for (std::size_t i = 0; i < partitions; ++i) cursor.integer("a partition");
  }
  const int reals = dimension == 0 ? 3 : 6;
  for (int i = 0; i < reals; ++i) cursor.real("a coordinate");
  std::vector<int> groups(cursor.wide_count("the number of groups", 4, 1));
  for (int& group : groups) {
    group = cursor.integer("a group's number");
    if (group == 0 || group == -2147483647 - 1) cursor.fail("there is no group " + std::to_string(group));
    group = std::abs(group);  // the sign gives the orientation of the entity
  }
  std::sort(groups.begin(), groups.end());
  groups.erase(std::unique(groups.begin(), groups.end()), groups.end());
  if (dimension > 0) {
    const std::size_t borders = cursor.wide_count("the number of bordering entities", 4, 1);
    for (std::size_t i = 0; i < borders; ++i) cursor.integer("a bordering entity");
  }
  // Entities of a partition may have the same numbers as entities of the whole mesh.
  auto& known = is_partitioned ? partitioned_ : entities_;
  if (!known.try_emplace({dimension, number}, static_cast<int>(group_lists.size())).second) {
    cursor.fail_at(
        begin, "entity " + std::to_string(number) + " of dimension " + std::to_string(dimension) + " is there twice");
  }
  group_lists.push_back(std::move(groups));
}

std::optional<int> MshEntities::groups_of(int dimension, int number) const {
  for (const auto* known : {&partitioned_, &entities_})
    if (const auto found = known->find({dimension, number}); found != known->end()) return found->second;
  return std::nullopt;
}

}  // namespace sprekk
