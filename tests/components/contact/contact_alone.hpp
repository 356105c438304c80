// A contact without rock: its residual and its Jacobian at given tractions and jumps.
#pragma once

#include <gtest/gtest.h>

#include <memory>
#include <random>

#include "components/contact/frictional_contact.hpp"
#include "components/contact/options.hpp"
#include "components/contact/return_map.hpp"
#include "tests/components/meshes.hpp"

namespace sprekk::contact {

/// Two fractures that cross, one of them inclined: cells at a junction are among them.
inline Mesh crossing() {
  Geometry geometry = test::box(1, 1);
  FractureGeometry a, b;
  a.name = "a";
  a.points = {Point(0.2, 0.5), Point(0.8, 0.5)};
  b.name = "b";
  b.points = {Point(0.35, 0.25), Point(0.65, 0.75)};
  geometry.fractures = {a, b};
  return generate_mesh(geometry, test::unstructured(0.12));
}

struct Law {
  double friction = 0.6, dilation_angle = 0.1;
};

class Contact {
 public:
  explicit Contact(const Mesh& mesh, const Law& law = {}, const Options& laws = {},
                   Multiplier multiplier = Multiplier::present) {
    Options options = laws;
    options.friction = law.friction;
    options.dilation_angle = law.dilation_angle;
    contact_ =
        std::make_unique<FrictionalContact>(ComponentContext{"contact", mesh, fields_, 0, {}}, options, multiplier);
    contact_->evaluate_data(step);
    contact_->begin_step(step);
  }

  FrictionalContact& law() { return *contact_; }
  /// Tractions and jumps, (normal, tangential) of each cell each.
  void set(const Vector& traction, const Vector& jump) {
    contact_->traction().set(traction);
    contact_->jump().set(jump);
  }
  /// Newton's method looks at these values.
  void follow() { contact_->observe_iterate({&contact_->traction(), &contact_->jump()}); }
  Vector residual(Assembly::Request request = Assembly::Request::residual) const {
    Assembly assembly({&contact_->traction(), &contact_->jump()}, request);
    contact_->assemble(assembly, step);
    return assembly.residual(0);
  }
  /// d residual / d (tractions, jumps).
  Eigen::MatrixXd jacobian() const {
    Assembly assembly({&contact_->traction(), &contact_->jump()}, Assembly::Request::residual_and_derivatives);
    contact_->assemble(assembly, step);
    const int n = contact_->traction().size();
    Eigen::MatrixXd all = Eigen::MatrixXd::Zero(n, 2 * n);
    for (const Assembly::Block& block : assembly.blocks())
      all.middleCols(block.column * n, n) += block.factor * Eigen::MatrixXd(*block.matrix);
    return all;
  }

  static constexpr StepTime step{0, 1, 1};

 private:
  FieldStore fields_;
  std::unique_ptr<FrictionalContact> contact_;
};

/// Tractions, jumps, and jumps at the start of the step with which cells stick, slip to either side, before and after
/// the limit of dilation, and are open, with strength left and without. Begins the step, and follows other tractions
/// before: multipliers of another iterate.
struct Sample {
  Vector traction, jump;
  Sample(Contact& contact, int cells, std::mt19937& random) : traction(2 * cells), jump(2 * cells) {
    std::uniform_real_distribution<double> any(-1, 1);
    Vector before(2 * cells);
    for (int i = 0; i < cells; ++i) {
      const double bias = any(random) < 0.3 ? 3 : -3;
      traction.segment<2>(2 * i) << bias + 3 * any(random), 4 * any(random);
      jump.segment<2>(2 * i) << 0.3 * any(random) + (bias > 0), 1.5 * any(random);
      before.segment<2>(2 * i) << 0, jump[2 * i + 1] + any(random);
    }
    contact.law().jump().set_both(before);
    contact.law().begin_step(Contact::step);
    contact.set(0.7 * traction, jump);
    contact.follow();
    contact.set(traction, jump);
  }
};

/// Each column of the Jacobian is a difference of residuals over `change`, within `bound`.
inline void expect_differences(Contact& contact, const Sample& at, double change, double bound) {
  const Eigen::MatrixXd jacobian = contact.jacobian();
  const auto n = at.traction.size();
  for (int column = 0; column < 2 * n; ++column) {
    const auto residual = [&](double sign) {
      Vector f = at.traction, u = at.jump;
      (column < n ? f[column] : u[column - n]) += sign * change;
      contact.set(f, u);
      return contact.residual();
    };
    const Vector difference = (residual(1) - residual(-1)) / (2 * change);
    EXPECT_LT((jacobian.col(column) - difference).lpNorm<Eigen::Infinity>(), bound) << "column " << column;
  }
}

}  // namespace sprekk::contact
