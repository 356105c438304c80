#include "components/contact/coulomb/coulomb.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <utility>

#include "framework/invariants.hpp"
#include "framework/mesh/mesh_change.hpp"
#include "framework/scene/registry.hpp"

namespace sprekk::contact {

Spec Options::spec() {
  Spec spec("contact/coulomb",
            "Frictional contact of fracture walls with dilation (Eqs. 2, 3): each cell sticks, slips or is open.");
  spec.ignore("type");
  spec.data("friction", friction,
            {.range = non_negative(),
             .doc = "Coefficient of friction.",
             .source = "mu_s of Eq. 3",
             .required = true,
             .material = true,
             .in_time = true});
  spec.data("dilation_angle", dilation_angle,
            {.unit = "rad",
             .range = between(0, 1.5),
             .doc = "Angle by which slip opens the fracture, g = |slip| tan psi.",
             .source = "psi below Eq. 2",
             .material = true,
             .in_time = true});
  return spec;
}

Coulomb::Coulomb(const ComponentContext& context, const Options& options)
    : Component(context.name),
      mesh_(context.mesh),
      traction_(context.fields.add(
          mesh_, {.owner = context.name,
                  .name = "traction",
                  .location = Location::fracture_cell,
                  .components = 2,
                  .role = Role::unknown(BlockKind::interface),
                  .unit = "Pa",
                  .doc = "Contact traction on the plus wall, normal and tangential (f of Eqs. 2-4)"})),
      jump_(context.fields.add(mesh_, {.owner = context.name,
                                       .name = "jump",
                                       .location = Location::fracture_cell,
                                       .components = 2,
                                       .role = Role::input(BlockKind::interface),
                                       .unit = "m",
                                       .doc = "Displacement jump, normal (opening) and tangential (slip) (Eq. 1)",
                                       .needs_coupler = "wall_traction"})),
      options_(options) {
  const int count = mesh_.fracture_cell_count();
  if (count == 0)
    throw InputError(context.origin, "component '" + context.name + "' has nothing to do", "the scene has no fractures",
                     "add fractures to `geometry:` or remove the component");
  const std::vector<Place> places = fracture_cell_places(mesh_);
  friction_ = Property(options_.friction, places, context.start_time);
  dilation_angle_ = Property(options_.dilation_angle, places, context.start_time);
  dilation_ = dilation_angle_.values().unaryExpr([](double psi) { return std::tan(psi); });
  stiffness_of_walls_ = stiffness_of_fractures_ = Vector::Ones(2 * count);
  fracture_length_.assign(mesh_.fractures.size(), 0);
  for (const FractureCell& cell : mesh_.fracture_cells) fracture_length_[cell.fracture] += cell.length;
}

void Coulomb::evaluate_data(const StepTime& step) {
  friction_.evaluate(step);
  if (!dilation_angle_.depends_on_time()) return;
  dilation_angle_.evaluate(step);
  dilation_ = dilation_angle_.values().unaryExpr([](double psi) { return std::tan(psi); });
}

std::vector<double> Coulomb::switch_times() const {
  return merged_switch_times({&options_.friction, &options_.dilation_angle});
}

void Coulomb::set_wall_stiffness(const Vector& stiffness) {
  stiffness_of_walls_ = stiffness;
  stiffness_of_fractures_ = stiffness;
  for (int i = 0; i < mesh_.fracture_cell_count(); ++i) {
    const FractureCell& cell = mesh_.fracture_cells[i];
    stiffness_of_fractures_[2 * i + 1] *= cell.length / fracture_length_[cell.fracture];
    constexpr double at_most = 0.5;  // of that along the tangent over the wedge
    const double wedge = std::max(friction_[i] * dilation_[i], std::numeric_limits<double>::min());
    for (Vector* c : {&stiffness_of_walls_, &stiffness_of_fractures_})
      (*c)[2 * i] = std::min((*c)[2 * i], at_most * (*c)[2 * i + 1] / wedge);
  }
}

void Coulomb::carry_over(const Part&, const MeshChange& change) {
  SPREKK_EXPECT(static_cast<int>(change.fracture_cell.size()) == mesh_.fracture_cell_count(),
                change.fracture_cell.size());
  bonded_.resize(change.fracture_cell.size());
  for (std::size_t i = 0; i < bonded_.size(); ++i) bonded_[i] = change.fracture_cell[i] == none;
}

void Coulomb::settled(const MeshChange&) { bonded_.clear(); }

Coulomb::Trial Coulomb::trial(int i) const {
  SPREKK_EXPECT(is_index(i, mesh_.fracture_cell_count()), i, mesh_.fracture_cell_count());
  SPREKK_ASSERT(stiffness()[2 * i] > 0 && stiffness()[2 * i + 1] > 0, i, stiffness()[2 * i], stiffness()[2 * i + 1]);
  SPREKK_ASSERT(friction_[i] >= 0 && dilation_[i] >= 0, i, friction_[i], dilation_[i]);
  const double f_n = traction_.now()[2 * i], f_t = traction_.now()[2 * i + 1];
  const double u_n = jump_.now()[2 * i], u_t = jump_.now()[2 * i + 1];
  Trial t;
  t.gap = u_n - std::abs(u_t) * dilation_[i];
  t.normal = f_n + stiffness()[2 * i] * t.gap;
  t.tangential = f_t + stiffness()[2 * i + 1] * (u_t - jump_.accepted()[2 * i + 1]);
  t.bound =
      !kept_.empty() && kept_[i] ? std::numeric_limits<double>::infinity() : -friction_[i] * std::min(0.0, t.normal);
  // At the very start of slip, |slip| has the slope of the direction in which the cell is about to slip.
  t.slip_sign = u_t > 0 ? 1 : u_t < 0 ? -1 : t.tangential > 0 ? 1 : -1;
  return t;
}

void Coulomb::follow_iterate(const std::vector<Field*>& unknowns) {
  if (follows_pieces_ || std::find(unknowns.begin(), unknowns.end(), &traction_) == unknowns.end()) return;
  const std::array<std::uint64_t, 2> values{traction_.version(), jump_.version()};
  if (!back_slip_.empty() && values == followed_) return;  // the same update
  followed_ = values;
  back_slip_.resize(mesh_.fracture_cell_count());
  for (int i = 0; i < mesh_.fracture_cell_count(); ++i) {
    BackSlip& cell = back_slip_[i];
    const Trial t = trial(i);
    SPREKK_ASSERT(is_index(i, static_cast<long>(back_slip_.size())), i, back_slip_.size());
    const double direction = t.is_open() || t.sticks() ? 0 : t.tangential > 0 ? 1 : -1;
    const bool slides_back = dilation_[i] > 0 && t.slides_back();
    if (cell.taken == BackSlip::Piece::before_kink && direction != cell.direction) {
      const double slip = jump_.now()[2 * i + 1] - jump_.accepted()[2 * i + 1];
      cell.is_beyond = cell.is_beyond || slip * cell.direction < 0;
    } else if (cell.taken == BackSlip::Piece::beyond_kink && slides_back) {
      cell.is_beyond = false;  // not reached, or not there: the other piece has its turn
    }
    cell.taken = !slides_back     ? BackSlip::Piece::none
                 : cell.is_beyond ? BackSlip::Piece::beyond_kink
                                  : BackSlip::Piece::before_kink;
    cell.direction = direction;
  }
}

Coulomb::Trial Coulomb::trial_of_update(int i) const {
  Trial t = trial(i);
  if (back_slip_.empty() || back_slip_[i].taken != BackSlip::Piece::beyond_kink) return t;
  t.slip_sign = -t.slip_sign;
  t.gap = jump_.now()[2 * i] - t.slip_sign * jump_.now()[2 * i + 1] * dilation_[i];
  // Walls that touch, whatever the sign here: this linear function passes through the values beyond the kink.
  const double normal = traction_.now()[2 * i] + stiffness()[2 * i] * t.gap;
  t.bound = -friction_[i] * normal;
  t.normal = std::min(normal, 0.0);
  return t;
}

State Coulomb::state(int i) const {
  const Trial t = trial(i);
  if (t.is_open()) return State::open;
  return t.sticks() ? State::stick : State::slip;
}

int Coulomb::piece(int i) const {
  const Trial t = trial(i);
  const State now = state(i);
  const int piece = 2 * static_cast<int>(now) + (now == State::slip && t.tangential > 0);
  if (!follows_pieces_) return piece;
  if (is_bonded(i)) return 0;
  const bool has_kink = dilation_[i] > 0 && now != State::open;
  return 2 * piece + (has_kink && t.slip_sign > 0);
}

/// Opens all cells by next to nothing. The amount makes no difference: within a state the conditions are linear.
void Coulomb::loosen() {
  constexpr double opening = 1e-9;  // of the length of a cell
  Vector traction = traction_.now(), jump = jump_.now();
  for (int i = 0; i < mesh_.fracture_cell_count(); ++i) {
    if (is_bonded(i)) continue;
    traction.segment<2>(2 * i).setZero();
    const double dilated = std::abs(jump[2 * i + 1]) * dilation_[i];
    jump[2 * i] = std::max(jump[2 * i], dilated + opening * mesh_.fracture_cells[i].length);
  }
  traction_.set(std::move(traction));
  jump_.set(std::move(jump));
}

int Coulomb::keep_states() {
  constexpr double least = 1e-6;  // of the largest slip: less is no jump
  kept_.assign(mesh_.fracture_cell_count(), 0);
  int count = 0;
  for (int i = 0; i < mesh_.fracture_cell_count(); ++i) {
    const double before = jump_.accepted()[2 * i + 1], slip = jump_.now()[2 * i + 1] - before;
    const bool slides_back = dilation_[i] > 0 && slip * before < 0;
    if (is_bonded(i) || !slides_back || std::abs(slip) < least * jump_.now().lpNorm<Eigen::Infinity>()) continue;
    if (state(i) == State::open || traction_.accepted()[2 * i] >= 0) continue;
    kept_[i] = 1;
    ++count;
  }
  if (count == 0) kept_.clear();
  return count;
}

int Coulomb::release_violated() {
  int count = 0;
  const std::vector<char> kept = std::exchange(kept_, {});
  std::vector<char> rest = kept;
  for (std::size_t i = 0; i < kept.size(); ++i) {
    if (!kept[i] || state(static_cast<int>(i)) == State::stick) continue;
    rest[i] = 0;
    ++count;
  }
  kept_ = std::move(rest);
  return count;
}

std::uint64_t Coulomb::discrete_state() const {
  std::uint64_t hash = 0;
  for (int i = 0; i < mesh_.fracture_cell_count(); ++i) hash = hash * 1000003 + piece(i);
  return hash;
}

void Coulomb::assemble(Assembly& assembly, const StepTime&) const {
  if (!assembly.has_row(traction_)) return;
  const int count = mesh_.fracture_cell_count();
  const bool guesses = assembly.wants_derivatives() && !follows_pieces_;
  Vector residual(2 * count);
  // The blocks have the same pattern in every state, so that the sparsity of the system never changes.
  std::vector<Triplet> by_traction, by_jump;
  for (int i = 0; i < count; ++i) {
    const Trial t = guesses ? trial_of_update(i) : trial(i);
    const double f_n = traction_.now()[2 * i], f_t = traction_.now()[2 * i + 1];
    const double c_n = stiffness()[2 * i], c_t = stiffness()[2 * i + 1];
    const double gap_by_t = -t.slip_sign * dilation_[i];  // d gap / d [u]_t; d gap / d [u]_n is 1
    double n_fn = 0, n_un = 0, n_ut = 0;                  // derivatives of the normal residual
    double t_fn = 0, t_ft = 0, t_un = 0, t_ut = 0;        // and of the tangential one
    if (is_bonded(i)) {
      residual[2 * i] = -jump_.now()[2 * i];
      residual[2 * i + 1] = -jump_.now()[2 * i + 1];
      n_un = t_ut = -1;
    } else if (t.is_open()) {
      residual[2 * i] = f_n / c_n;
      residual[2 * i + 1] = f_t / c_t;
      n_fn = 1 / c_n;
      t_ft = 1 / c_t;
    } else {
      residual[2 * i] = -t.gap;
      n_un = -1;
      n_ut = -gap_by_t;
      if (t.sticks()) {
        residual[2 * i + 1] = (f_t - t.tangential) / c_t;
        t_ut = -1;
      } else {
        const double direction = t.tangential > 0 ? 1 : -1;
        residual[2 * i + 1] = (f_t - direction * t.bound) / c_t;
        const double by_normal = direction * friction_[i] / c_t;
        t_ft = 1 / c_t;
        t_fn = by_normal;
        t_un = by_normal * c_n;
        t_ut = by_normal * c_n * gap_by_t;
      }
    }
    by_traction.insert(by_traction.end(),
                       {{2 * i, 2 * i, n_fn}, {2 * i + 1, 2 * i, t_fn}, {2 * i + 1, 2 * i + 1, t_ft}});
    by_jump.insert(
        by_jump.end(),
        {{2 * i, 2 * i, n_un}, {2 * i, 2 * i + 1, n_ut}, {2 * i + 1, 2 * i, t_un}, {2 * i + 1, 2 * i + 1, t_ut}});
  }
  assembly.add(traction_, residual);
  // The residual is compared with the jumps, or, where all cells stick, with the jumps that the tractions would make.
  assembly.compare_with(traction_, traction_.now().cwiseQuotient(stiffness()).lpNorm<Eigen::Infinity>());
  assembly.compare_with(traction_, jump_.now().lpNorm<Eigen::Infinity>());
  if (!assembly.wants_derivatives()) return;
  SparseMatrix tractions(2 * count, 2 * count), jumps(2 * count, 2 * count);
  tractions.setFromTriplets(by_traction.begin(), by_traction.end());
  jumps.setFromTriplets(by_jump.begin(), by_jump.end());
  assembly.derivative(traction_, traction_, std::move(tractions));
  assembly.derivative(traction_, jump_, std::move(jumps));
}

void Coulomb::report(std::vector<Quantity>& quantities) const {
  int counts[3] = {0, 0, 0};
  for (int i = 0; i < mesh_.fracture_cell_count(); ++i) ++counts[static_cast<int>(state(i))];
  quantities.push_back({name() + ".cells_stick", "1", static_cast<double>(counts[0])});
  quantities.push_back({name() + ".cells_slip", "1", static_cast<double>(counts[1])});
  quantities.push_back({name() + ".cells_open", "1", static_cast<double>(counts[2])});
}

void Coulomb::output(std::vector<OutputField>& fields) const {
  Vector states(mesh_.fracture_cell_count());
  for (int i = 0; i < states.size(); ++i) states[i] = static_cast<double>(state(i));
  fields.push_back({name() + ".state_0_stick_1_slip_2_open", "1", Location::fracture_cell, 1, std::move(states)});
}

namespace {

const RegisterComponent<Coulomb, Options> registration("contact/coulomb");

}  // namespace

}  // namespace sprekk::contact
