#include "components/poromechanics/options.hpp"

namespace sprekk::poromechanics {

const Data* SideCondition::displacement_of(int direction) const {
  if (displacement) return &displacement->component[direction];
  return displacement_along[direction] ? &*displacement_along[direction] : nullptr;
}

Point SideCondition::traction_in(const StepTime& step, const Place& place, const Point& normal) const {
  Point total = Point::Zero();
  if (traction) total += value_in_step(*traction, place, step);
  for (int k = 0; k < 2; ++k)
    if (traction_along[k]) total[k] += value_in_step(*traction_along[k], place, step);
  if (normal_stress) total += value_in_step(*normal_stress, place, step) * normal;
  return total;
}

bool SideCondition::depends_on_time() const {
  bool depends = (displacement && displacement->depends_on_time()) || (traction && traction->depends_on_time()) ||
                 (normal_stress && normal_stress->depends_on_time());
  for (int k = 0; k < 2; ++k)
    depends = depends || (displacement_along[k] && displacement_along[k]->depends_on_time()) ||
              (traction_along[k] && traction_along[k]->depends_on_time());
  return depends;
}

namespace {

void refuse_both(const Node& node, const char* one, const char* other) {
  if (node.find(one) && node.find(other))
    throw InputError(node.origin, "contradictory boundary condition at '" + node.path + "'",
                     std::string("both '") + one + "' and '" + other + "' are given for one direction",
                     "remove one of them");
}

Spec side_spec(SideCondition& side) {
  Spec spec("boundary condition of mechanics",
            "Per direction a displacement or a total traction; a direction without either is free of traction.");
  spec.vector("displacement", side.displacement,
              {.unit = "m", .doc = "Displacement in both directions.", .in_time = true});
  spec.data("displacement_x", side.displacement_along[0],
            {.unit = "m", .doc = "Displacement in x; 0 is a roller.", .in_time = true});
  spec.data("displacement_y", side.displacement_along[1],
            {.unit = "m", .doc = "Displacement in y; 0 is a roller.", .in_time = true});
  spec.vector("traction", side.traction,
              {.unit = "Pa", .doc = "Total traction sigma·n, n out of the rock.", .in_time = true});
  spec.data("traction_x", side.traction_along[0], {.unit = "Pa", .doc = "Total traction in x.", .in_time = true});
  spec.data("traction_y", side.traction_along[1], {.unit = "Pa", .doc = "Total traction in y.", .in_time = true});
  spec.data("normal_stress", side.normal_stress,
            {.unit = "Pa",
             .doc = "Total traction along the outward normal; tension is positive, a load is negative.",
             .in_time = true});
  spec.check([](const Node& node) {
    refuse_both(node, "displacement", "displacement_x");
    refuse_both(node, "displacement", "displacement_y");
    refuse_both(node, "displacement", "traction");
    refuse_both(node, "displacement", "traction_x");
    refuse_both(node, "displacement", "traction_y");
    refuse_both(node, "displacement", "normal_stress");
    refuse_both(node, "displacement_x", "traction_x");
    refuse_both(node, "displacement_y", "traction_y");
    refuse_both(node, "traction", "traction_x");
    refuse_both(node, "traction", "traction_y");
  });
  return spec;
}

}  // namespace

Spec Options::spec(const std::string& type, const std::string& doc) {
  Spec spec(type, doc);
  spec.ignore("type");
  spec.data("young_modulus", young_modulus,
            {.unit = "Pa",
             .range = positive(),
             .doc = "Young's modulus of the drained rock.",
             .source = "Table 1",
             .material = true,
             .in_time = true});
  spec.data("poisson_ratio", poisson_ratio,
            {.range = strictly_between(-1, 0.5),
             .doc = "Poisson's ratio of the drained rock.",
             .source = "Table 1",
             .material = true,
             .in_time = true});
  Spec tensor("stiffness", "Plane-strain stiffness of an anisotropic rock, instead of the two moduli.");
  const auto entry = [&](const char* name, Data& target, bool required) {
    tensor.data(name, target,
                {.unit = "Pa",
                 .doc = std::string("Entry ") + name + " of the stiffness.",
                 .required = required,
                 .in_time = true});
  };
  entry("xxxx", stiffness.xxxx, true);
  entry("yyyy", stiffness.yyyy, true);
  entry("xyxy", stiffness.xyxy, true);
  entry("xxyy", stiffness.xxyy, true);
  entry("xxxy", stiffness.xxxy, false);
  entry("yyxy", stiffness.yyxy, false);
  spec.section("stiffness", tensor, {.doc = "Of an anisotropic rock."}, &is_anisotropic);
  spec.data("bulk_modulus", bulk_modulus,
            {.unit = "Pa",
             .range = positive(),
             .doc = "Drained bulk modulus of an anisotropic rock, where a coupler asks for it.",
             .in_time = true});
  spec.data("rock_density", rock_density,
            {.unit = "kg/m^3",
             .range = non_negative(),
             .doc = "Density of the saturated rock; matters with gravity only.",
             .material = true,
             .in_time = true});
  spec.vector("gravity", gravity,
              {.unit = "m/s^2",
               .doc = "Acceleration of gravity.",
               .material = true,
               .fixed = "a weight that changes is a change of rock_density"});
  spec.vector("body_force", body_force,
              {.unit = "N/m^3", .doc = "Force per volume, besides gravity.", .source = "-b of Eq. 5", .in_time = true});
  spec.tensor(
      "initial_stress", initial_stress,
      {.unit = "Pa",
       .doc = "Total stress at the initial pressure; tension positive. Where it is not at rest it loads the rock.",
       .fixed = "displacements are counted from the state in which it holds"});
  spec.quantity("large_strain", large_strain,
                {.range = positive(),
                 .doc = "Strain from where on a note says that it is large: the rock is taken to be linear, and its "
                        "shape to stay."});
  static SideCondition example;
  spec.named_sections(
      "boundary", side_spec(example),
      [this](const std::string& key, const Origin& origin) {
        boundary[key].origin = origin;
        return side_spec(boundary[key]);
      },
      {.doc = "Conditions by the name of the side (left, right, bottom, top, or of the imported mesh)."});
  spec.check([this](const Node& node) {
    if (!is_anisotropic && (!young_modulus || !poisson_ratio))
      throw InputError(node.origin, "the stiffness of '" + node.path + "' is not determined",
                       "it is 'young_modulus' and 'poisson_ratio', or 'stiffness'",
                       "give these in the component or in 'materials:'");
    if (is_anisotropic && node.find("young_modulus"))
      throw InputError(node.origin, "the stiffness of '" + node.path + "' is given twice",
                       "by 'young_modulus' and by 'stiffness'", "remove one of them");
  });
  return spec;
}

}  // namespace sprekk::poromechanics
