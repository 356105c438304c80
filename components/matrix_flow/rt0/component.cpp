// matrix_flow/rt0: flow in the matrix with mixed-hybrid finite elements of lowest order.
#include <fmt/format.h>

#include "components/matrix_flow/matrix_flow.hpp"
#include "components/matrix_flow/mpfa/uncorrected_tips.hpp"
#include "components/matrix_flow/rt0/flux_mass.hpp"
#include "components/matrix_flow/rt0/rt0.hpp"
#include "framework/scene/registry.hpp"

namespace sprekk::matrix_flow {
namespace {

struct Rt0Options : Options {
  std::string flux_mass = "exact";
  bool is_lumped() const { return flux_mass == "lumped"; }

  Spec spec() {
    Spec spec =
        Options::spec("matrix_flow/rt0",
                      "Flow in the matrix (the paper's Eq. 6): mixed-hybrid finite elements of lowest order, exact "
                      "for linear pressures on any mesh; the pressures of faces are unknowns, too.");
    spec.choice(
        "flux_mass", flux_mass,
        {{"exact", "integrated exactly"},
         {"lumped",
          "diagonal in acute triangles and in rectangles along the principal axes of the permeability: pressures "
          "keep their bounds there, but that of a triangle is the one at the centre of its circumcircle"}},
        {.doc = "The mass matrix of the fluxes of a cell.", .source = "Baranger, Maitre, Oudin 1996"});
    return spec;
  }
};

class Rt0 : public MatrixFlow {
 public:
  Rt0(const ComponentContext& context, const Rt0Options& options)
      : MatrixFlow(context, options, options.is_lumped() ? discretize_lumped_rt0 : discretize_rt0,
                   Unknowns::on_cells_and_faces),
        is_lumped_(options.is_lumped()) {}

  void note_input(Notes& notes) const override {
    MatrixFlow::note_input(notes);
    if (!is_permeable()) return;
    if (!is_lumped_) return note_uncorrected_tips(notes, name(), mesh(), mobility());
    int not_lumped = 0;
    for (int cell = 0; cell < mesh().cell_count(); ++cell)
      not_lumped += is_in_cell(cell) && lumped_flux_mass(mesh(), cell, mobility()[cell]).share < 1;
    if (not_lumped > 0)
      notes.add(
          name() + ": fluxes that are not lumped",
          fmt::format("the flux mass of '{}' is not wholly lumped in {} of {} cells (triangles with an angle near "
                      "90 degrees or above, where a diagonal would not be positive) use a mesh of acute triangles "
                      "or of rectangles, or flux_mass: exact",
                      name(), not_lumped, mesh().cell_count()),
          not_lumped);
  }

 private:
  bool is_lumped_;
};

const RegisterComponent<Rt0, Rt0Options> registration("matrix_flow/rt0");

}  // namespace
}  // namespace sprekk::matrix_flow
