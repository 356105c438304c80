// The parameters of tips with fine levels.
#include "components/fine_fracture/tips/tips.hpp"

#include "components/capabilities/usual_ranges.hpp"

namespace sprekk::fine_fracture {

void TipsOptions::declare_size(Spec& spec) {
  spec.quantity("size", size,
                {.unit = "m",
                 .range = positive(),
                 .doc = "Side of the square around a tip; what reaches out of the rock is cut off.",
                 .source = "l of the paper's sec. 3.1",
                 .required = true});
}

void TipsOptions::declare_growth(Spec& spec) {
  spec.data(
      "toughness", toughness,
      {.unit = "Pa*m^0.5",
       .range = positive(),
       .doc = "K_IC at the place of a tip, by region of the rock or by the fracture that grows; without it tips do "
              "not grow.",
       .source = "the paper's sec. 2.5",
       .material = true});
  usually(spec, "toughness", usual_toughness());
  spec.section("toughness_anisotropy", anisotropy.spec(), {.doc = "How the toughness differs with the direction."});
  spec.choice("meeting", meeting,
              {{"join", "it joins the other fracture, at the nearest point of its mesh, unless that closes a ring"},
               {"stop", "it stops for good"}},
              {.doc = "What a tip does that has come within one coarse edge length of another fracture. The "
                      "paper has no fractures that meet."});
  spec.quantity("cavity", cavity,
                {.range = positive(),
                 .doc = "Radius around a new path within which the coarse mesh is made anew, in coarse edge lengths.",
                 .source = "the paper's sec. 4.1"});
  spec.quantity("cavity_growth", cavity_growth,
                {.range = {.low = 0, .high = 2, .low_allowed = false},
                 .doc = "By how many m the length of new coarse edges grows per m of distance from the path, where the "
                        "rest of the mesh lets it; see `mesh.growth`."});
  spec.quantity(
      "skip_below", skip_below,
      {.range = between(0, 1),
       .doc = "The fine level of a tip is not solved while twice the K_eq estimated from the jump behind the tip "
              "is below this part of the toughness; 0: always solved."});
  spec.section("growth", growth.spec(), {.doc = "How tips grow."});
}

}  // namespace sprekk::fine_fracture
