// The parameters of the flow in fractures.
#pragma once

#include <array>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "components/fracture_flow/laws/law_options.hpp"
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
  Data rate;  ///< m^2/s in all, spread evenly over the length; at a point shared by the cells around it
};

/// A pressure that is prescribed at a place.
struct PrescribedPressure {
  FracturePlace where;
  Data pressure;  ///< Pa
};

/// What holds where fractures end on a side: a pressure, or nothing flows out there.
struct EndCondition {
  std::optional<Data> pressure;  ///< Pa
  bool is_closed = false;
};

/// Parameters of the flow in fractures.
struct Options {
  Data viscosity;              ///< Pa s
  Data fluid_compressibility;  ///< 1/Pa
  Data initial_aperture;       ///< m
  Data initial_pressure;       ///< Pa
  double grown_aperture = 0;   ///< m
  std::string grown_fluid = "drawn";
  double aperture_floor = 1e-7;  ///< m
  std::string transmissivity = "cubic_law";
  std::optional<Data> transmissivity_value;  ///< m^3
  bool has_law = false;                      ///< whether `law` says it, and the two above do not
  LawOptions law;
  std::string normal_permeability = "cubic_law";
  std::optional<Data> normal_permeability_value;  ///< m/(Pa s)
  /// m/(Pa s), by Wall: of a wall that has a normal permeability of its own.
  std::array<std::optional<Data>, 2> wall_permeability;
  std::optional<double> cavitation;    ///< Pa, the pressure below which the fluid does not fall
  VectorData gravity;                  ///< m/s^2
  double fluid_density = 1000;         ///< kg/m^3
  std::vector<std::string> fractures;  ///< names of the fractures with a flow; empty: all
  Origin fractures_origin;
  std::map<std::string, Injection> injections;
  std::map<std::string, PrescribedPressure> prescribed;
  std::map<std::string, EndCondition> ends;  ///< by side, as the scene says it
  std::map<std::string, Data> boundary;      ///< pressure by side, Pa
  std::map<std::string, Origin> boundary_origins;
  Crossings crossings;
  Spec spec();
  Spec spec(const std::string& type, const std::string& doc);  ///< of another type with these parameters

  /// Whether the transmissivity is given; otherwise it follows from the aperture.
  bool is_constant() const { return has_law ? law.type == "constant" : transmissivity == "constant"; }
  /// Whether walls conduct as a given permeability says; otherwise it follows from the aperture.
  bool has_given_walls() const {
    return normal_permeability == "constant" || (wall_permeability[0] && wall_permeability[1]);
  }
  const std::optional<Data>& given_transmissivity() const {
    return has_law ? law.transmissivity : transmissivity_value;
  }

 private:
  void declare_fluid(Spec& spec);
  void declare_grown(Spec& spec);
  void declare_conduction(Spec& spec);
  void declare_places(Spec& spec);  ///< of injections, prescribed pressures and sides
  void check(const Node& node);
};

}  // namespace sprekk::fracture_flow
