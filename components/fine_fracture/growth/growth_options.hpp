// The parameters of the growth of tips.
#pragma once

#include <optional>
#include <string>

#include "framework/config/spec.hpp"

namespace sprekk::fine_fracture {

/// The section `growth:` of a scene. growth_options.cpp explains the choices for direction and length.
struct GrowthOptions {
  std::string direction = "implicit";  ///< implicit, explicit, largest_release
  std::string length = "arrest";       ///< arrest, fixed
  double increment = 0;                ///< l_max of Eq. 13 of the paper, m
  double energy_exponent = 0.35;       ///< of Eq. 13 of the paper
  double relaxation = 1;               ///< part of the explicit angle that is taken
  double direction_tolerance = 1e-2;   ///< |K_II|/K_I at the end of an increment
  double arrest_tolerance = 1e-2;      ///< |K_eq/K_IC − 1| where growth ends
  double front_tolerance = 1e-7;       ///< |ln(K_eq/K_IC)| of a tip that grows within a step
  bool has_front_tolerance = false;    ///< whether the scene gives it
  double largest_turn = 1.4;           ///< rad
  /// Shortest increment over `increment`: K_eq of a kink falls with the root of its length, by 1 % in its first
  /// thousandth.
  double smallest = 1e-4;
  std::optional<double> longest;  ///< m, added by a tip in one call
  int at_most = 50;               ///< increments of a tip in one call
  int tries = 8;                  ///< evaluations of an increment before a looser result is accepted

  bool is_implicit() const { return direction == "implicit"; }
  bool releases_most() const { return direction == "largest_release"; }
  bool seeks_arrest() const { return length == "arrest"; }
  double smallest_length() const { return smallest * increment; }  ///< m
  /// Growth within steps: kinks that the mesh does not follow yet are followed from length zero.
  void follow_kinks();
  Spec spec();
};

}  // namespace sprekk::fine_fracture
