// __type__: a quantity u of each cell that decays and is supplied, C du/dt = s − r u. Replace it by your physics.
#include <algorithm>
#include <map>

#include "framework/scene/registry.hpp"

namespace __name__ {

using namespace sprekk;

/// The parameters. From this one declaration come reading with units, messages, `sprekk explain` and the schema.
struct Options {
  Data capacity, rate, source, initial_value;
  Spec spec() {
    Spec spec("__type__", "A quantity that decays in each cell.");
    spec.ignore("type");
    spec.data("capacity", capacity, {.range = positive(), .doc = "Capacity C.", .required = true});
    spec.data("rate", rate, {.unit = "1/s", .range = non_negative(), .doc = "Rate of decay r.", .required = true});
    spec.data("source", source, {.unit = "1/s", .doc = "Supply s per area.", .in_time = true});
    spec.data("initial_value", initial_value, {.doc = "u at the start."});
    return spec;
  }
};

/// Unknown: u, one a cell. Its equation over a time step, by backward Euler: V C (u − u_old) + dt V r u = dt V s.
class __Class__ : public Component {
 public:
  __Class__(const ComponentContext& context, const Options& options)
      : Component(context.name),
        mesh_(context.mesh),
        options_(options),
        u_(context.fields.add(mesh_, {.owner = context.name,
                                      .name = "u",
                                      .location = Location::cell,
                                      .role = Role::unknown(BlockKind::bulk_elliptic),
                                      .unit = "1",
                                      .doc = "The quantity"})) {
    u_.set_both(on_cells([&](const Place& place) { return options_.initial_value.at(place); }, context.start_time));
  }

  /// The data of a step. It is also called before the run, so that a table that ends too early is found then.
  void evaluate_data(const StepTime& step) override {
    const auto volumes = mesh_.cell_measure;
    capacity_ = on_cells([&](const Place& place) { return options_.capacity.at(place); }, step.end);
    decay_ = on_cells([&](const Place& place) { return options_.rate.at(place); }, step.end);
    source_ = on_cells([&](const Place& place) { return value_in_step(options_.source, place, step); }, step.end);
    for (int c = 0; c < mesh_.cell_count(); ++c) {
      capacity_[c] *= volumes[c];
      decay_[c] *= volumes[c];
      source_[c] *= volumes[c];
    }
  }

  void begin_step(const StepTime&) override {}  // nothing to discretize anew

  /// Each term is written once, and by itself: what is left of the equation is compared with its terms.
  void assemble(Assembly& assembly, const StepTime& step) const override {
    if (!assembly.has_row(u_)) return;
    assembly.add(u_, capacity_.cwiseProduct(u_.now() - u_.accepted()));
    assembly.add(u_, step.dt * decay_.cwiseProduct(u_.now()));
    assembly.add(u_, -step.dt * source_);
    assembly.diagonal(u_, u_, capacity_ + step.dt * decay_);
  }

  /// Times at which data jump: steps end there.
  std::vector<double> switch_times() const override { return options_.source.switch_times(); }

 private:
  template <class Function>
  Vector on_cells(const Function& value, double time) const {
    Vector values(mesh_.cell_count());
    for (int c = 0; c < mesh_.cell_count(); ++c)
      values[c] = value(Place{mesh_.cell_center[c], mesh_.cell_region[c], time});
    return values;
  }

  const Mesh& mesh_;
  Options options_;
  Field& u_;
  Vector capacity_, decay_, source_;  ///< of each cell, times its area
};

const RegisterComponent<__Class__, Options> registration("__type__");

}  // namespace __name__
