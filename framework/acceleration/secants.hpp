// Differences of iterates, from which quasi-Newton methods learn how a fixed-point iteration answers.
#pragma once

#include <Eigen/Core>
#include <deque>
#include <string>

#include "framework/config/spec.hpp"
#include "framework/types.hpp"

namespace sprekk {

/// Which differences are left out because they are nearly combinations of newer ones (Haelterman, Bogaers, Scheufele,
/// Uekermann and Mehl, Comput. Struct. 171 (2016) 9).
struct SecantFilter {
  std::string kind = "qr2";  ///< "none", "qr1", "qr2"
  double limit = 1e-6;       ///< of a difference, what newer ones must leave for it to count
  void add_to(Spec& spec);
};

/// Differences of residuals r = G(x) − x, and those of G(x) that belong to them; newest first. Columns of the same
/// number are a pair.
struct Secants {
  std::deque<Vector> of_residual, of_image;
};

/// Orthonormal columns Q and a triangular R with V = Q R for the differences V of residuals that the filter keeps, and
/// the differences of images that belong to these.
struct FilteredSecants {
  Eigen::MatrixXd q, r, of_image;
  Eigen::MatrixXd of_residual;  ///< V

  /// Weights c that make |residual − V c| least.
  Vector weights(const Vector& residual) const;
  /// R^-1 Q^T, with which weights are found.
  Eigen::MatrixXd pseudo_inverse() const;
};

/// Gram and Schmidt's method (each column twice), from the newest column on. A column is left out when what is left of
/// it is less than `limit` times the norm of all columns (qr1) or its own (qr2), or round-off.
FilteredSecants filtered(const Secants& secants, const SecantFilter& filter);

/// The differences of successive passes of one iteration.
class SecantsOfPasses {
 public:
  void begin();
  void add(const Vector& residual, const Vector& image);
  const Secants& secants() const { return secants_; }

 private:
  Secants secants_;
  Vector last_residual_, last_image_;
};

}  // namespace sprekk
