// The parameters of the flow in fractures.
#pragma once

#include <array>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "components/fracture_flow/laws/law_options.hpp"
#include "framework/assembly/history/history_options.hpp"
#include "framework/config/spec.hpp"
#include "framework/scene/crossings.hpp"

namespace sprekk::fracture_flow {

/// A place on the fractures: the point of a fracture that is nearest to a given one, a whole fracture, or all of them.
struct FracturePlace {
  Origin origin;
  std::string fracture;          ///< "" for all
  std::optional<Point> at;       ///< m
  std::optional<double> radius;  ///< m, of the bore hole at a point of a surface
};

/// A rate of fluid that is injected at a place.
struct Injection {
  FracturePlace where;
  Data rate;  ///< m^2/s (in space m^3/s) in total, spread evenly; at a point shared by the cells around it
};

/// A pressure that is prescribed at a place.
struct PrescribedPressure {
  FracturePlace where;
  Data pressure;  ///< Pa
};

/// The condition where fractures end on a side: a pressure, an outer pressure beyond a resistance, the condition of the
/// rock, or no flow.
struct EndCondition {
  std::optional<Data> pressure;        ///< Pa
  std::optional<Data> outer_pressure;  ///< Pa
  std::optional<Data> conductance;     ///< m/(Pa s), per area of the end
  bool only_out = false;
  bool is_as_rock = false;
  bool is_closed = false;
  std::vector<const Data*> data() const {
    std::vector<const Data*> given;
    for (const std::optional<Data>* one : {&pressure, &outer_pressure, &conductance})
      if (*one) given.push_back(&**one);
    return given;
  }
};

/// Parameters of the flow in fractures.
struct Options {
  HistoryOptions history;
  Data viscosity;              ///< Pa s
  Data fluid_compressibility;  ///< 1/Pa
  Data initial_aperture;       ///< m
  Data initial_pressure;       ///< Pa
  double grown_aperture = 0;   ///< m
  std::string grown_fluid = "drawn";
  double aperture_floor = 1e-7;                ///< m
  std::string transmissivity = "cubic_law";    ///< or "constant", or the text of a formula
  std::optional<Data> transmissivity_formula;  ///< m^3
  std::optional<Data> transmissivity_value;    ///< m^3
  bool has_law = false;                        ///< whether `law` says it, and the two above do not
  LawOptions law;
  std::string normal_permeability = "cubic_law";
  std::optional<Data> normal_permeability_value;  ///< m/(Pa s)
  /// m/(Pa s), by Wall: of a wall that has a normal permeability of its own.
  std::array<std::optional<Data>, 2> wall_permeability;
  std::optional<double> cavitation;    ///< Pa, the least pressure of the fluid
  VectorData gravity;                  ///< m/s^2
  double fluid_density = 1000;         ///< kg/m^3
  std::vector<std::string> fractures;  ///< names of the fractures with a flow; empty: all
  Origin fractures_origin;
  std::map<std::string, Injection> injections;
  std::map<std::string, PrescribedPressure> prescribed;
  std::map<std::string, EndCondition> ends;  ///< by side
  std::map<std::string, Origin> boundary_origins;
  Crossings crossings;
  Spec spec();
  Spec spec(const std::string& type, const std::string& doc);  ///< of another type with these parameters

  /// Whether the transmissivity is given; otherwise it follows from the aperture.
  bool is_constant() const { return has_law ? law.type == "constant" : transmissivity == "constant"; }
  /// Whether fluid may pass ends of fractures on a side.
  bool is_open(const std::string& side) const {
    const auto found = ends.find(side);
    return found != ends.end() && !found->second.is_closed;
  }
  /// Whether the normal permeability of walls is given; otherwise it follows from the aperture.
  bool has_given_walls() const {
    return normal_permeability == "constant" || (wall_permeability[0] && wall_permeability[1]);
  }
  /// The transmissivity as a datum, m^3, where it is not constant and follows no law; else nullptr.
  const Data* conduction_formula() const {
    if (has_law) return law.type == "formula" ? &*law.transmissivity : nullptr;
    return transmissivity_formula ? &*transmissivity_formula : nullptr;
  }
  const std::optional<Data>& given_transmissivity() const {
    static const std::optional<Data> none_given;
    if (conduction_formula()) return none_given;
    return has_law ? law.transmissivity : transmissivity_value;
  }

 private:
  void declare_fluid(Spec& spec);
  void declare_grown(Spec& spec);
  void declare_conduction(Spec& spec);
  void declare_places(Spec& spec);  ///< of injections, prescribed pressures and sides
  void read_transmissivity(const Node& node);
  void check(const Node& node);
};

}  // namespace sprekk::fracture_flow
