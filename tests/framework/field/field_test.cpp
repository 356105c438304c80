// What the declaration of a field must contain.
#include "framework/field/field.hpp"

#include <gtest/gtest.h>

#include <stdexcept>
#include <type_traits>

namespace sprekk {
namespace {

FieldSpec spec(Location location, int components, Role role) {
  return {.owner = "part",
          .name = "value",
          .location = location,
          .components = components,
          .role = role,
          .unit = "",
          .doc = ""};
}

// A field that does not say what its equations are to linear solvers does not compile.
static_assert(!std::is_default_constructible_v<Role>);
static_assert(!std::is_default_constructible_v<FieldSpec>);

TEST(Field, HasABlockThatFitsItsPlaceAndItsComponents) {
  using enum Location;
  EXPECT_NO_THROW(Field(spec(cell, dimension, Role::unknown(BlockKind::bulk_elastic)), 4));
  EXPECT_NO_THROW(Field(spec(cell, 1, Role::unknown(BlockKind::bulk_elliptic)), 4));
  EXPECT_NO_THROW(Field(spec(wall, 2, Role::input(BlockKind::interface)), 4));
  EXPECT_NO_THROW(Field(spec(cell, 3, Role::derived()), 4));
  EXPECT_THROW(Field(spec(cell, 1, Role::unknown(BlockKind::bulk_elastic)), 4), std::logic_error);
  EXPECT_THROW(Field(spec(cell, 2, Role::unknown(BlockKind::bulk_elliptic)), 4), std::logic_error);
  for (const Location on_fractures : {fracture_cell, ridge, wall})
    EXPECT_THROW(Field(spec(on_fractures, 1, Role::input(BlockKind::bulk_elliptic)), 4), std::logic_error);
}

TEST(Field, HasAmountsWhereThereIsAMeasure) {
  using enum Location;
  for (const Location place : {cell, fracture_cell, wall, node, face}) {
    FieldSpec amounts = spec(place, 1, Role::derived());
    amounts.is_amount = true;
    if (place == node || place == face)
      EXPECT_THROW(Field(amounts, 4), std::logic_error);
    else
      EXPECT_NO_THROW(Field(amounts, 4));
  }
}

TEST(Field, IsSolvedForAsAnUnknownOrAsAnInputThatACouplerDetermines) {
  EXPECT_TRUE(Field(spec(Location::cell, 1, Role::unknown(BlockKind::interface)), 1).is_solved());
  EXPECT_FALSE(Field(spec(Location::cell, 1, Role::derived()), 1).is_solved());
  Field input(spec(Location::cell, 1, Role::input(BlockKind::interface)), 1);
  EXPECT_FALSE(input.is_solved());
  input.determine("coupler");
  EXPECT_TRUE(input.is_solved());
}

}  // namespace
}  // namespace sprekk
