// poromechanics/fem: deformation with finite elements.
#include "components/poromechanics/fem/fem_rock.hpp"
#include "framework/scene/registry.hpp"

namespace sprekk::poromechanics {

Spec FemOptions::spec() {
  Spec spec = Options::spec(
      "poromechanics/fem",
      dimension == 2 ? "Quasi-static deformation of the rock (the paper's Eqs. 5, 7), linear elastic in plane "
                       "strain: finite elements of first or second order, with two nodes where fractures "
                       "part them."
                     : "Quasi-static deformation of the rock (the paper's Eqs. 5, 7), linear elastic: finite "
                       "elements of first or second order.");
  spec.choice(
      "order", order,
      {{"first", "displacements are linear in cells; stabilized for fluid that cannot flow and walls in contact"},
       {"second", "displacements are of second order"}},
      {.doc = "Order of the displacement."});
  may_be_formula(spec.name(), "young_modulus", rock_variables());
  return spec;
}

namespace {

const RegisterComponent<FemRock, FemOptions> registration("poromechanics/fem");

}  // namespace
}  // namespace sprekk::poromechanics
