// iqn_ils: interface quasi-Newton with the inverse Jacobian from a least-squares model.
#include <Eigen/Core>
#include <cmath>

#include "framework/acceleration/quasi_newton.hpp"
#include "framework/acceleration/registry.hpp"

namespace sprekk {

namespace {

struct IqnIlsOptions : QuasiNewtonOptions {
  int reuse = 0;
  Spec spec();
  std::unique_ptr<Accelerator> build() const;
};

/// x_{k+1} = G(x_k) − W c, with the c that makes |r_k − V c| least; V and W are differences of r = G(x) − x and of G(x)
/// in this time step and in the last `reuse` (Degroote, Bathe and Vierendeels, Comput. Struct. 87 (2009) 793).
class IqnIls : public QuasiNewton {
 public:
  explicit IqnIls(const IqnIlsOptions& options) : options_(options) {}
  Vector next(const Vector& x, const Vector& image) override;
  void accepted() override;
  bool forget_steps() override {
    passes_.begin();
    const bool knew_some = !former_.empty();
    former_.clear();
    return knew_some;
  }
  void save(std::map<std::string, Vector>& state) const override;
  void restore(const std::map<std::string, Vector>& state) override;

 private:
  IqnIlsOptions options_;
  std::deque<Secants> former_;  ///< of the last time steps, newest first; without scale
};

Vector IqnIls::next(const Vector& x, const Vector& image) {
  const Vector residual = image - x;
  passes_.add(residual, image);
  Secants all = passes_.secants();
  for (const Secants& step : former_) {
    if (!step.of_residual.empty() && step.of_residual.front().size() != scale_.size()) continue;
    for (std::size_t j = 0; j < step.of_residual.size(); ++j) {
      all.of_residual.push_back(step.of_residual[j].cwiseQuotient(scale_));
      all.of_image.push_back(step.of_image[j].cwiseQuotient(scale_));
    }
  }
  const FilteredSecants secants = options_.chosen(std::move(all));
  if (secants.q.cols() == 0) return x + options_.first * residual;
  return image - secants.of_image * secants.weights(residual);
}

void IqnIls::accepted() {
  if (options_.reuse == 0 || passes_.secants().of_residual.empty()) return passes_.begin();
  Secants step = passes_.secants();
  for (auto* columns : {&step.of_residual, &step.of_image})
    for (Vector& column : *columns) column = column.cwiseProduct(scale_);
  former_.push_front(std::move(step));
  if (static_cast<int>(former_.size()) > options_.reuse) former_.pop_back();
  passes_.begin();
}

void IqnIls::save(std::map<std::string, Vector>& state) const {
  Vector counts(former_.size());
  std::vector<double> values;
  for (std::size_t i = 0; i < former_.size(); ++i) {
    counts[static_cast<Eigen::Index>(i)] = static_cast<double>(former_[i].of_residual.size());
    for (const auto* columns : {&former_[i].of_residual, &former_[i].of_image})
      for (const Vector& column : *columns) values.insert(values.end(), column.begin(), column.end());
  }
  state["columns"] = counts;
  state["values"] = Eigen::Map<const Vector>(values.data(), static_cast<Eigen::Index>(values.size()));
}

void IqnIls::restore(const std::map<std::string, Vector>& state) {
  former_.clear();
  const auto counts = state.find("columns"), values = state.find("values");
  if (counts == state.end() || values == state.end()) return;
  const auto total = static_cast<Eigen::Index>(2 * counts->second.sum());
  if (total == 0 || values->second.size() % total != 0) return;
  const Eigen::Index size = values->second.size() / total;
  Eigen::Index next = 0;
  for (const double count : counts->second) {
    Secants step;
    for (auto* columns : {&step.of_residual, &step.of_image})
      for (int j = 0; j < count; ++j, next += size) columns->push_back(values->second.segment(next, size));
    former_.push_back(std::move(step));
  }
}

Spec IqnIlsOptions::spec() {
  Spec spec("iqn_ils", "Interface quasi-Newton method: least squares over differences of passes.");
  spec.integer("reuse", reuse,
               {.range = between(0, 1000), .doc = "Earlier time steps whose differences are used as well."});
  add_to(spec, "Differences");
  return spec;
}

std::unique_ptr<Accelerator> IqnIlsOptions::build() const { return std::make_unique<IqnIls>(*this); }

const RegisterAccelerator<IqnIlsOptions> registration("iqn_ils");

}  // namespace

}  // namespace sprekk
