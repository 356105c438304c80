// outside/program: with the capabilities that its fields give it.
#include <limits>

#include "components/capabilities/given_on_fractures.hpp"
#include "components/capabilities/matrix_fluid.hpp"
#include "components/capabilities/temperature.hpp"
#include "components/outside/program.hpp"
#include "framework/assembly/balance_rows.hpp"
#include "framework/field/units_of_amounts.hpp"
#include "framework/scene/registry.hpp"

namespace sprekk::outside {
namespace {

constexpr const char* rock_pressure = "rock_pressure";
constexpr const char* rock_temperature = "rock_temperature";

/// The program determines the pressure of the fluid in the rock.
template <class Base>
class WithPressure : public Base, public MatrixFluid {
 public:
  using Base::Base;
  Field& pressure() override { return this->given(rock_pressure); }
  const Vector& initial_pressure() const override { return this->initial(rock_pressure); }
  /// What the program is given is not known.
  double largest_given_pressure() const override { return std::numeric_limits<double>::infinity(); }
  const Property* porosity_for_storage() const override { return nullptr; }
  void change_viscosity(const Vector&) override {
    throw DataError(this->name() +
                    " has no viscosity here: its pressure is that of another program (take it out of "
                    "'between')");
  }
  double diffusivity(int) const override { return std::numeric_limits<double>::infinity(); }
  void accept_rock_storage(const Vector& storage) override { rock_storage_ = storage; }
  void assemble(Assembly& assembly, const StepTime& step) const override {
    Base::assemble(assembly, step);
    const BalanceRows fluid(assembly, this->given(rock_pressure), "fluid");
  }
  void balance(std::map<std::string, Balance>& balances) const override {
    Base::balance(balances);
    balances["fluid"].unit = volume_unit;
    balances["fluid"].is_closed = false;
  }

 protected:
  void tell_more(OutsideMessage& begin) const override {
    Base::tell_more(begin);
    if (rock_storage_.size() > 0)
      begin.reals.emplace_back(this->given(rock_pressure).spec().name + ".rock_storage", rock_storage_);
  }

 private:
  Vector rock_storage_;  ///< 1/Pa
};

/// The program determines the temperature of the rock.
template <class Base>
class WithTemperature : public Base, public MatrixTemperature {
 public:
  using Base::Base;
  void assemble(Assembly& assembly, const StepTime& step) const override {
    Base::assemble(assembly, step);
    const BalanceRows heat(assembly, this->given(rock_temperature), carried_heat.quantity);
  }
  void balance(std::map<std::string, Balance>& balances) const override {
    Base::balance(balances);
    balances[carried_heat.quantity].unit = carried_heat.amount_unit;
    balances[carried_heat.quantity].is_closed = false;
  }
  const Carried& carried() const override { return carried_heat; }
  Field& value() override { return this->given(rock_temperature); }
  const Vector& capacity() const override { return nothing_; }
  const Vector& initial_value() const override { return this->initial(rock_temperature); }
  std::optional<double> side_value(int) const override { return std::nullopt; }
  const Vector& decay() const override { return nothing_; }
  void add_conductivity(std::vector<Tensor>) override {}  // what it conducts is the program's

 private:
  Vector nothing_;
};

template <class Base>
class WithAperture : public Base, public GivesAperture {
 public:
  using Base::Base;
  const Field& given_aperture() const override { return this->given("aperture"); }
};

template <class Base>
class WithFriction : public Base, public GivesFriction {
 public:
  using Base::Base;
  const Field& friction_factor() const override { return this->given("friction_factor"); }
};

/// Adds the capability of a role to a class, if the scene gives the role, and goes on with the next one.
class Building {
 public:
  Building(const ComponentContext& context, const Options& options) : context_(context), options_(options) {}
  std::unique_ptr<Component> build() const { return with_pressure<Program>(); }

 private:
  bool gives(const std::string& role) const {
    return std::ranges::any_of(options_.gives, [&](const auto& given) { return given.second.as == role; });
  }
  template <class Built>
  std::unique_ptr<Component> with_pressure() const {
    return gives(rock_pressure) ? with_temperature<WithPressure<Built>>() : with_temperature<Built>();
  }
  template <class Built>
  std::unique_ptr<Component> with_temperature() const {
    return gives(rock_temperature) ? with_aperture<WithTemperature<Built>>() : with_aperture<Built>();
  }
  template <class Built>
  std::unique_ptr<Component> with_aperture() const {
    return gives("aperture") ? with_friction<WithAperture<Built>>() : with_friction<Built>();
  }
  template <class Built>
  std::unique_ptr<Component> with_friction() const {
    if (gives("friction_factor")) return std::make_unique<WithFriction<Built>>(context_, options_);
    return std::make_unique<Built>(context_, options_);
  }

  const ComponentContext& context_;
  const Options& options_;
};

ComponentType type() {
  ComponentType type;
  type.type = "outside/program";
  type.spec = [] {
    static Options example;
    return example.spec();
  };
  type.read = [](const Node& node, const ReadContext& read) {
    auto options = std::make_shared<Options>();
    options->spec().read(node, read);
    return ComponentBuilder([options](const ComponentContext& context) { return Building(context, *options).build(); });
  };
  return type;
}

const bool is_registered = (Registry::instance().add(type()), true);

}  // namespace
}  // namespace sprekk::outside
