#include "components/poromechanics/options.hpp"

#include "components/capabilities/usual_ranges.hpp"
#include "components/poromechanics/stiffness.hpp"
#include "framework/config/unknown_key.hpp"

#include <algorithm>

namespace sprekk::poromechanics {

ConditionAxes SideCondition::axes() const {
  const bool is_of_face =
      std::ranges::any_of(displacement_of_face, [](const auto& given) { return given.has_value(); });
  return is_of_face ? ConditionAxes::of_face : ConditionAxes::of_space;
}

const Data* SideCondition::displacement_of(int direction) const {
  if (displacement) return &displacement->component[direction];
  const auto& given = axes() == ConditionAxes::of_face ? displacement_of_face : displacement_along;
  return given[direction] ? &*given[direction] : nullptr;
}

Point SideCondition::traction_in(const StepTime& step, const Place& place, const Point& normal) const {
  Point total = Point::Zero();
  if (traction) total += value_in_step(*traction, place, step);
  for (int k = 0; k < dimension; ++k)
    if (traction_along[k]) total[k] += value_in_step(*traction_along[k], place, step);
  if (normal_stress) total += value_in_step(*normal_stress, place, step) * normal;
  if (shear_stress) total += value_in_step(*shear_stress, place, step) * axes_of(ConditionAxes::of_face, normal).col(1);
  return total;
}

Tensor SideCondition::spring_at(const Place& place, const Point& normal) const {
  const Tensor along = normal * normal.transpose();
  Tensor resists = Tensor::Zero();
  if (spring_normal) resists += spring_normal->at(place) * along;
  if (spring_tangential) resists += spring_tangential->at(place) * (Tensor::Identity() - along);
  return resists;
}

bool SideCondition::depends_on_time() const {
  const std::vector<const Data*> given = data();
  return std::any_of(given.begin(), given.end(), [](const Data* one) { return one->depends_on_time(); });
}

std::vector<const Data*> SideCondition::data() const {
  std::vector<const Data*> given;
  const auto add = [&](const std::optional<Data>& data) {
    if (data) given.push_back(&*data);
  };
  add(normal_stress);
  add(shear_stress);
  for (int k = 0; k < dimension; ++k) {
    add(displacement_along[k]);
    add(displacement_of_face[k]);
    add(traction_along[k]);
    if (displacement) given.push_back(&displacement->component[k]);
    if (traction) given.push_back(&traction->component[k]);
  }
  return given;
}

std::vector<const Data*> Options::loads() const {
  std::vector<const Data*> data;
  for (const VectorData* vector : {&body_force, &gravity})
    for (const Data& component : vector->component) data.push_back(&component);
  data.push_back(&rock_density);
  for (const auto& [side, condition] : boundary)
    for (const Data* given : condition.data()) data.push_back(given);
  for (const auto& [name, point] : pinned)
    for (const std::optional<Data>& given : point.displacement_along)
      if (given) data.push_back(&*given);
  for (const auto& [name, region] : excavation) data.push_back(&region.support);
  return data;
}

bool Options::has_body_force() const { return !body_force.is_zero() || !(rock_density.is_zero() || gravity.is_zero()); }

Point Options::body_force_in(const StepTime& step, const Place& place) const {
  return value_in_step(body_force, place, step) +
         value_in_step(rock_density, place, step) * value_in_step(gravity, place, step);
}

bool Options::loads_depend_on_time() const {
  const std::vector<const Data*> data = loads();
  return std::any_of(data.begin(), data.end(), [](const Data* one) { return one->depends_on_time(); });
}

SymmetricTensor Options::initial_stress_at(const Place& place) const {
  if (initial_stress.is_zero()) return SymmetricTensor::Zero();
  return components_of(initial_stress.at(place));
}

namespace {

constexpr bool in_plane = dimension == 2;
constexpr const char* axes_in_words = in_plane ? "x and y" : "x, y and z";

void refuse_both(const Node& node, const std::string& one, const std::string& other) {
  if (node.find(one) && node.find(other))
    throw InputError(node.origin, "contradictory boundary condition at '" + node.path + "'",
                     "both '" + one + "' and '" + other + "' are given for one direction", "remove one of them");
}

/// NAME, NAME_x, NAME_y, … of a vector and its components.
std::vector<std::string> vector_names(const std::string& name) {
  std::vector<std::string> names{name};
  for (const char* axis : axis_names) names.push_back(name + "_" + axis);
  return names;
}

/// Conditions along the coordinates beside displacements along the normal and the tangent.
void refuse_two_frames(const Node& node) {
  std::vector<std::string> of_coordinates = vector_names("displacement");
  for (const std::string& name : vector_names("traction")) of_coordinates.push_back(name);
  for (const char* of_face : {"displacement_normal", "displacement_tangential"})
    for (const std::string& of_space : of_coordinates)
      if (node.find(of_face) && node.find(of_space))
        throw InputError(node.origin, "contradictory boundary condition at '" + node.path + "'",
                         std::string("'") + of_face + "' is along the normal " + (in_plane ? "or the tangent " : "") +
                             "of the side, and '" + of_space + "' along " + axes_in_words,
                         std::string("use one frame: ") +
                             (in_plane ? "'displacement_normal', 'displacement_tangential', 'normal_stress' and "
                                         "'shear_stress'"
                                       : "'displacement_normal' and 'normal_stress'") +
                             ", or conditions in " + axes_in_words);
}

/// A displacement that is given beside a spring in its direction.
void refuse_held_springs(const Node& node) {
  for (const char* spring : {"spring_normal", "spring_tangential"}) {
    std::vector<std::string> holds = vector_names("displacement");
    holds.push_back(std::string(spring) == "spring_normal" ? "displacement_normal" : "displacement_tangential");
    for (const std::string& held : holds)
      if (node.find(spring) && node.find(held))
        throw InputError(node.find(spring)->origin,
                         "'" + std::string(spring) + "' contradicts '" + held + "' at '" + node.path + "'",
                         "a side on springs moves as its load asks for, and is not held", "remove one of them");
  }
}

void declare_springs(Spec& spec, SideCondition& side) {
  constexpr const char* fixed = "a bed that changes would load the rock by what it has held so far";
  spec.data("spring_normal", side.spring_normal,
            {.unit = "Pa/m",
             .range = non_negative(),
             .doc = "Stiffness of a bed that the side rests on, per area: its traction against a displacement along "
                    "the normal, beside other tractions.",
             .source = "Winkler (1867)",
             .fixed = fixed});
  spec.data("spring_tangential", side.spring_tangential,
            {.unit = "Pa/m",
             .range = non_negative(),
             .doc = "The same against a displacement along the side.",
             .source = "Winkler (1867)",
             .fixed = fixed});
}

Spec side_spec(SideCondition& side) {
  write_instead(
      "boundary condition of mechanics", "pressure",
      "write 'normal_stress: -1 MPa' for a load of 1 MPa (compression is negative); the pressure of a fluid is "
      "a condition of its flow");
  if constexpr (!in_plane) {
    write_instead("boundary condition of mechanics", "displacement_tangential",
                  "a side in space has two tangents: write 'displacement_x', 'displacement_y' and 'displacement_z', or "
                  "'displacement: [0, 0, 0]' to hold it");
    write_instead("boundary condition of mechanics", "shear_stress",
                  "a side in space has two tangents: write 'traction: [x, y, z]'");
  }
  Spec spec("boundary condition of mechanics",
            "Per direction a displacement or a total traction; a direction without either is free of traction. Springs "
            "add to tractions.");
  spec.vector("displacement", side.displacement,
              {.unit = "m",
               .doc = in_plane ? "Displacement in both directions." : "Displacement in all directions.",
               .in_time = true});
  for (int k = 0; k < dimension; ++k)
    spec.data(
        std::string("displacement_") + axis_names[k], side.displacement_along[k],
        {.unit = "m", .doc = std::string("Displacement in ") + axis_names[k] + "; 0 is a roller.", .in_time = true});
  spec.data("displacement_normal", side.displacement_of_face[0],
            {.unit = "m",
             .doc = "Displacement along the outward normal of a side of any direction; 0 is a roller.",
             .in_time = true});
  if constexpr (in_plane)
    spec.data(
        "displacement_tangential", side.displacement_of_face[1],
        {.unit = "m", .doc = "Displacement along the side, positive with the rock on the left.", .in_time = true});
  spec.vector("traction", side.traction,
              {.unit = "Pa", .doc = "Total traction sigma·n, n out of the rock.", .in_time = true});
  for (int k = 0; k < dimension; ++k)
    spec.data(std::string("traction_") + axis_names[k], side.traction_along[k],
              {.unit = "Pa", .doc = std::string("Total traction in ") + axis_names[k] + ".", .in_time = true});
  spec.data("normal_stress", side.normal_stress,
            {.unit = "Pa",
             .doc = "Total traction along the outward normal; tension is positive, a load is negative.",
             .in_time = true});
  if constexpr (in_plane)
    spec.data(
        "shear_stress", side.shear_stress,
        {.unit = "Pa", .doc = "Total traction along the side, positive with the rock on the left.", .in_time = true});
  declare_springs(spec, side);
  spec.check([](const Node& node) {
    refuse_held_springs(node);
    const std::vector<std::string> displacements = vector_names("displacement"), tractions = vector_names("traction");
    for (int k = 1; k <= dimension; ++k) refuse_both(node, displacements[0], displacements[k]);
    for (const std::string& traction : tractions) refuse_both(node, displacements[0], traction);
    refuse_both(node, displacements[0], "normal_stress");
    refuse_both(node, displacements[0], "shear_stress");
    refuse_two_frames(node);
    refuse_both(node, "displacement_normal", "normal_stress");
    refuse_both(node, "displacement_tangential", "shear_stress");
    for (int k = 1; k <= dimension; ++k) refuse_both(node, displacements[k], tractions[k]);
    for (int k = 1; k <= dimension; ++k) refuse_both(node, tractions[0], tractions[k]);
  });
  return spec;
}

}  // namespace

void Options::declare_stiffness(Spec& spec) {
  spec.data("young_modulus", young_modulus,
            {.unit = "Pa",
             .range = positive(),
             .doc = "Young's modulus of the drained rock.",
             .source = "the paper's Table 1",
             .material = true,
             .in_time = true});
  usually(spec, "young_modulus", usual_young_modulus());
  spec.data("poisson_ratio", poisson_ratio,
            {.range = strictly_between(-1, 0.5),
             .doc = "Poisson's ratio of the drained rock.",
             .source = "the paper's Table 1",
             .material = true,
             .in_time = true});
  usually(spec, "poisson_ratio", usual_poisson_ratio());
  Spec tensor("stiffness", std::string(in_plane ? "Plane-strain stiffness" : "Stiffness") +
                               " of an anisotropic rock, instead of the two moduli.");
  const auto entry = [&](int row, int column) {
    const std::string name = symmetric_name(row) + symmetric_name(column);
    tensor.data(name, stiffness.entry[AnisotropicStiffness::number_of(row, column)],
                {.unit = "Pa",
                 .doc = "Entry " + name + " of the stiffness.",
                 .required = row == column || column < dimension,
                 .in_time = true});
  };
  for (int k = 0; k < symmetric_components; ++k) entry(k, k);
  for (int row = 0; row < symmetric_components; ++row)
    for (int column = row + 1; column < symmetric_components; ++column) entry(row, column);
  spec.section("stiffness", tensor, {.doc = "Of an anisotropic rock."}, &is_anisotropic);
  spec.data("bulk_modulus", bulk_modulus,
            {.unit = "Pa",
             .range = positive(),
             .doc = "Drained bulk modulus of an anisotropic rock, where a coupler asks for it.",
             .in_time = true});
  usually(spec, "bulk_modulus", usual_young_modulus());
}

Spec Options::spec(const std::string& type, const std::string& doc) {
  for (const char* key : {"pressure", "initial_pressure"})
    write_instead(
        type, key,
        "give it to a component of a flow (matrix_flow/mpfa), and couple that with the rock by 'biot'; a load "
        "is the 'normal_stress' of a side");
  Spec spec(type, doc);
  spec.ignore("type");
  declare_stiffness(spec);
  spec.data("rock_density", rock_density,
            {.unit = "kg/m^3",
             .range = non_negative(),
             .doc = "Density of the saturated rock; matters with gravity only.",
             .material = true,
             .in_time = true});
  usually(spec, "rock_density", usual_rock_density());
  spec.vector("gravity", gravity,
              {.unit = "m/s^2",
               .doc = "Acceleration of gravity.",
               .material = true,
               .fixed = "a weight that changes is a change of rock_density"});
  spec.vector("body_force", body_force,
              {.unit = "N/m^3",
               .doc = "Force per volume, besides gravity.",
               .source = "-b of the paper's Eq. 5",
               .in_time = true});
  spec.tensor(
      "initial_stress", initial_stress,
      {.unit = "Pa",
       .doc =
           "Total stress at the initial pressure; tension positive. Where it is not in equilibrium, it loads the rock.",
       .fixed = "displacements are counted from the state in which it holds"});
  spec.quantity("large_strain", large_strain,
                {.range = positive(),
                 .doc = "A note tells of strains above this: the model is linear, and keeps the shape of the rock."});
  static SideCondition example;
  spec.named_sections("boundary", side_spec(example),
                      [this](const std::string& key, const Origin& origin) {
                        boundary[key].origin = origin;
                        return side_spec(boundary[key]);
                      },
                      {.doc = std::string("Conditions by the name of the side (left, right, ") +
                              (in_plane ? "" : "front, back, ") + "bottom, top, or of the imported mesh)."});
  add_pinned_points(spec, pinned);
  add_excavation(spec, excavation);
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
