// A square cut by an inclined fracture, whose solution is a uniform strain and a rigid jump.
#pragma once

#include <fmt/format.h>

#include <cmath>
#include <string>

#include "framework/types.hpp"

namespace sprekk::testing {

inline Tensor uniform_strain() {
  Tensor strain;
  strain << -0.02, 0.001, 0.001, -0.01;
  return strain;
}

/// Of the stress s t⊗t, with t along the fracture: eps = (sigma - nu tr(sigma) I)/(2 G) in plane strain, G = 1, nu =
/// 1/4.
inline Tensor traction_free_strain() {
  const Point t(std::sqrt(3) / 2, 0.5);
  const Tensor stress = -0.02 * t * t.transpose();
  return 0.5 * (stress - 0.25 * stress.trace() * Tensor::Identity());
}

/// A square cut by a straight fracture at some angle, whose sides follow a uniform strain on the minus side of the
/// fracture, and the same with a rigid jump on the plus side's opposite. In units with lambda = G = 1.
///
/// `laws`: further parameters of the contact, each after a comma.
inline std::string patch_scene(const std::string& normal_jump, const std::string& tangential_jump, double friction,
                               const std::string& dilation, const Tensor& strain = uniform_strain(),
                               const std::string& shape = "triangles", const std::string& laws = "",
                               const std::string& type = "coulomb") {
  // The fracture runs through (0.5, 0.5) along t = (cos 30, sin 30); n = (sin 30, -cos 30); minus side where n·x > 0.5
  // n·(1,1).
  const std::string side = "(0.5*(x-0.5) - 0.8660254037844386*(y-0.5) > 0)";
  const auto displacement = [&](int k, const char* n, const char* t) {
    return fmt::format("\"({:.17g})*x + ({:.17g})*y + if({}, {}*({}) + {}*({}), 0)\"", strain(k, 0), strain(k, 1), side,
                       n, normal_jump, t, tangential_jump);
  };
  const std::string u = "{displacement: [" + displacement(0, "0.5", "0.8660254037844386") + ", " +
                        displacement(1, "(-0.8660254037844386)", "0.5") + "]}";
  return "{geometry: {box: {x: [0, 1], y: [0, 1]}, fractures: {cut: {points: [[0, 0.2113248654051871], [1, "
         "0.7886751345948129]]}}}, mesh: {size: 0.12, distortion: 0.2, shape: " +
         shape +
         "}, components: {rock: {type: poromechanics/mpsa, "
         "young_modulus: 2.5 Pa, poisson_ratio: 0.25, boundary: {left: " +
         u + ", right: " + u + ", bottom: " + u + ", top: " + u + "}}, contact: {type: contact/" + type +
         ", friction: " + fmt::format("{:.17g}", friction) + ", dilation_angle: " + dilation + laws +
         "}}, couplers: [{type: wall_traction, between: [rock, contact]}], schedule: [{solve: [rock, contact]}], time: "
         "{end: 1 s, step: 1 s}}";
}

/// Traction of the uniform strain on the plus wall: n·sigma with sigma = 2 G eps + lambda tr(eps) I.
inline Point uniform_traction(const Tensor& strain = uniform_strain()) {
  const Tensor stress = 2 * strain + strain.trace() * Tensor::Identity();
  const Point n(0.5, -std::sqrt(3) / 2), t(std::sqrt(3) / 2, 0.5);
  const Point traction = stress * n;
  return {traction.dot(n), traction.dot(t)};
}

}  // namespace sprekk::testing
