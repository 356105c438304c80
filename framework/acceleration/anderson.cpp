// anderson: the last passes are combined so that the linearized residual is least.
#include <Eigen/Core>
#include <deque>

#include "framework/acceleration/registry.hpp"
#include "framework/dense/least_squares.hpp"
#include "framework/invariants.hpp"

namespace sprekk {

namespace {

/// x_{k+1} = G(x_k) combined with up to `depth` earlier iterates so that the linearized residual G(x) − x is least
/// (Anderson 1965; in the form of Walker and Ni 2011). Where the residual has grown, earlier iterates are dropped.
class Anderson : public Accelerator {
 public:
  explicit Anderson(int depth) : depth_(depth) {}
  void begin(const Vector&) override { forget(); }
  void forget() override {
    image_differences_.clear();
    residual_differences_.clear();
    last_image_.resize(0);
  }
  Vector next(const Vector& x, const Vector& image) override;

 private:
  int depth_;
  std::deque<Vector> image_differences_, residual_differences_;
  Vector last_image_, last_residual_;
};

Vector Anderson::next(const Vector& x, const Vector& image) {
  SPREKK_EXPECT(x.size() == image.size(), x.size(), image.size());
  SPREKK_EXPECT(is_finite(x) && is_finite(image));
  SPREKK_ASSERT(image_differences_.size() == residual_differences_.size());
  const Vector residual = image - x;
  if (last_residual_.size() == residual.size() && residual.norm() > last_residual_.norm()) forget();
  if (last_image_.size() == image.size()) {
    image_differences_.push_back(image - last_image_);
    residual_differences_.push_back(residual - last_residual_);
    if (static_cast<int>(image_differences_.size()) > depth_) {
      image_differences_.pop_front();
      residual_differences_.pop_front();
    }
  }
  last_image_ = image;
  last_residual_ = residual;
  const int m = static_cast<int>(residual_differences_.size());
  SPREKK_ASSERT(m <= depth_, m, depth_);
  if (m == 0) return image;
  Eigen::MatrixXd differences(residual.size(), m);
  for (int j = 0; j < m; ++j) differences.col(j) = residual_differences_[j];
  const Vector weights = LeastSquares(differences).solve(residual);
  Vector next = image;
  for (int j = 0; j < m; ++j) next -= weights[j] * image_differences_[j];
  return next;
}

struct AndersonOptions {
  int depth = 0;
  void declare(Spec& accelerate, const std::string& name) {
    accelerate.integer(
        name, depth,
        {.range = between(0, 50), .doc = "Earlier passes that Anderson acceleration combines; 0 is none."});
  }
  bool is_chosen() const { return depth > 0; }
  std::unique_ptr<Accelerator> build() const { return std::make_unique<Anderson>(depth); }
};

const RegisterAccelerator<AndersonOptions> registration("anderson");

}  // namespace

}  // namespace sprekk
