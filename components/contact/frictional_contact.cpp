#include "components/contact/frictional_contact.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <map>
#include <utility>

#include "framework/invariants.hpp"
#include "framework/mesh/mesh_change.hpp"

namespace sprekk::contact {

FrictionalContact::FrictionalContact(const ComponentContext& context, const Options& options, Multiplier multiplier,
                                     double stiffness_factor)
    : Component(context.name),
      mesh_(context.mesh),
      traction_(context.fields.add(
          mesh_, {.owner = context.name,
                  .name = "traction",
                  .location = Location::fracture_cell,
                  .components = dimension,
                  .role = Role::unknown(BlockKind::interface),
                  .unit = "Pa",
                  .doc = "Contact traction on the plus wall, normal and tangential (f of the paper's Eqs. 2-4)",
                  .is_path_dependent = true})),
      jump_(context.fields.add(mesh_,
                               {.owner = context.name,
                                .name = "jump",
                                .location = Location::fracture_cell,
                                .components = dimension,
                                .role = Role::input(BlockKind::interface),
                                .unit = "m",
                                .doc = "Displacement jump, normal (opening) and tangential (slip) (the paper's Eq. 1)",
                                .needs_coupler = "wall_traction",
                                .is_path_dependent = true})),
      options_(options),
      multiplier_(multiplier),
      stiffness_factor_(stiffness_factor),
      closure_(options.closure.build()) {
  const int count = mesh_.fracture_cell_count();
  if (count == 0)
    throw InputError(context.origin, "component '" + context.name + "' has nothing to do", "the scene has no fractures",
                     "add fractures to `geometry:` or remove the component");
  const std::vector<Place> places = fracture_cell_places(mesh_);
  if (options_.weakening.is_on())
    path_ = &context.fields.add(mesh_, {.owner = context.name,
                                        .name = "path",
                                        .location = Location::fracture_cell,
                                        .role = Role::derived(),
                                        .unit = "m",
                                        .doc = "Path of slip and opening since the start, forth and back",
                                        .accepted_with = traction_.name(),
                                        .is_path_dependent = true});
  friction_ = Property(options_.friction, places, context.start_time);
  dilation_angle_ = Property(options_.dilation_angle, places, context.start_time);
  if (options_.dynamic_friction) dynamic_friction_ = Property(*options_.dynamic_friction, places, context.start_time);
  dilation_ = dilation_angle_.values().unaryExpr([](double psi) { return std::tan(psi); });
  stiffness_of_walls_ = stiffness_of_fractures_ = Vector::Ones(dimension * count);
  fracture_measure_.assign(mesh_.fractures.size(), 0);
  for (const FractureCell& cell : mesh_.fracture_cells) fracture_measure_[cell.fracture] += cell.measure;
}

void FrictionalContact::evaluate_data(const StepTime& step) {
  friction_.evaluate(step);
  if (options_.dynamic_friction) dynamic_friction_.evaluate(step);
  if (!dilation_angle_.depends_on_time()) return;
  dilation_angle_.evaluate(step);
  dilation_ = dilation_angle_.values().unaryExpr([](double psi) { return std::tan(psi); });
}

std::vector<double> FrictionalContact::switch_times() const {
  std::vector<const Data*> data{&options_.friction, &options_.dilation_angle};
  if (options_.dynamic_friction) data.push_back(&*options_.dynamic_friction);
  return merged_switch_times(data);
}

void FrictionalContact::set_wall_stiffness(const Vector& stiffness) {
  stiffness_of_walls_ = stiffness_factor_ * stiffness;
  stiffness_of_fractures_ = stiffness_of_walls_;
  for (int i = 0; i < mesh_.fracture_cell_count(); ++i) {
    const FractureCell& cell = mesh_.fracture_cells[i];
    stiffness_of_fractures_.segment<dimension - 1>(dimension * i + 1) *=
        cell.measure / fracture_measure_[cell.fracture];
    constexpr double at_most = 0.5;  // times the tangential stiffness over mu_s tan psi
    const double wedge = std::max(friction_[i] * dilation_[i], std::numeric_limits<double>::min());
    for (Vector* c : {&stiffness_of_walls_, &stiffness_of_fractures_}) {
      // The same stiffness for all tangents: the return to the cone then does not depend on the directions of the
      // tangents.
      auto tangential = c->segment<dimension - 1>(dimension * i + 1);
      const double least = tangential.minCoeff();
      tangential.setConstant(least);
      (*c)[dimension * i] = std::min((*c)[dimension * i], at_most * least / wedge);
    }
  }
}

namespace {

/// Of the jump along a cell at the tip of a fracture, which falls with the square root of the distance to the tip: the
/// part between the places `from` and `to`, shares of the length from the other end on.
double part_at_tip(double from, double to) {
  const auto beyond = [](double place) { return (1 - place) * std::sqrt(1 - place); };
  return beyond(from) - beyond(to);
}

}  // namespace

void FrictionalContact::carry_over(const Part& part, const MeshChange& change) {
  SPREKK_EXPECT(static_cast<int>(change.fracture_cell.size()) == mesh_.fracture_cell_count(),
                change.fracture_cell.size());
  const auto& before = dynamic_cast<const FrictionalContact&>(part);
  const Vector covered = covered_parts(change, mesh_);
  // Where the end of slip comes to lie within a new closed cell, old cells have to follow.
  const bool holds_all = covered.size() > 0 && covered.minCoeff() > 0;
  bonded_.resize(change.fracture_cell.size());
  Vector jump = jump_.accepted();
  for (std::size_t i = 0; i < bonded_.size(); ++i) {
    const bool is_new = change.fracture_cell[i] == none;
    bonded_[i] = holds_all || is_new;
    if (is_new) jump.segment<dimension>(dimension * i).setZero();
  }
  // The volume of a replaced cell stays. The parts of each follow one another towards the tip.
  std::map<int, double> place;  // in an old cell, where its next part begins
  for (const ReplacedPart& replaced : change.replaced_parts) {
    const FractureCell& old = before.mesh_.fracture_cells[replaced.old_cell];
    double& from = place[replaced.old_cell];
    const double to = std::min(1.0, from + replaced.share);
    const double share = before.is_at_tip(replaced.old_cell) ? part_at_tip(from, to) : to - from;
    jump.segment<dimension>(dimension * replaced.cell) +=
        share * old.measure / mesh_.fracture_cells[replaced.cell].measure *
        before.jump_.accepted().segment<dimension>(dimension * replaced.old_cell);
    from = to;
  }
  bonded_jump_ = jump;
  jump_.set_both(std::move(jump));
}

bool FrictionalContact::is_at_tip(int cell) const {
  return std::ranges::any_of(mesh_.fracture_cells[cell].points,
                             [&](int point) { return mesh_.fracture_points[point].kind == FracturePoint::Kind::tip; });
}

void FrictionalContact::settled(const MeshChange&) {
  bonded_.clear();
  bonded_jump_.resize(0);
}

void FrictionalContact::after_solve(const std::vector<Field*>& solved, const StepTime&) {
  if (!path_ || std::find(solved.begin(), solved.end(), &traction_) == solved.end()) return;
  Vector paths(mesh_.fracture_cell_count());
  for (int i = 0; i < paths.size(); ++i) paths[i] = path(i, gap(i, traction_.now(), jump_.now()));
  path_->set(std::move(paths));
}

void FrictionalContact::observe_iterate(const std::vector<Field*>& unknowns) {
  is_solved_for_ = std::find(unknowns.begin(), unknowns.end(), &traction_) != unknowns.end();
  if (is_solved_for_ && multiplier_ == Multiplier::last) last_ = traction_.now();
  if (follows_pieces_ || !is_solved_for_) return;
  const std::array<std::uint64_t, 2> values{traction_.version(), jump_.version()};
  if (!back_slip_.empty() && values == followed_) return;  // this update has been considered already
  followed_ = values;
  back_slip_.resize(mesh_.fracture_cell_count());
  for (int i = 0; i < mesh_.fracture_cell_count(); ++i) {
    BackSlip& cell = back_slip_[i];
    const Trial t = trial(i);
    SPREKK_ASSERT(is_index(i, static_cast<long>(back_slip_.size())), i, back_slip_.size());
    TangentialVector direction = TangentialVector::Zero();
    if (t.state() == State::slip) direction = direction_of<dimension - 1>(t.tangential);
    const bool slides_back = dilation_[i] > 0 && t.slides_back();
    if (cell.taken == BackSlip::Piece::before_kink && direction.dot(cell.direction) <= 0) {
      const TangentialVector slip = tangential(jump_.now(), i) - tangential(jump_.accepted(), i);
      cell.is_beyond = cell.is_beyond || slip.dot(cell.direction) < 0;
    } else if (cell.taken == BackSlip::Piece::beyond_kink && slides_back) {
      cell.is_beyond = false;  // the kink was not reached, or no solution lies beyond it
    }
    cell.taken = !slides_back     ? BackSlip::Piece::none
                 : cell.is_beyond ? BackSlip::Piece::beyond_kink
                                  : BackSlip::Piece::before_kink;
    cell.direction = direction;
  }
}

State FrictionalContact::state(int i) const { return trial(i).state(); }

namespace {

/// Whether slip has the positive one of the two directions in a plane. In space the direction changes without a kink,
/// and all directions are one piece.
bool is_forward(const TangentialVector& vector) { return dimension == 2 && vector[0] > 0; }

}  // namespace

int FrictionalContact::piece(int i) const {
  const Trial t = trial(i);
  const State now = state(i);
  const bool knows_direction = now == State::slip && friction_[i] > 0;
  const int piece = 2 * static_cast<int>(now) + (knows_direction && is_forward(t.tangential));
  if (!follows_pieces_) return piece;
  if (is_bonded(i)) return 0;
  const bool has_kink = dilation_[i] > 0 && now != State::open;
  const bool is_worn = has_kink && t.dilation == 0;
  return 3 * piece + (is_worn ? 2 : has_kink && is_forward(t.slip_direction));
}

/// Opens all cells by a very small amount. The amount makes no difference, since the conditions of open cells are
/// linear.
void FrictionalContact::deactivate_conditions() {
  constexpr double opening = 1e-9;  // of the length of a cell
  Vector traction = traction_.now(), jump = jump_.now();
  for (int i = 0; i < mesh_.fracture_cell_count(); ++i) {
    if (is_bonded(i)) continue;
    traction.segment<dimension>(dimension * i).setZero();
    const double least = dilated(i, magnitude<dimension - 1>(tangential(jump, i))) - closure(0);
    jump[dimension * i] = std::max(jump[dimension * i], least + opening * mesh_.fracture_cells[i].measure);
  }
  traction_.set(std::move(traction));
  jump_.set(std::move(jump));
}

int FrictionalContact::keep_states() {
  constexpr double least = 1e-6;  // of the largest jump; smaller jumps are round-off
  if (!is_solved_for_) return 0;
  kept_.assign(mesh_.fracture_cell_count(), 0);
  int count = 0;
  for (int i = 0; i < mesh_.fracture_cell_count(); ++i) {
    const TangentialVector before = tangential(jump_.accepted(), i), slip = tangential(jump_.now(), i) - before;
    const bool slides_back = dilation_[i] > 0 && friction_[i] > 0 && slip.dot(before) < 0;
    if (is_bonded(i) || !slides_back || magnitude<dimension - 1>(slip) < least * jump_.now().lpNorm<Eigen::Infinity>())
      continue;
    if (state(i) == State::open || traction_.accepted()[dimension * i] >= 0) continue;
    kept_[i] = 1;
    ++count;
  }
  if (count == 0) kept_.clear();
  return count;
}

int FrictionalContact::release_violated() {
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

std::uint64_t FrictionalContact::discrete_state() const {
  std::uint64_t hash = 0;
  for (int i = 0; i < mesh_.fracture_cell_count(); ++i) hash = hash * 1000003 + piece(i);
  return hash;
}

void FrictionalContact::assemble(Assembly& assembly, const StepTime&) const {
  if (!assembly.has_row(traction_)) return;
  const int count = mesh_.fracture_cell_count();
  const bool has_present = trial_has_present();
  const bool guesses = assembly.wants_derivatives() && !follows_pieces_;
  Vector residual(dimension * count);
  SPREKK_ASSERT(residual.size() == traction_.size(), residual.size(), traction_.size());
  // The blocks have the same pattern in every state, so that the sparsity of the system never changes.
  std::vector<Triplet> by_traction, by_jump;
  for (int i = 0; i < count; ++i) {
    const Trial t = guesses ? trial_of_update(i) : trial(i);
    const int row = dimension * i;
    const double f_n = traction_.now()[row], c_n = stiffness()[row], c_t = stiffness()[row + 1];
    const TangentialVector f_t = tangential(traction_.now(), i);
    auto own = residual.segment<dimension>(row);
    Tensor by_f = Tensor::Zero(), by_u = Tensor::Zero();  // derivatives of the residual, the normal row first
    if (is_bonded(i)) {
      own = bonded_jump_.segment<dimension>(row) - jump_.now().segment<dimension>(row);
      by_u.diagonal().setConstant(-1);
    } else if (t.is_open() && !path_) {
      own << f_n / c_n, f_t / c_t;
      by_f.diagonal().setConstant(1 / c_t);
      by_f(0, 0) = 1 / c_n;
    } else {
      constexpr int tangents = dimension - 1;
      using Row = Eigen::Matrix<double, 1, dimension>;
      const ReturnedTraction<tangents> returned = return_to_cone<tangents>(t);
      Row gap_by_u;
      gap_by_u << 1, -t.slip_direction.transpose() * t.dilation;
      const auto gap_by_t = gap_by_u.template tail<tangents>();
      auto by_f_t = by_f.bottomRightCorner<tangents, tangents>();
      own[0] = t.is_open() ? (f_n - t.tension) / c_n : has_present ? -t.gap : (f_n - t.normal) / c_n;
      own.template tail<tangents>() = (f_t - returned.tangential) / c_t;
      if (t.is_open()) {
        by_f(0, 0) = 1 / c_n;
      } else {
        by_f(0, 0) = (has_present ? 0 : 1 / c_n) - t.gap_by_traction;
        by_u.row(0) = -gap_by_u;
      }
      by_u.bottomRightCorner<tangents, tangents>() = -returned.by_trial;
      by_f_t.setIdentity();
      if (has_present) by_f_t -= returned.by_trial;
      by_f_t /= c_t;
      if (!t.sticks() && t.normal <= 0) {
        const TangentialVector by_normal = returned.by_bound * t.strength.friction / c_t;
        by_f.bottomLeftCorner<tangents, 1>() = by_normal * (has_present + c_n * t.gap_by_traction);
        by_u.bottomLeftCorner<tangents, 1>() = by_normal * c_n;
        by_u.bottomRightCorner<tangents, tangents>() += by_normal * c_n * gap_by_t;
      }
      if (path_) {
        // What weakens along the path: the tensile strength in the normal row, the bound in the tangential ones.
        Row path_by_u = t.path_by_gap * gap_by_u;
        path_by_u.template tail<tangents>() += t.path_by_slip.transpose();
        const double path_by_f = t.path_by_gap * t.gap_by_traction;
        if (t.is_open()) {
          by_f(0, 0) -= t.strength.tension_by_path * path_by_f / c_n;
          by_u.row(0) -= t.strength.tension_by_path * path_by_u / c_n;
        }
        if (!t.sticks()) {
          const double by_path = t.strength.cohesion_by_path - t.strength.friction_by_path * std::min(0.0, t.normal);
          by_f.bottomLeftCorner<tangents, 1>() -= returned.by_bound * by_path * path_by_f / c_t;
          by_u.bottomRows<tangents>() -= returned.by_bound * by_path * path_by_u / c_t;
        }
      }
    }
    for (int k = 0; k < dimension; ++k)
      for (int l = 0; l < dimension; ++l) {
        if (k > 0 || l == 0) by_traction.emplace_back(row + k, row + l, by_f(k, l));
        by_jump.emplace_back(row + k, row + l, by_u(k, l));
      }
  }
  assembly.add(traction_, residual);
  // The residual is compared with the jumps, or, where all cells stick, with the jumps that the tractions would make.
  assembly.compare_with(traction_, traction_.now().cwiseQuotient(stiffness()).lpNorm<Eigen::Infinity>());
  assembly.compare_with(traction_, jump_.now().lpNorm<Eigen::Infinity>());
  if (!assembly.wants_derivatives()) return;
  const int rows = dimension * count;
  SparseMatrix tractions(rows, rows), jumps(rows, rows);
  tractions.setFromTriplets(by_traction.begin(), by_traction.end());
  jumps.setFromTriplets(by_jump.begin(), by_jump.end());
  assembly.derivative(traction_, traction_, std::move(tractions));
  assembly.derivative(traction_, jump_, std::move(jumps));
}

void FrictionalContact::report(std::vector<Quantity>& quantities) const {
  int counts[3] = {0, 0, 0};
  for (int i = 0; i < mesh_.fracture_cell_count(); ++i) ++counts[static_cast<int>(state(i))];
  quantities.push_back({name() + ".cells_stick", "1", static_cast<double>(counts[0])});
  quantities.push_back({name() + ".cells_slip", "1", static_cast<double>(counts[1])});
  quantities.push_back({name() + ".cells_open", "1", static_cast<double>(counts[2])});
}

void FrictionalContact::output(std::vector<OutputField>& fields) const {
  Vector states(mesh_.fracture_cell_count());
  for (int i = 0; i < states.size(); ++i) states[i] = static_cast<double>(state(i));
  fields.push_back({name() + ".state_0_stick_1_slip_2_open", "1", Location::fracture_cell, 1, std::move(states)});
}

}  // namespace sprekk::contact
