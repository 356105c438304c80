#include "components/fine_fracture/boundary_element/boundary_element.hpp"

#include "components/fine_fracture/boundary_element/boundary_model.hpp"
#include "framework/scene/registry.hpp"

namespace sprekk::fine_fracture {

Spec BoundaryElementOptions::spec() {
  Spec spec(
      "fine_fracture/boundary_element",
      "Tips of fractures: stress-intensity factors from a fine level of boundary elements around each, and growth. "
      "The rock in the square around a tip is homogeneous and isotropic.");
  spec.ignore("type");
  declare_size(spec);
  spec.quantity("element_ratio", element_ratio,
                {.range = {.low = 0, .high = 4, .low_allowed = false},
                 .doc = "Longest element at the tip over the edge of the coarse level there. Elements become shorter "
                        "towards kinks and other fractures, and longer away from the tip."});
  spec.integer("degree", degree,
               {.range = between(2, 24),
                .doc = "Of the polynomials for the stress that the rest of the rock makes in the square."});
  spec.quantity("offset_ratio", offset_ratio,
                {.range = {.low = 0, .high = 4, .low_allowed = false},
                 .doc = "Distance of the places along fractures where the pore pressure is taken, over the edge of the "
                        "coarse level.",
                 .source = "Partridge, Brebbia and Wrobel 1992"});
  declare_growth(spec);
  return spec;
}

namespace {

struct KeptPattern : KeptLevel {
  BoundaryPattern pattern;
};

class BoundaryLevels : public FineLevelMaker {
 public:
  explicit BoundaryLevels(const BoundaryElementOptions& options) : options_(options) {}

  MadeFineLevel make(const FineLevelRequest& request) const override {
    BoundaryOptions options;
    options.sizes.largest = options_.element_ratio * request.coarse_size;
    options.degree = options_.degree;
    options.spacing = options_.offset_ratio * request.coarse_size;
    const auto* before = dynamic_cast<const KeptPattern*>(request.kept.get());
    auto level = std::make_unique<BoundaryModel>(request.domain.geometry, options, request.rock.at(request.anchor),
                                                 TipPlace{request.domain.crack, request.domain.is_last},
                                                 request.profile, request.keeps && before ? &before->pattern : nullptr);
    std::shared_ptr<KeptPattern> kept;
    if (request.keeps) {
      kept = std::make_shared<KeptPattern>();
      kept->outline = request.domain.geometry.outline;
      kept->pattern = level->pattern();
    }
    return {.level = std::move(level), .kept = std::move(kept)};
  }
  double room(double coarse_size) const override { return 0.5 * coarse_size; }
  bool takes_jumps() const override { return false; }
  bool needs_one_stiffness() const override { return true; }
  bool has_offsets_on_walls() const override { return true; }
  bool wants_beyond() const override { return true; }

 private:
  BoundaryElementOptions options_;
};

const RegisterComponent<BoundaryElement, BoundaryElementOptions> registration("fine_fracture/boundary_element");

}  // namespace

BoundaryElement::BoundaryElement(const ComponentContext& context, const BoundaryElementOptions& options)
    : Tips(context, options, std::make_unique<BoundaryLevels>(options)) {}

}  // namespace sprekk::fine_fracture
