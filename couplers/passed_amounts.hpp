// Amounts that one part has received and another one has counted, for parts that may be solved one after the other.
#pragma once

#include <algorithm>
#include <vector>

#include "framework/field/counted_amounts.hpp"
#include "framework/field/field_store.hpp"
#include "framework/field/ownership.hpp"
#include "framework/field/units_of_amounts.hpp"

namespace sprekk::couplers {

/// Fluid that passes from one part to another, an amount for each entity (volume_unit). Two sums are kept: what has
/// passed according to the solution for `by`, and how much of it the equations of `counting` have counted. So nothing
/// is lost if the two are solved one after the other, or one of them in substeps. After a step only the difference of
/// the sums is kept, since sums since the start would have the round-off of all fluid that has ever passed.
class PassedAmounts {
 public:
  /// Adds the fields `exchanged` and `counted` of a coupler. `location`: where the amounts are.
  PassedAmounts(FieldStore& fields, const Mesh& mesh, const std::string& owner, Location location, const Field& by,
                const Field& counting, const char* receiver, const char* counter)
      : mesh_(mesh), by_(by), counting_(counting) {
    const auto add = [&](const char* name, const Field& unknown, const std::string& doc) {
      FieldSpec spec = amounts_with(unknown, owner, name, volume_unit, doc);
      spec.location = location;
      return &fields.add(mesh, std::move(spec));
    };
    passed_ =
        add("exchanged", by,
            "Fluid that the " + std::string(receiver) + " has received, with what was not counted before the step");
    counted_ = add("counted", counting, "Of it, what the " + std::string(counter) + " has counted");
  }

  /// What has passed by now (or by the start of the step) and had not been counted before the step.
  Vector uncounted_now() const { return passed_->now() - counted_->accepted(); }
  Vector uncounted_at_start() const { return passed_->accepted() - counted_->accepted(); }

  /// To be called after each solve; `passing`: a function that gives what passes in the step.
  template <class Passing>
  void after_solve(const std::vector<Field*>& solved, const Passing& passing) {
    if (std::ranges::count(solved, &by_) > 0) passed_->set(passed_->accepted() + passing());
    if (std::ranges::count(solved, &counting_) > 0) counted_->set(passed_->now());
  }
  void accepted() {
    passed_->set_both(uncounted_at_start());
    counted_->set_both(Vector::Zero(counted_->size()));
  }
  void begin() {
    for (Field* amount : {passed_, counted_}) amount->set_both(Vector::Zero(amount->size()));
  }
  /// The sum over owned entities of what has passed and is not counted. Collective.
  double sum_uncounted() const { return sum_owned(mesh_, passed_->spec().location, passed_->now() - counted_->now()); }

 private:
  const Mesh& mesh_;
  const Field &by_, &counting_;
  Field *passed_ = nullptr, *counted_ = nullptr;
};

}  // namespace sprekk::couplers
