// The conditions of contact, cell by cell: states, and the whole Jacobian against differences in each of them.
#include "components/contact/frictional_contact.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "tests/components/contact/contact_alone.hpp"

namespace sprekk::contact {
namespace {

/// Traction and jump of a cell in units of Pa and of one over its stiffness, and the slip before the step.
struct CellState {
  const char* name;
  double f_n, f_t, u_n, u_t, slip_before;
  State state;
};

// With a friction of 0.6 and asperities of tan 0.1 = 0.1003.
const CellState states[] = {
    {"sticks", -10, 3, 0.02, 0.2, 0.2, State::stick},
    {"sticks without slip", -10, -3, 0.02, 0.01, 0, State::stick},
    {"slips forward", -10, 6.2, 0.1, 1.0, 0.3, State::slip},
    {"slips the other way", -10, -6.2, 0.1, -1.0, -0.3, State::slip},
    {"slides back", -10, -6.5, 0.12, 0.6, 1.0, State::slip},
    {"slides back the other way", -10, 6.5, 0.12, -0.6, -1.0, State::slip},
    {"is open", 0.5, 0.2, 0.9, 0.3, 0, State::open},
    {"is open and slides", 0, -0.1, 0.9, -0.3, 0.2, State::open},
};

/// All cells in the same state, each a little otherwise.
struct Values {
  Vector traction, jump, jump_before;
  Values(const CellState& state, int cells) : traction(2 * cells), jump(2 * cells), jump_before(2 * cells) {
    std::mt19937 random(17);
    std::uniform_real_distribution<double> nearby(0.98, 1.02);
    for (int i = 0; i < cells; ++i) {
      traction.segment<2>(2 * i) << state.f_n * nearby(random), state.f_t * nearby(random);
      jump.segment<2>(2 * i) << state.u_n * nearby(random), state.u_t * nearby(random);
      jump_before.segment<2>(2 * i) << 0, state.slip_before;
    }
  }
};

class InState : public ::testing::TestWithParam<CellState> {};
INSTANTIATE_TEST_SUITE_P(States, InState, ::testing::ValuesIn(states), [](const auto& info) {
  std::string name = info.param.name;
  for (char& c : name)
    if (c == ' ') c = '_';
  return name;
});

TEST_P(InState, HasTheDerivativesOfItsConditions) {
  const Mesh mesh = crossing();
  ASSERT_EQ(mesh.junctions.size(), 1u);
  for (const SearchMode mode : {SearchMode::with_shortcuts, SearchMode::piecewise}) {
    Contact contact(mesh);
    const int cells = mesh.fracture_cell_count(), n = 2 * cells;
    contact.law().set_wall_stiffness(Vector::LinSpaced(n, 1, 2));
    contact.law().set_search_mode(mode);
    const Values at(GetParam(), cells);
    contact.law().jump().set_both(at.jump_before);
    contact.set(at.traction, at.jump);
    for (int i = 0; i < cells; ++i) EXPECT_EQ(contact.law().state(i), GetParam().state) << i;
    const Eigen::MatrixXd jacobian = contact.jacobian();
    // The conditions are linear within a state, so central differences are exact.
    constexpr double change = 1e-4;
    for (int column = 0; column < 2 * n; ++column) {
      const auto residual = [&](double sign) {
        Vector traction = at.traction, jump = at.jump;
        (column < n ? traction[column] : jump[column - n]) += sign * change;
        contact.set(traction, jump);
        return contact.residual();
      };
      const Vector difference = (residual(1) - residual(-1)) / (2 * change);
      EXPECT_LT((jacobian.col(column) - difference).lpNorm<Eigen::Infinity>(), 1e-9) << "column " << column;
    }
  }
}

TEST_P(InState, GivesTheSameBitsTwice) {
  const Mesh mesh = crossing();
  Contact contact(mesh);
  const int cells = mesh.fracture_cell_count();
  contact.law().set_wall_stiffness(Vector::Ones(2 * cells));
  const Values at(GetParam(), cells);
  contact.law().jump().set_both(at.jump_before);
  // Newton's method may assemble these states before, and states in which other cells slide back.
  for (const double scale : {1.0, -1.0, 1.0, 0.5, 1.0}) {
    contact.set(scale * at.traction, at.jump);
    contact.follow();
    const Eigen::MatrixXd first = contact.jacobian();
    const Vector residual = contact.residual(Assembly::Request::residual_and_derivatives);
    // The result does not depend on what was assembled before either: here slip in the wrong direction, from which it
    // slides back.
    contact.set(-at.traction, at.jump_before + 2 * (at.jump_before - at.jump));
    contact.jacobian();
    contact.set(scale * at.traction, at.jump);
    EXPECT_EQ(contact.jacobian(), first) << scale;
    EXPECT_EQ(contact.residual(Assembly::Request::residual_and_derivatives), residual) << scale;
  }
}

// A cell for which sliding back has led to slip the wrong way takes the linear function that goes through the values
// beyond the kink of |slip|.
TEST(BackSlip, TakesThePieceBeyondTheKink) {
  const Mesh mesh = crossing();
  Contact contact(mesh);
  const int cells = mesh.fracture_cell_count(), n = 2 * cells;
  contact.law().set_wall_stiffness(Vector::Ones(n));
  contact.law().set_search_mode(SearchMode::without_shortcuts);  // with the stiffness that it has in pieces, too
  const Values back(states[4], cells), forward(states[2], cells);
  contact.law().jump().set_both(back.jump_before);
  contact.set(back.traction, back.jump);
  contact.follow();
  Vector wrong = back.jump;
  for (int i = 0; i < cells; ++i) wrong[2 * i + 1] = 1.5;  // beyond the slip before, against the direction of sliding
  contact.set(forward.traction, wrong);
  contact.follow();
  contact.set(back.traction, back.jump);
  contact.follow();
  const Eigen::MatrixXd jacobian = contact.jacobian();
  const Vector residual = contact.residual(Assembly::Request::residual_and_derivatives);

  Vector beyond = back.jump, traction = back.traction;
  for (int i = 0; i < cells; ++i) {
    beyond[2 * i + 1] = -0.4 - 0.01 * i;
    traction[2 * i] -= 0.3;
  }
  Vector change(2 * n);
  change << traction - back.traction, beyond - back.jump;
  contact.law().set_search_mode(SearchMode::piecewise);
  contact.set(traction, beyond);
  for (int i = 0; i < cells; ++i) EXPECT_EQ(contact.law().state(i), State::slip);
  EXPECT_LT((residual + jacobian * change - contact.residual()).lpNorm<Eigen::Infinity>(), 1e-12);
}

/// Cells that have slipped by 1, and are about to slide: their traction along the wall is next to nothing.
class NothingHolds : public ::testing::TestWithParam<Law> {
 protected:
  NothingHolds() : mesh_(crossing()), contact_(mesh_, GetParam()) {
    contact_.law().set_wall_stiffness(Vector::Ones(2 * cells()));
    contact_.law().set_search_mode(SearchMode::without_shortcuts);
    contact_.law().jump().set_both(slipped(1));
  }
  int cells() const { return mesh_.fracture_cell_count(); }
  Vector slipped(double slip) const {
    Vector jump(2 * cells());
    for (int i = 0; i < cells(); ++i) jump.segment<2>(2 * i) << 0.1 * slip, slip;
    return jump;
  }
  /// Without friction: the normal traction is zero, or the coefficient of friction is.
  Vector held_by(double along) const {
    Vector traction(2 * cells());
    for (int i = 0; i < cells(); ++i) traction.segment<2>(2 * i) << (GetParam().friction > 1e-3 ? -1e-13 : -10), along;
    return traction;
  }
  const Mesh mesh_;
  Contact contact_;
};
INSTANTIATE_TEST_SUITE_P(, NothingHolds, ::testing::Values(Law{0, 0.1}, Law{1e-14, 0.1}, Law{0.6, std::atan(0.1)}),
                         [](const auto& info) { return "of_law_" + std::to_string(info.index); });

// The round-off of a traction that vanishes does not say which way a cell slides, so what it has tried stays true:
// the derivatives of a cell that slides back are those of its conditions, here and not beyond the kink.
TEST_P(NothingHolds, RoundOffDoesNotSayWhereACellSlides) {
  for (const double along : {-1e-12, 1e-12}) {
    contact_.law().begin_step(Contact::step);
    contact_.set(held_by(along), slipped(1));
    contact_.follow();
    contact_.set(held_by(along), slipped(1.2));
    contact_.follow();
    const Vector traction = held_by(0), jump = slipped(0.8);
    contact_.set(traction, jump);
    contact_.follow();
    const Eigen::MatrixXd jacobian = contact_.jacobian();
    constexpr double change = 1e-4;
    const int n = 2 * cells();
    for (int i = 0; i < cells(); ++i)
      for (const int component : {0, 1}) {
        const auto residual = [&](double sign) {
          Vector nearby = jump;
          nearby[2 * i + component] += sign * change;
          // Within the state: walls that touch.
          Vector pressed = traction;
          pressed[2 * i] -= 1;
          contact_.set(pressed, nearby);
          return Vector(contact_.residual());
        };
        const Vector difference = (residual(1) - residual(-1)) / (2 * change);
        EXPECT_NEAR(jacobian(2 * i, n + 2 * i + component), difference[2 * i], 1e-9) << i;
      }
  }
}

// Without friction the direction of slip is no discrete state, and there is no sticking state to keep.
TEST(WithoutFriction, DirectionsAreNoStates) {
  const Mesh mesh = crossing();
  Contact contact(mesh, {0, 0.1});
  const int cells = mesh.fracture_cell_count();
  contact.law().set_wall_stiffness(Vector::Ones(2 * cells));
  const Values back(states[4], cells);
  Vector one = back.traction, other = back.traction;
  for (int i = 0; i < cells; ++i) {
    one[2 * i + 1] = i % 2 == 0 ? 1e-12 : -1e-12;
    other[2 * i + 1] = -1e-12;
  }
  contact.law().jump().set_both(back.jump);
  contact.law().traction().set_both(back.traction);
  contact.set(one, back.jump);
  const std::uint64_t state = contact.law().discrete_state();
  contact.set(other, back.jump);
  EXPECT_EQ(contact.law().discrete_state(), state);
  contact.law().jump().set_both(back.jump_before);
  contact.set(other, back.jump);
  contact.follow();
  EXPECT_EQ(contact.law().keep_states(), 0);
}

// Walls that slide freely while they are open overlap by |slip| tan psi. They are to be taken to slip then; a normal
// stiffness that is too large for the wedge would have them stick.
TEST(DilationWedge, WallsThatSlideFreelyAreTakenToSlip) {
  const Mesh mesh = crossing();
  const int cells = mesh.fracture_cell_count();
  for (const double friction : {0.1, 0.6, 1.5})
    for (const double angle : {0.02, 0.2, 0.7})
      for (const double ratio : {1e-3, 1.0, 1e3, 1e9}) {
        Contact contact(mesh, {friction, angle});
        Vector stiffness = Vector::Ones(2 * cells);
        for (int i = 0; i < cells; ++i) stiffness[2 * i] = ratio;
        contact.law().set_wall_stiffness(stiffness);
        for (const double slip : {1e-3, -1e-3}) {
          Vector jump = Vector::Zero(2 * cells);
          for (int i = 0; i < cells; ++i) jump[2 * i + 1] = slip;
          contact.set(Vector::Zero(2 * cells), jump);
          for (int i = 0; i < cells; ++i)
            EXPECT_EQ(contact.law().state(i), State::slip) << friction << " " << angle << " " << ratio;
        }
      }
}

}  // namespace
}  // namespace sprekk::contact
