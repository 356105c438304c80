// The values that rocks, fractures and fluids have as a rule, for the specs of all parts. Outside of them a scene gets
// a note. They are wide: what has been published for some rock or fluid is inside.
#pragma once

#include "framework/config/usual_range.hpp"

namespace sprekk {

// clang-format off
inline UsualRange usual_young_modulus() { return {1e5, 2e11, "Bowles 1996 for soils; Jaeger et al. 2007 for rocks"}; }  ///< Pa
inline UsualRange usual_poisson_ratio() { return {0, 0.4999, "Gercek 2007"}; }
inline UsualRange usual_rock_density() { return {800, 5000, "Schön 2015"}; }  ///< kg/m^3
inline UsualRange usual_permeability() { return {1e-25, 1e-7, "Freeze and Cherry 1979; Neuzil 1994"}; }  ///< m^2
inline UsualRange usual_porosity() { return {1e-5, 0.95, "Freeze and Cherry 1979"}; }
inline UsualRange usual_storage() { return {1e-13, 1e-5, "Domenico and Schwartz 1998; gas at 0.1 MPa"}; }  ///< 1/Pa
inline UsualRange usual_viscosity() { return {5e-6, 0.5, "NIST WebBook for gases; Economides and Nolte 2000 for gels"}; }  ///< Pa s
inline UsualRange usual_compressibility() { return {1e-11, 2e-5, "Batzle and Wang 1992; 1/p of an ideal gas"}; }  ///< 1/Pa
inline UsualRange usual_fluid_density() { return {0.05, 2500, "Batzle and Wang 1992; NIST WebBook for gases"}; }  ///< kg/m^3
inline UsualRange usual_fluid_expansion() { return {1e-6, 1e-2, "Kell 1975; 1/T of an ideal gas"}; }  ///< 1/K
inline UsualRange usual_friction() { return {0.03, 3, "Byerlee 1978; Barton and Choubey 1977"}; }
inline UsualRange usual_dilation_angle() { return {0, 0.8, "Barton and Choubey 1977"}; }  ///< rad
inline UsualRange usual_strength() { return {100, 5e8, "Jaeger et al. 2007"}; }  ///< Pa, cohesion and tensile strength
inline UsualRange usual_aperture() { return {1e-8, 0.1, "Snow 1970; Zimmerman and Bodvarsson 1996"}; }  ///< m
inline UsualRange usual_zone_width() { return {1e-8, 20, "Snow 1970; zones of fractures: Hydrocoin 1988, level 1, case 2"}; }  ///< m
inline UsualRange usual_transmissivity() { return {1e-25, 1e-4, "Snow 1970, by the cubic law"}; }  ///< m^3
inline UsualRange usual_joint_stiffness() { return {1e7, 1e15, "Bandis et al. 1983"}; }  ///< Pa/m
inline UsualRange usual_toughness() { return {1e3, 2e8, "Atkinson and Meredith 1987; Rivalta et al. 2015"}; }  ///< Pa m^0.5
inline UsualRange usual_conductivity() { return {0.01, 30, "Clauser and Huenges 1995"}; }  ///< W/(m K), rock and fluid
inline UsualRange usual_heat_capacity() { return {2e5, 8e6, "Waples and Waples 2004"}; }  ///< J/(m^3 K), of rock
inline UsualRange usual_fluid_heat_capacity() { return {500, 8e6, "NIST WebBook"}; }  ///< J/(m^3 K)
inline UsualRange usual_expansion() { return {1e-8, 2e-4, "Skinner 1966"}; }  ///< 1/K, of rock
// clang-format on

}  // namespace sprekk
