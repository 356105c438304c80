#include "components/fracture_flow/laws/known_laws.hpp"

#include "components/fracture_flow/laws/cubic_law.hpp"
#include "components/fracture_flow/laws/rough_law.hpp"
#include "framework/invariants.hpp"

namespace sprekk::fracture_flow {

namespace {

struct Entry {
  std::string name, doc;
  std::unique_ptr<HydraulicLaw> (*make)(const HydraulicLawParameters&);
};

const std::vector<Entry>& laws() {
  static const std::vector<Entry> entries = {{"cubic", "a^3/12 of smooth walls",
                                              [](const HydraulicLawParameters& p) -> std::unique_ptr<HydraulicLaw> {
                                                return std::make_unique<CubicLaw>(p.lowest);
                                              }},
                                             {"rough", "a^3/12/(1 + 6 (roughness/a)^1.5) of rough walls (Lomize 1951)",
                                              [](const HydraulicLawParameters& p) -> std::unique_ptr<HydraulicLaw> {
                                                return std::make_unique<RoughLaw>(p.lowest, p.roughness);
                                              }}};
  return entries;
}

}  // namespace

HydraulicLaws& hydraulic_laws() {
  static HydraulicLaws registered = [] {
    NamesWithDocs built_in;
    for (const Entry& law : laws()) built_in.emplace_back(law.name, law.doc);
    built_in.emplace_back("constant", "the value given as transmissivity, whatever the aperture is");
    built_in.emplace_back("formula", "the formula of the state given as transmissivity");
    return HydraulicLaws(std::move(built_in));
  }();
  return registered;
}

namespace {

const RegisterLawKind kind_of_transmissivity({"transmissivity", "law: {type: NAME}",
                                              [] { return hydraulic_laws().names(); }});

}  // namespace

std::unique_ptr<HydraulicLaw> make_hydraulic_law(const std::string& name, const HydraulicLawParameters& parameters) {
  SPREKK_EXPECT(parameters.lowest > 0, parameters.lowest);
  for (const Entry& law : laws())
    if (law.name == name) return law.make(parameters);
  SPREKK_EXPECT(false, name);
  return nullptr;
}

}  // namespace sprekk::fracture_flow
