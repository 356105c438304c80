// iqn_imvj: interface quasi-Newton with the inverse Jacobian from all time steps.
#include <algorithm>

#include "framework/acceleration/quasi_newton.hpp"
#include "framework/acceleration/registry.hpp"
#include "framework/dense/least_squares.hpp"
#include "framework/dense/svd.hpp"

namespace sprekk {

namespace {

struct IqnImvjOptions : QuasiNewtonOptions {
  int rank = 100;
  Spec spec();
  std::unique_ptr<Accelerator> build() const;
};

/// x_{k+1} = G(x_k) − J r_k, where J maps differences V of r = G(x) − x to those W of G(x): it is the matrix nearest to
/// that of the last time step with J V = W, so J = J_old + (W − J_old V) V⁺ (multi-vector update; Bogaers, Kok, Reddy
/// and Franz, Comput. Methods Appl. Mech. Engng 279 (2014) 113; Lindner, Mehl, Scheufele and Uekermann, Coupled
/// Problems 2015). J is kept as a product A B of few columns and rows; the `rank` largest singular values are kept
/// (restart by singular value decomposition; Scheufele and Mehl, SIAM J. Sci. Comput. 39 (2017) S404).
class IqnImvj : public QuasiNewton {
 public:
  explicit IqnImvj(const IqnImvjOptions& options) : options_(options) {}
  void begin(const Vector& scale) override;
  Vector next(const Vector& x, const Vector& image) override;
  void accepted() override;
  bool forget_steps() override {
    passes_.begin();
    const bool knew_some = a_.cols() > 0;
    a_.resize(0, 0);
    b_.resize(0, 0);
    return knew_some;
  }
  void save(std::map<std::string, Vector>& state) const override;
  void restore(const std::map<std::string, Vector>& state) override;

 private:
  Eigen::MatrixXd correction(const FilteredSecants& secants) const;  ///< W − J_old V
  void truncate();

  IqnImvjOptions options_;
  Eigen::MatrixXd a_, b_;                ///< J of the accepted time steps is A B; without scale
  Eigen::MatrixXd scaled_a_, scaled_b_;  ///< the same for values that are divided by the scale
};

void IqnImvj::begin(const Vector& scale) {
  QuasiNewton::begin(scale);
  if (a_.rows() != scale.size()) {
    a_.resize(scale.size(), 0);
    b_.resize(0, scale.size());
  }
  scaled_a_ = scale.cwiseInverse().asDiagonal() * a_;
  scaled_b_ = b_ * scale.asDiagonal();
}

Eigen::MatrixXd IqnImvj::correction(const FilteredSecants& secants) const {
  return secants.of_image - scaled_a_ * (scaled_b_ * secants.of_residual);
}

Vector IqnImvj::next(const Vector& x, const Vector& image) {
  const Vector residual = image - x;
  passes_.add(residual, image);
  const FilteredSecants known = options_.chosen(passes_.secants());
  if (known.q.cols() == 0 && scaled_a_.cols() == 0) return x + options_.first * residual;
  Vector next = image - scaled_a_ * (scaled_b_ * residual);
  if (known.q.cols() > 0) next -= correction(known) * known.weights(residual);
  return next;
}

void IqnImvj::accepted() {
  const FilteredSecants known = options_.chosen(passes_.secants());
  passes_.begin();
  if (known.q.cols() == 0) return;
  const Eigen::MatrixXd more_a = scale_.asDiagonal() * correction(known);
  const Eigen::MatrixXd more_b = known.pseudo_inverse() * scale_.cwiseInverse().asDiagonal();
  Eigen::MatrixXd a(a_.rows(), a_.cols() + more_a.cols()), b(b_.rows() + more_b.rows(), b_.cols());
  a << a_, more_a;
  b << b_, more_b;
  a_ = std::move(a);
  b_ = std::move(b);
  if (a_.cols() > options_.rank) truncate();
}

/// Singular values of J in the scale of the last step: those of the small matrix R_A R_B^T.
void IqnImvj::truncate() {
  const Eigen::MatrixXd a = scale_.cwiseInverse().asDiagonal() * a_, b = (b_ * scale_.asDiagonal()).transpose();
  const ThinQr of_a = thin_qr(a), of_b = thin_qr(b);
  const DenseSvd svd(of_a.r * of_b.r.transpose(), Eigen::ComputeThinU | Eigen::ComputeThinV);
  const Eigen::Index rank = std::min<Eigen::Index>(options_.rank, of_a.r.rows());
  a_ = scale_.asDiagonal() *
       (of_a.q * (svd.matrixU().leftCols(rank) * svd.singularValues().head(rank).asDiagonal())).eval();
  b_ = (of_b.q * svd.matrixV().leftCols(rank)).transpose() * scale_.cwiseInverse().asDiagonal();
}

void IqnImvj::save(std::map<std::string, Vector>& state) const {
  state["a"] = a_.reshaped();
  state["b"] = b_.reshaped();
  state["rank"] = Vector::Constant(1, static_cast<double>(a_.cols()));
}

void IqnImvj::restore(const std::map<std::string, Vector>& state) {
  a_.resize(0, 0);
  b_.resize(0, 0);
  const auto a = state.find("a"), b = state.find("b"), rank = state.find("rank");
  if (a == state.end() || b == state.end() || rank == state.end() || rank->second.size() != 1) return;
  const auto count = static_cast<Eigen::Index>(rank->second[0]);
  if (count <= 0 || a->second.size() % count != 0 || a->second.size() != b->second.size()) return;
  const Eigen::Index size = a->second.size() / count;
  a_ = a->second.reshaped(size, count);
  b_ = b->second.reshaped(count, size);
}

Spec IqnImvjOptions::spec() {
  Spec spec("iqn_imvj", "Interface quasi-Newton method: a matrix that all time steps improve.");
  spec.integer("rank", rank, {.range = between(1, 10000), .doc = "Largest rank of the matrix that is kept."});
  add_to(spec, "Differences of a time step");
  return spec;
}

std::unique_ptr<Accelerator> IqnImvjOptions::build() const { return std::make_unique<IqnImvj>(*this); }

const RegisterAccelerator<IqnImvjOptions> registration("iqn_imvj");

}  // namespace

}  // namespace sprekk
