#include "components/fine_fracture/jump_fit/space/jump_fit.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "framework/assembly/notes.hpp"
#include "framework/no_value.hpp"
#include "framework/scene/registry.hpp"

namespace sprekk::fine_fracture {

namespace {

constexpr const char* unit_of_factors = "Pa*m^0.5";

/// The moduli in the relation between factors and jumps, of one side or of both, Pa.
struct Moduli {
  double plane, shear;  ///< E', and that of shear
};

Moduli moduli(const LameParameters& rock) {
  return {4 * rock.shear * (rock.lambda + rock.shear) / (rock.lambda + 2 * rock.shear), rock.shear};
}

/// The jump is the sum of the displacements of both sides, so compliances are averaged.
Moduli of_both(const Moduli& one, const Moduli& other) {
  const auto mean = [](double a, double b) { return 2 * a * b / (a + b); };
  return {mean(one.plane, other.plane), mean(one.shear, other.shear)};
}

double largest(double so_far, double value) {
  return std::isnan(so_far) || std::abs(value) > std::abs(so_far) ? value : so_far;
}

}  // namespace

FrontJumpFit::FrontJumpFit(const ComponentContext& context, const JumpFitOptions& options)
    : Component(context.name), mesh_(context.mesh), origin_(context.origin), places_(fit_fronts(mesh_, options)) {}

void FrontJumpFit::accept_jumps(JumpsOfWalls& jumps) {
  jumps_ = &jumps;
  if (const std::string flaw = jumps.flaw_of_jumps(); !flaw.empty())
    throw InputError(origin_, "the jumps of the rock do not tell the factors along fronts", flaw,
                     "choose elements of second order, or another rock");
}

std::string FrontJumpFit::why_no_growth() const { return "fractures in space do not grow yet"; }

std::vector<FrontJumpFit::Factors> FrontJumpFit::factors() const {
  std::vector<Factors> all(places_.size(), {no_value, no_value, no_value, no_value, no_value});
  if (!jumps_ || !has_begun_) return all;
  jumps_->update();
  const auto value_of = [&](const FrontSum& sum, const Point& per_jump) {
    Point value = Point::Zero();
    // u(plus) − u(minus), the opposite of the jump.
    for (const FrontSum::Part& part : sum.parts)
      value -= part.weight * (part.axes.transpose() * jumps_->jump(part.cell));
    return Point(value.cwiseProduct(per_jump));
  };
  for (std::size_t i = 0; i < places_.size(); ++i) {
    const auto rock_at = [&](Wall wall) {
      const int face = mesh_.fracture_cells[places_[i].cell].faces[static_cast<int>(wall)];
      return moduli(jumps_->stiffness(mesh_.face_cells[face][0]));
    };
    const Moduli rock = of_both(rock_at(Wall::plus), rock_at(Wall::minus));
    const Point per_jump(rock.plane / 8, rock.plane / 8, rock.shear / 4), value = value_of(places_[i].fitted, per_jump);
    const double error = places_[i].with_one_less.parts.empty()
                             ? no_value
                             : (value - value_of(places_[i].with_one_less, per_jump)).norm();
    const double release = value.head<2>().squaredNorm() / rock.plane + value[2] * value[2] / (2 * rock.shear);
    all[i] = {value[1], value[0], value[2], error, release};
  }
  return all;
}

void FrontJumpFit::report(std::vector<Quantity>& quantities) const {
  if (!jumps_) return;
  const std::vector<Factors> all = factors();
  for (std::size_t i = 0; i < all.size();) {
    const int fracture = places_[i].fracture;
    Factors most{no_value, no_value, no_value, no_value, no_value};
    for (; i < all.size() && places_[i].fracture == fracture; ++i) {
      most.k1 = std::isnan(most.k1) ? all[i].k1 : std::max(most.k1, all[i].k1);
      most.k2 = largest(most.k2, all[i].k2);
      most.k3 = largest(most.k3, all[i].k3);
      if (!std::isnan(all[i].error)) most.error = largest(most.error, all[i].error);
      most.release = largest(most.release, all[i].release);
    }
    const std::string prefix = name() + "." + mesh_.fractures[fracture].name + ".";
    quantities.push_back({prefix + "K_I", unit_of_factors, most.k1});
    quantities.push_back({prefix + "K_II", unit_of_factors, most.k2});
    quantities.push_back({prefix + "K_III", unit_of_factors, most.k3});
    quantities.push_back({prefix + "energy_release_rate", "J/m^2", most.release});
    quantities.push_back({prefix + "K_error_fit", unit_of_factors, most.error});
  }
}

void FrontJumpFit::output(std::vector<OutputField>& fields) const {
  const std::vector<Factors> all = factors();
  const auto add = [&](const std::string& what, const std::string& unit, auto value_of) {
    Vector values = Vector::Constant(std::ssize(mesh_.ridges), no_value);
    for (std::size_t i = 0; i < all.size(); ++i) values[places_[i].ridge] = value_of(i);
    fields.push_back({name() + "." + what, unit, Location::ridge, 1, std::move(values)});
  };
  add("arc", "m", [&](std::size_t i) { return places_[i].arc; });
  add("K_I", unit_of_factors, [&](std::size_t i) { return all[i].k1; });
  add("K_II", unit_of_factors, [&](std::size_t i) { return all[i].k2; });
  add("K_III", unit_of_factors, [&](std::size_t i) { return all[i].k3; });
  add("K_error_fit", unit_of_factors, [&](std::size_t i) { return all[i].error; });
  add("energy_release_rate", "J/m^2", [&](std::size_t i) { return all[i].release; });
}

void FrontJumpFit::note_input(Notes& notes) const {
  if (!jumps_) note_without_jumps(name(), notes);
}

void FrontJumpFit::note_step(Notes& notes, const StepTime&) const {
  if (!jumps_) return;
  const std::vector<Factors> all = factors();
  for (std::size_t i = 0; i < all.size();) {
    const int fracture = places_[i].fracture;
    double size = 0, error = 0;
    int single = 0, count = 0;
    for (; i < all.size() && places_[i].fracture == fracture; ++i, ++count) {
      size = std::max(size, std::hypot(all[i].k1, all[i].k2, all[i].k3));
      if (std::isnan(all[i].error))
        ++single;
      else
        error = std::max(error, all[i].error);
    }
    const std::string what = name() + "." + mesh_.fractures[fracture].name;
    if (single > 0)
      notes.add(what + " has factors of few cells",
                fmt::format("of {} edges of the front of {}, {} have the factors of one cell or one row of cells, and "
                            "may be a fifth off (there are no more up to the next end or junction) choose a smaller "
                            "'mesh.fracture_size'",
                            count, what, single));
    else if (error > uncertain * size && size > 0)
      notes.add(what + " has uncertain factors",
                fmt::format("the factors of {} change by up to {:.2g} of the largest ones with a cell less in their "
                            "fit: try a smaller 'mesh.fracture_size'",
                            what, error / size),
                error / size);
  }
}

namespace {

const RegisterComponent<FrontJumpFit, JumpFitOptions> registration("fine_fracture/jump_fit");

}  // namespace

}  // namespace sprekk::fine_fracture
