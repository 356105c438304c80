// Stress intensity factors of tips: from a fine level, or an estimate where none is needed.
#include <algorithm>
#include <cmath>
#include <numbers>

#include "components/fine_fracture/quarter_point/elasticity/adapt.hpp"
#include "components/fine_fracture/quarter_point/ends.hpp"
#include "components/fine_fracture/quarter_point/tips.hpp"
#include "framework/mesh/original_end.hpp"
#include "framework/mesh/topology_hash.hpp"

namespace sprekk::fine_fracture {
namespace {

bool is_same(const FineGeometry& a, const FineGeometry& b) {
  return a.outline == b.outline &&
         std::equal(a.cracks.begin(), a.cracks.end(), b.cracks.begin(), b.cracks.end(),
                    [](const CrackPath& x, const CrackPath& y) { return x.points == y.points && x.walls == y.walls; });
}

/// Whether the place is in the square, and the rosette of a tip there as well.
bool has_room(const std::vector<Point>& square, const Point& place, double radius) {
  return (place - square[0]).minCoeff() > radius && (square[2] - place).minCoeff() > radius;
}

std::uint64_t topology_of(const FineMesh& mesh) {
  TopologyHash hash;
  for (const FineMesh::Element& element : mesh.elements)
    for (const int node : element.nodes) hash.add(node);
  return hash.value();
}

}  // namespace

Sifs Tips::evaluate(std::size_t index, const std::vector<TipPath>& paths) {
  Tip& tip = tips_[index];
  // The square of the fine level stays around the tip of the coarse mesh while the path grows in it.
  const Point center = position(tip, {});
  FineMeshOptions mesh;
  mesh.tip_size = options_.mesh_ratio * tip.coarse_size;
  constexpr double edges_across = 10;  // of the domain, away from the fractures; the estimated error refines them
  mesh.far_size = std::max(mesh.tip_size, options_.size / edges_across);
  mesh.sectors = options_.sectors;
  const auto walls = surroundings_->gives_jumps() ? CrackPath::Walls::jump : CrackPath::Walls::traction;
  // Growth with the state held may lead out of the square of an earlier trial.
  if (tip.pattern && !has_room(tip.pattern->outline, position(tip, paths[index]), mesh.tip_size)) tip.pattern.reset();
  FineDomain domain = fine_domain(mesh_, paths_with(paths), tip.end, center, options_.size, tip.coarse_size, walls,
                                  tip.pattern ? &tip.pattern->outline : nullptr);
  const FineRock rock = rock_around(center);
  if (!tip.model || !(tip.model->rock() == rock) || !is_same(domain.geometry, tip.domain.geometry)) {
    tip.kept_factors.reset();
    tip.offsets = nullptr;
    tip.domain = std::move(domain);
    if (options_.tolerance) {
      Adapted adapted =
          adapt(tip.domain.geometry, mesh, rock, loads_of(tip), {.tolerance = *options_.tolerance}, profile_);
      tip.model.emplace(std::move(adapted.model));
      meshes_ += adapted.meshes;
      solves_ += adapted.meshes;
      return keep_factors(tip, adapted.solution);
    }
    const bool keeps_pattern = is_followed(tip);
    TriangulationKeeper keeper{original_end(mesh_, tip.end.fracture, tip.end.at_end),
                               keeps_pattern ? tip.pattern : nullptr};
    tip.model.emplace(tip.domain.geometry, mesh, rock, TipPlace{tip.domain.crack, tip.domain.is_last}, profile_,
                      grows_within_steps_ ? &keeper : nullptr);
    tip.has_pattern = keeps_pattern;
    tip.topology = topology_of(tip.model->mesh());
    if (keeps_pattern) tip.pattern = keeper.kept;
    ++meshes_;
  } else {
    tip.domain = std::move(domain);
  }
  // The kept factors are still valid if only paths outside of its domain have changed, or at the first evaluation of a
  // search.
  if (tip.kept_factors && tip.kept_factors->version == surroundings_->version()) {
    ++kept_;
    tip.now.sif_error = tip.kept_factors->error;
    return tip.kept_factors->sifs;
  }
  ++solves_;
  FineLoads loads = loads_of(tip);
  if (!tip.offsets) tip.offsets = surroundings_->stress_offsets(tip.model->offset_places());
  loads.stress_offset = [&tip](const std::vector<Point>&) { return tip.offsets(); };
  return keep_factors(tip, tip.model->solve(loads));
}

FineRock Tips::rock_around(const Point& center) const {
  const auto at = [this](const Point& x) {
    const LameParameters lame = surroundings_->stiffness(x);
    return Elasticity{lame.lambda, lame.shear};
  };
  const std::uint64_t version = surroundings_->stiffness_by_place();
  return version == 0 ? FineRock(at(center)) : FineRock(at, version);
}

Sifs Tips::keep_factors(Tip& tip, const FineSolution& solution) const {
  const Sifs sifs = factors_of(tip, solution);
  tip.kept_factors = {surroundings_->version(), sifs, tip.now.sif_error};
  return sifs;
}

Sifs Tips::factors_of(Tip& tip, const FineSolution& solution) const {
  for (const TipIntensities& found : solution.tips) {
    if (found.crack != tip.domain.crack || found.is_last != tip.domain.is_last) continue;
    tip.now.sif_error = found.error.norm();
    const Point k = options_.factors == "interaction_integral" ? found.K : found.K_correlation;
    return {k[0], k[1], found.T};
  }
  throw std::logic_error("the fine level has lost its tip");
}

double Tips::toughness(const TipEnd& end, const Point& x) const {
  const Data& data = *options_.toughness;
  return data.at({x, data.is_constant() ? 0 : surroundings_->region(x), 0, end.fracture});
}

double Tips::estimated_load(const Tip& tip) const {
  // Williams' field: the jump at a distance r behind the tip is (8/E') sqrt(r/(2 pi)) K.
  const LameParameters lame = surroundings_->stiffness(position(tip, {}));
  const double distance = 0.5 * end_cell(mesh_, tip.end).measure;
  const double estimate = Elasticity{lame.lambda, lame.shear}.plane_modulus() / 8 *
                          std::sqrt(2 * std::numbers::pi / distance) *
                          surroundings_->jump_at_tip(tip.end.fracture, tip.end.at_end);
  constexpr double shear_to_equivalent = 1.25;
  return shear_to_equivalent * estimate / toughness(tip);
}

void Tips::set_factors(Tip& tip, const Sifs& sifs) const {
  tip.now.sifs = sifs;
  tip.now.load = options_.toughness ? equivalent_sif(sifs) / toughness(tip) : 0;
  tip.now.is_evaluated = true;
}

}  // namespace sprekk::fine_fracture
