#include "components/poromechanics/excavation.hpp"

#include <algorithm>

#include "components/capabilities/one_place.hpp"
#include "framework/config/input_error.hpp"
#include "framework/invariants.hpp"

namespace sprekk::poromechanics {

Spec ExcavatedRegion::spec() {
  Spec spec("excavation of a region",
            "Takes the region away: what is around it loses its stiffness, and the stress on its outline.");
  spec.data("support", support,
            {.range = between(0, 1),
             .doc = "Part of the initial stress of the region that still acts on its outline: 1 as long as the region "
                    "is there, 0 when nothing supports the outline any more. In steps with "
                    "less than 1 the region has no stiffness.",
             .source = "convergence and confinement, Panet and Guenot 1982",
             .required = true,
             .in_time = true});
  return spec;
}

void add_excavation(Spec& spec, ExcavatedRegions& regions) {
  static ExcavatedRegion example;
  spec.named_sections("excavation", example.spec(),
                      [&regions](const std::string& key, const Origin& origin) {
                        regions[key].origin = origin;
                        return regions[key].spec();
                      },
                      {.doc = "Regions that are taken away, by name."});
}

Excavation::Excavation(const ExcavatedRegions& regions, const Mesh& mesh) {
  std::vector<int> place(mesh.region_names.size(), none);
  for (const auto& [name, region] : regions) {
    const auto found = std::ranges::find(mesh.region_names, name);
    if (found == mesh.region_names.end()) throw unknown_name(region.origin, "region", name, mesh.region_names);
    require_one_place(region.support, "the support of region '" + name + "'", "it is one part of its stress",
                      region.origin);
    place[found - mesh.region_names.begin()] = static_cast<int>(regions_.size());
    regions_.push_back(&region);
  }
  if (regions_.empty()) return;
  support_.assign(regions_.size(), 1);
  for (const int region : mesh.cell_region) region_of_cell_.push_back(place[region]);
  for (const auto& [name, region] : regions) {
    const int index = static_cast<int>(std::ranges::find(regions_, &region) - regions_.begin());
    if (std::ranges::count(region_of_cell_, index) == mesh.cell_count())
      throw InputError(region.origin, "region '" + name + "' is all of the rock",
                       "nothing would be left when it is taken away", "excavate a part of the rock");
  }
}

void Excavation::evaluate(const StepTime& step) {
  for (std::size_t i = 0; i < regions_.size(); ++i) {
    const double support = value_in_step(regions_[i]->support, {}, step);
    if ((support < 1) != (support_[i] < 1)) ++version_;
    support_[i] = support;
  }
}

std::vector<const Data*> Excavation::data() const {
  std::vector<const Data*> data;
  for (const ExcavatedRegion* region : regions_) data.push_back(&region->support);
  return data;
}

Vector Excavation::of_rock(Vector alpha) const {
  for (int c = 0; c < static_cast<int>(region_of_cell_.size()); ++c)
    if (is_removed(c)) alpha[c] = 0;
  return alpha;
}

std::vector<char> Excavation::left() const {
  std::vector<char> left;
  for (int c = 0; c < static_cast<int>(region_of_cell_.size()); ++c) left.push_back(!is_removed(c));
  return left;
}

}  // namespace sprekk::poromechanics
