#include "components/fine_fracture/jump_fit/plane/jump_fit.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "framework/assembly/notes.hpp"
#include "framework/no_value.hpp"
#include "framework/scene/registry.hpp"

namespace sprekk::fine_fracture {

namespace {

double plane_modulus(const LameParameters& rock) {
  return 4 * rock.shear * (rock.lambda + rock.shear) / (rock.lambda + 2 * rock.shear);
}

}  // namespace

JumpFit::JumpFit(const ComponentContext& context, const JumpFitOptions& options)
    : Component(context.name), mesh_(context.mesh), origin_(context.origin), options_(options) {
  for (const TipEnd& end : all_ends(mesh_))
    if (kind_of(mesh_, end) == Ridge::Kind::tip) tips_.push_back({end, name_of(mesh_, end)});
}

void JumpFit::accept_surroundings(TipSurroundings& surroundings) {
  surroundings_ = &surroundings;
  if (const std::string flaw = surroundings.flaw_of_jumps(); !flaw.empty())
    throw InputError(origin_, "the jumps of the rock do not tell the factors of tips", flaw,
                     "choose fine_fracture/quarter_point, or another rock");
}

std::string JumpFit::why_no_growth() const {
  return "its factors are those of several cells in line, which a path that has just turned does not have";
}

/// The cells behind the tip, at most half of those up to the next kink, junction or end, where the field of the tip is
/// another one, without those that are left out.
FittedFactors JumpFit::factors_of(const Tip& tip) const {
  constexpr double kink = 0.26;  // rad, between two cells: 15 degrees
  const Fracture& fracture = mesh_.fractures[tip.end.fracture];
  const auto cell_from_tip = [&](int i) -> const FractureCell& {
    return mesh_.fracture_cells[fracture.first_cell + (tip.end.at_end ? fracture.cell_count - 1 - i : i)];
  };
  const auto continues_behind = [&](int i) {
    const FractureCell& cell = cell_from_tip(i);
    const Ridge& behind = mesh_.ridges[cell.ridges[tip.end.at_end ? 0 : 1]];
    return behind.kind != Ridge::Kind::junction &&
           cell.tangents.col(0).dot(cell_from_tip(i + 1).tangents.col(0)) > std::cos(kink);
  };
  int straight = 1;
  while (straight < fracture.cell_count && continues_behind(straight - 1)) ++straight;
  const int most = std::min(options_.leave_out + options_.cells, (straight + 1) / 2);
  double total = 0;
  for (int i = 0; i < fracture.cell_count; ++i) total += cell_from_tip(i).measure;
  std::vector<JumpBehind> jumps;
  double distance = 0;
  for (int i = 0; i < most; ++i) {
    const FractureCell& cell = cell_from_tip(i);
    const double middle = distance + 0.5 * cell.measure;
    const Point jump =
        cell.to_local(surroundings_->wall_jump(tip.end.fracture, tip.end.at_end ? total - middle : middle));
    jumps.push_back({middle, jump[0], -jump[1]});
    distance += cell.measure;
  }
  const int left_out = std::clamp(static_cast<int>(jumps.size()) - 2, 0, options_.leave_out);
  jumps.erase(jumps.begin(), jumps.begin() + left_out);
  const bool ends_in_tip = kind_of(mesh_, {tip.end.fracture, !tip.end.at_end}) == Ridge::Kind::tip;
  return factors_from_jumps(jumps, plane_modulus(surroundings_->stiffness(end_point(mesh_, tip.end))),
                            ends_in_tip ? total : std::numeric_limits<double>::infinity());
}

void JumpFit::report(std::vector<Quantity>& quantities) const {
  if (!surroundings_) return;
  if (has_begun_) surroundings_->update();
  for (const Tip& tip : tips_) {
    const std::string prefix = name() + "." + tip.name + ".";
    const FittedFactors fitted = has_begun_ ? factors_of(tip) : FittedFactors{{no_value, no_value, no_value}, no_value};
    quantities.push_back({prefix + "K_I", "Pa*m^0.5", fitted.sifs.k1});
    quantities.push_back({prefix + "K_II", "Pa*m^0.5", fitted.sifs.k2});
    quantities.push_back({prefix + "K_eq", "Pa*m^0.5", has_begun_ ? equivalent_sif(fitted.sifs) : no_value});
    quantities.push_back({prefix + "K_error_fit", "Pa*m^0.5", fitted.error});
  }
}

void JumpFit::note_input(Notes& notes) const {
  if (!surroundings_) note_without_jumps(name(), notes);
}

void JumpFit::note_step(Notes& notes, const StepTime&) const {
  if (!surroundings_) return;
  for (const Tip& tip : tips_) {
    const FittedFactors fitted = factors_of(tip);
    const double k_eq = equivalent_sif(fitted.sifs);
    if (std::isnan(fitted.error))
      notes.add(
          name() + "." + tip.name + " has the factors of one cell",
          fmt::format("the factors of {}.{} are those of one cell, and may be a fifth off (there are no more than "
                      "two cells to the next bend, junction or end) choose a smaller 'mesh.fracture_size'",
                      name(), tip.name));
    else if (fitted.error > uncertain * k_eq && k_eq > 0)
      notes.add(name() + "." + tip.name + " has uncertain factors",
                fmt::format("the factors of {}.{} change by {:.2g} of K_eq with one cell less in their fit: try a "
                            "smaller 'mesh.fracture_size', or fine_fracture/quarter_point",
                            name(), tip.name, fitted.error / k_eq),
                fitted.error / k_eq);
  }
}

namespace {

const RegisterComponent<JumpFit, JumpFitOptions> registration("fine_fracture/jump_fit");

}  // namespace

}  // namespace sprekk::fine_fracture
