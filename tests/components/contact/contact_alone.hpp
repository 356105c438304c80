// A contact without rock: its residual and its Jacobian at given tractions and jumps.
#pragma once

#include <memory>

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

}  // namespace sprekk::contact
