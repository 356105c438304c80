#include "components/contact/laws/friction.hpp"

#include "components/contact/laws/friction_options.hpp"

namespace sprekk::contact {

FrictionLaws& friction_laws() {
  static FrictionLaws registered(NamesWithDocs{
      {"constant", "`friction` itself, a number or a formula, with what `weakening` or `rate_and_state` say"}});
  return registered;
}

namespace {

const RegisterLawKind kind_of_friction({"friction", "friction_law: {type: NAME}",
                                        [] { return friction_laws().names(); }});

}  // namespace

Spec FrictionOptions::spec() {
  Spec spec("friction_law", "How friction changes with slip, path, slip rate and pressure, from `friction` on.");
  spec.choice("type", type, friction_laws().names(),
              {.doc = "The law. Others come from plug-ins: `sprekk new law NAME --kind friction`."});
  registered.add_sections(spec, friction_laws());
  spec.check([this](const Node& node) { registered.check(node, type, "type"); });
  return spec;
}

std::unique_ptr<FrictionLaw> FrictionOptions::build() const { return registered.build(type, {}); }

}  // namespace sprekk::contact
