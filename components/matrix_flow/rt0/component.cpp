// matrix_flow/rt0: flow in the matrix with mixed-hybrid finite elements of lowest order.
#include <fmt/format.h>

#include <memory>

#include "components/matrix_flow/matrix_flow.hpp"
#include "components/matrix_flow/mpfa/uncorrected_tips.hpp"
#include "components/matrix_flow/rt0/flux_mass.hpp"
#include "components/matrix_flow/rt0/rt0.hpp"
#include "framework/scene/registry.hpp"

namespace sprekk::matrix_flow {
namespace {

struct Rt0Options : Options {
  std::string flux_mass = "automatic";
  bool is_lumped() const { return flux_mass == "lumped"; }

  Spec spec() {
    Spec spec =
        Options::spec("matrix_flow/rt0",
                      "Flow in the matrix (the paper's Eq. 6): mixed-hybrid finite elements of lowest order, exact "
                      "for linear pressures on any mesh; the pressures of faces are unknowns, too.");
    spec.choice(
        "flux_mass", flux_mass,
        {{"automatic",
          "integrated exactly, but in steps that are short against the diffusion time of a cell with a resistance "
          "against what the cell stores: pressures keep their bounds, nearly so beside obtuse angles"},
         {"exact", "integrated exactly: pressures leave their bounds in short steps"},
         {"lumped",
          "diagonal in acute triangles and in rectangles along the principal axes of the permeability: pressures "
          "keep their bounds there, but that of a triangle is the one at the centre of its circumcircle"}},
        {.doc = "The mass matrix of the fluxes of a cell.",
         .source = "Baranger, Maitre, Oudin 1996; Hoteit, Mosé, Philippe, Ackerer, Erhel 2002"});
    return spec;
  }
};

/// The share of mass_for_short_steps in each cell.
using Shares = std::vector<double>;

class Rt0 : public MatrixFlow {
 public:
  Rt0(const ComponentContext& context, const Rt0Options& options)
      : Rt0(context, options, std::make_shared<Shares>(context.mesh.cell_count(), 0)) {}

  void begin_step(const StepTime& step) override {
    evaluate_data(step);
    if (follows_step_ && is_permeable()) use_step(step.dt);
    MatrixFlow::begin_step(step);
  }

  void note_input(Notes& notes) const override {
    MatrixFlow::note_input(notes);
    if (!is_permeable()) return;
    if (!is_lumped_) {
      note_uncorrected_tips(notes, name(), mesh(), mobility());
      return;
    }
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
  Rt0(const ComponentContext& context, const Rt0Options& options, const std::shared_ptr<Shares>& shares)
      : MatrixFlow(context, options, discretization(options, shares), Unknowns::on_cells_and_faces),
        is_lumped_(options.is_lumped()),
        follows_step_(options.flux_mass == "automatic"),
        shares_(shares) {}

  static Discretize discretization(const Rt0Options& options, const std::shared_ptr<Shares>& shares) {
    if (options.is_lumped()) return discretize_lumped_rt0;
    return [shares](const Mesh& mesh, const std::vector<Tensor>& mobility, const std::vector<FlowCondition>& conditions,
                    const std::vector<char>&) {
      return discretize_rt0_for_short_steps(mesh, mobility, conditions, *shares);
    };
  }

  void use_step(double dt) {
    if (masses_version_ != mobility_version()) {
      masses_version_ = mobility_version();
      until_.assign(mesh().cell_count(), 0);
      for (int cell = 0; cell < mesh().cell_count(); ++cell)
        if (is_in_cell(cell)) until_[cell] = mass_for_short_steps(mesh(), cell, mobility()[cell]).until;
    }
    Shares shares;
    for (int cell = 0; cell < mesh().cell_count(); ++cell)
      shares.push_back(share_for(dt / (whole_storage(cell) * mesh().cell_measure[cell]), until_[cell]));
    if (shares == *shares_) return;
    *shares_ = std::move(shares);
    discretize_anew();
  }

  bool is_lumped_;
  bool follows_step_;                 ///< takes shares of mass_for_short_steps
  std::shared_ptr<Shares> shares_;    ///< with which the fluxes were discretized last
  std::vector<double> until_;         ///< MassForShortSteps::until of each cell
  std::uint64_t masses_version_ = 0;  ///< of the mobility for which it was found
};

const RegisterComponent<Rt0, Rt0Options> registration("matrix_flow/rt0");

}  // namespace
}  // namespace sprekk::matrix_flow
