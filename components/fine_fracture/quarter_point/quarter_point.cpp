// Fine levels of quarter-point elements, and the tips that have them.
#include "components/fine_fracture/quarter_point/quarter_point.hpp"

#include <algorithm>
#include <stdexcept>

#include "components/fine_fracture/quarter_point/elasticity/adapt.hpp"
#include "framework/mesh/topology_hash.hpp"
#include "framework/scene/registry.hpp"

namespace sprekk::fine_fracture {

Spec QuarterPointOptions::spec() {
  Spec spec("fine_fracture/quarter_point",
            "Tips of fractures: stress-intensity factors from a fine level around each, and growth (the paper's secs. "
            "2.5, 4.3).");
  spec.ignore("type");
  declare_size(spec);
  spec.quantity("mesh_ratio", mesh_ratio,
                {.range = {.low = 0, .high = 1, .low_allowed = false},
                 .doc = "Edge length at the tip over that of the coarse level.",
                 .source = "epsilon_m of the paper's sec. 4.1"});
  spec.integer("sectors", sectors, {.range = between(8, 64), .doc = "Quarter-point elements around a tip."});
  spec.quantity(
      "tolerance", tolerance,
      {.range = strictly_between(0, 1),
       .doc = "Meshes of the fine level are refined until the estimated error of the stress is below this part "
              "of it (energy norm, Zienkiewicz and Zhu 1992); without it sizes are what is given.",
       .source = "the paper's sec. 4.1"});
  spec.choice("factors", factors,
              {{"interaction_integral", "over a domain around the tip, with the tractions of the walls"},
               {"displacement_correlation", "from the nodes of the quarter-point elements (the paper)"}},
              {.doc = "How stress-intensity factors follow from the displacement.", .source = "the paper's sec. 4.3"});
  declare_growth(spec);
  return spec;
}

namespace {

/// A triangulation whose nodes move from trial to trial, with the same topology.
struct KeptTriangulation : KeptLevel {
  std::shared_ptr<const Triangulated> triangulated;
  std::shared_ptr<const EliminationOrder> order;
};

std::shared_ptr<const KeptLevel> kept(const std::shared_ptr<const Triangulated>& triangulated,
                                      const std::shared_ptr<const EliminationOrder>& order) {
  if (!triangulated) return nullptr;
  auto kept = std::make_shared<KeptTriangulation>();
  kept->outline = triangulated->outline;
  kept->triangulated = triangulated;
  kept->order = order;
  return kept;
}

class QuarterPointLevel : public FineLevel {
 public:
  QuarterPointLevel(FineModel model, const TipPlace& tip, bool integrates)
      : model_(std::move(model)), tip_(tip), integrates_(integrates) {}

  FineRock rock() const override { return model_.rock(); }
  std::uint64_t topology() const override {
    TopologyHash hash;
    for (const FineMesh::Element& element : model_.mesh().elements)
      for (const int node : element.nodes) hash.add(node);
    return hash.value();
  }
  const std::vector<Point>& offset_places() const override { return model_.offset_places(); }
  TipFactors solve(const FineLoads& loads) const override { return factors_in(model_.solve(loads)); }

  TipFactors factors_in(const FineSolution& solution) const {
    for (const TipIntensities& found : solution.tips) {
      if (found.crack != tip_.crack || found.is_last != tip_.is_last) continue;
      const Point k = integrates_ ? found.K : found.K_correlation;
      return {{k[0], k[1], found.T}, found.error.norm()};
    }
    throw std::logic_error("the fine level has lost its tip");
  }

 private:
  FineModel model_;
  TipPlace tip_;
  bool integrates_;
};

class QuarterPointLevels : public FineLevelMaker {
 public:
  explicit QuarterPointLevels(const QuarterPointOptions& options) : options_(options) {}

  MadeFineLevel make(const FineLevelRequest& request) const override {
    FineMeshOptions mesh;
    mesh.tip_size = room(request.coarse_size);
    constexpr double edges_across = 10;  // of the domain, away from the fractures; the estimated error refines them
    mesh.far_size = std::max(mesh.tip_size, request.size / edges_across);
    mesh.sectors = options_.sectors;
    const TipPlace tip{request.domain.crack, request.domain.is_last};
    const bool integrates = options_.factors == "interaction_integral";
    if (options_.tolerance) {
      Adapted adapted = adapt(request.domain.geometry, mesh, request.rock, request.loads,
                              {.tolerance = *options_.tolerance}, request.profile);
      auto level = std::make_unique<QuarterPointLevel>(std::move(adapted.model), tip, integrates);
      const TipFactors factors = level->factors_in(adapted.solution);
      return {.level = std::move(level), .kept = nullptr, .meshes = adapted.meshes, .factors = factors};
    }
    const auto* before = dynamic_cast<const KeptTriangulation*>(request.kept.get());
    TriangulationKeeper keeper{request.anchor, request.keeps && before ? before->triangulated : nullptr};
    FineModel model(request.domain.geometry, mesh, request.rock, tip, request.profile, &keeper,
                    before ? before->order : nullptr);
    auto kept_level = request.keeps ? kept(keeper.kept, model.elimination_order()) : nullptr;
    return {.level = std::make_unique<QuarterPointLevel>(std::move(model), tip, integrates),
            .kept = std::move(kept_level)};
  }
  double room(double coarse_size) const override { return options_.mesh_ratio * coarse_size; }
  /// With a tolerance, meshes follow an error estimate, and factors are no smooth functions of the advance.
  bool is_steady() const override { return !options_.tolerance; }

 private:
  QuarterPointOptions options_;
};

const RegisterComponent<QuarterPoint, QuarterPointOptions> registration("fine_fracture/quarter_point");

}  // namespace

QuarterPoint::QuarterPoint(const ComponentContext& context, const QuarterPointOptions& options)
    : Tips(context, options, std::make_unique<QuarterPointLevels>(options)) {}

}  // namespace sprekk::fine_fracture
