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
                       "elements of first order.");
  std::vector<std::pair<std::string, std::string>> orders{
      {"first", "displacements are linear in cells; stabilized for fluid that cannot flow and walls in contact"}};
  if (dimension == 2) orders.push_back({"second", "displacements are of second order"});
  spec.choice("order", order, orders, {.doc = "Order of the displacement."});
  return spec;
}

namespace {

const RegisterComponent<FemRock, FemOptions> registration("poromechanics/fem");

}  // namespace
}  // namespace sprekk::poromechanics
