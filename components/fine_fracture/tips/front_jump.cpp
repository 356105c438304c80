// A front that was not found in the shortest step: tips jump until they are below their toughness.
#include <fmt/format.h>

#include "components/fine_fracture/tips/tips_front.hpp"

namespace sprekk::fine_fracture {

/// In the shortest step there is no stable growth, or none that was found: tips advance until they are below their
/// toughness.
FrontSearch::Verdict TipsFront::settle_for_less() {
  if (begin_jump()) return Verdict::again;
  note_rest(front_->worst());
  return Verdict::found;
}

void TipsFront::note_rest(double worst) {
  const std::string name = tips_.name();
  notes_.push_back({name + " is off its toughness",
                    fmt::format("tips of {} end a step with K_eq/K_IC off by {:.2g} (the advance was not found more "
                                "precisely)",
                                name, worst),
                    worst});
}

void TipsFront::note_rough_front() {
  const std::string name = tips_.name();
  const double worst = std::max(front_->worst(), front_->worst_shear());
  notes_.push_back(
      {name + " ends steps at a front that is less exact",
       fmt::format("tips of {} end a step with K_eq/K_IC off by {:.1e} and K_II/K_I off by {:.1e} (between "
                   "trials of a step factors jump by that much) a smaller 'newton.update' of the solves "
                   "before 'grow' may help",
                   name, front_->worst(), front_->worst_shear()),
       worst});
}

/// Returns false where no tip can advance.
bool TipsFront::begin_jump() {
  jump_ = std::make_unique<FrontJump>(
      at_start_, without_growth_, options_, [this](int tip, const Point& from, const Point& ahead) {
        const double reach = 2 * options_.increment;  // beyond the next division
        return std::min(reach, tips_.free_distance(tips_.tips_[tip], {{from}}, from + reach * ahead));
      });
  for (std::size_t i = 0; i < at_start_.size(); ++i)
    if (is_blocked_[i]) jump_->stop(static_cast<int>(i));
  if (jump_->verdict() != Front::Verdict::again) jump_.reset();
  if (jump_) propose();
  return jump_ != nullptr;
}

bool TipsFront::retreat() {
  if (may_shrink_) return false;
  if (!jump_) return begin_jump();
  if (jump_->verdict() != Front::Verdict::again) return false;  // other tips could not grow where it has ended
  if (!jump_->retreat()) return false;
  propose();
  return true;
}

std::string TipsFront::why_it_ends() const {
  if (jump_->drop()) return "comes to rest where its load drops";
  if (jump_->verdict() == Front::Verdict::found) return "comes to rest";
  return jump_->is_left() ? "stops where it could not be followed further" : "has gone as far as it may in one step";
}

FrontSearch::Verdict TipsFront::end_jump() {
  bool is_jump = false;
  for (std::size_t i = 0; i < at_start_.size(); ++i) {
    const FrontJump::Record& record = jump_->record(static_cast<int>(i));
    if (!(record.advance > 0) || (jump_->verdict() == Front::Verdict::found && !record.is_unstable)) continue;
    is_jump = true;
    const std::string name = tips_.name() + "." + tips_.tips_[i].name;
    const LameParameters lame = tips_.surroundings_->stiffness(at_start_[i].anchor);
    const double toughness = at_start_[i].toughness;
    const double energy = record.surplus * toughness * toughness / Elasticity{lame.lambda, lame.shear}.plane_modulus();
    // What the fine level has grown alone in this step, before the mesh followed, is no part of it.
    const double alone = at_start_[i].first_length > 0 ? at_start_[i].first_length - at_start_[i].least : 0;
    const double at_start = tips_.tips_[i].length_at_start + alone, from = at_start + record.begins,
                 to = at_start + record.advance;
    const char* const why_it_begins = record.is_unstable ? "its load rises with its length: growth is unstable"
                                                         : "its load does not fall to the toughness nearby";
    const Event event{"jump",
                      name,
                      0,
                      0,
                      Point::Zero(),
                      {{"from", "m", from},
                       {"to", "m", to},
                       {"largest_load", "1", record.largest_load},
                       {"surplus_energy", "J/m", energy}},
                      fmt::format("{}; it {}", why_it_begins, why_it_ends())};
    notes_.push_back(
        {name + " jumps",
         fmt::format("{} jumps from {:.4g} mm to {:.4g} mm of growth in no time, with the fluid that there "
                     "is ({}), and {}; K_eq/K_IC is up to {:.4g} on the way, and {:.3g} J/m of energy are "
                     "left over",
                     name, 1e3 * from, 1e3 * to, why_it_begins, why_it_ends(), record.largest_load, energy),
         energy, event});
  }
  if (const auto& drop = jump_->drop())
    notes_.push_back({tips_.name() + " rests where its load drops",
                      fmt::format("tips of {} come to rest where K_eq/K_IC drops from {:.3g} to {:.3g}, as at the "
                                  "border of a tougher layer or where the walls close",
                                  tips_.name(), drop->before, drop->behind),
                      drop->before - drop->behind});
  else if (!is_jump)
    note_rest(jump_->worst());
  return Verdict::found;
}

}  // namespace sprekk::fine_fracture
