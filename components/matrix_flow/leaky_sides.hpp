// Leaky sides: the flux through them depends on an outer pressure.
#pragma once

#include <cstdint>
#include <map>
#include <string>
#include <vector>

#include "components/capabilities/matrix_fluid.hpp"
#include "components/matrix_flow/side_condition.hpp"
#include "framework/assembly/assembly.hpp"
#include "framework/assembly/step_time.hpp"
#include "framework/config/data.hpp"

namespace sprekk::matrix_flow {

/// The flux q through each face of a leaky side, out of the rock (m/s), by the pressure tr p of the rock there:
///   q = c (tr p − p_outer), and with `only_out` the larger of this and 0;
///   without a conductance and `only_out`: q >= 0, tr p <= p_outer, and one of them is an equality.
/// The equations of q are d = 0, or with `only_out` q − max(0, q + d) = 0, which is linear in pieces. Here
///   d = (c (tr p − p_outer) − q)/(1 + c R)
/// and R is the resistance of the rock in front of the face (d tr p/d q), by which both equations are well scaled from
/// closed to open sides.
class LeakySides {
 public:
  LeakySides(const Mesh& mesh, const std::map<std::string, SideCondition>& sides, const std::vector<char>& inside);

  const std::vector<char>& faces() const { return is_leaky_; }  ///< one flag a face of the mesh
  bool is_empty() const { return faces_.empty(); }
  bool let_only_out() const { return only_out_; }  ///< somewhere

  void evaluate(const StepTime& step);
  /// Pa; one for each face of the mesh.
  double largest_pressure() const;
  /// Adds the rows of `outflow` (one a face of the mesh). `trace`: tr p. Collective.
  void assemble(Assembly& assembly, const Field& outflow, const LinearExpression& trace) const;
  /// d at linear sides, 0 elsewhere: the change of q that its equation asks for.
  struct Correction {
    Vector value;              ///< m/s, one a face of the mesh
    Vector of_flux, of_trace;  ///< −d value/d q and d value/d tr p
  };
  Correction correction(const Field& outflow, const LinearExpression& trace) const;
  /// A number that identifies which of the faces with `only_out` let fluid out now. Collective.
  std::uint64_t passing_state(const Field& outflow, const LinearExpression& trace) const;

 private:
  struct Rows {
    Vector of_flux, of_trace;  ///< of d, one a face of the mesh
    Vector drive;              ///< d
  };
  Rows rows(const Field& outflow, const LinearExpression& trace) const;

  const Mesh& mesh_;
  const std::map<std::string, SideCondition>& sides_;
  std::vector<char> is_leaky_;
  std::vector<int> faces_;
  std::vector<const SideCondition*> side_of_;  ///< of each of `faces_`
  std::vector<OutsideOfRock> outside_;         ///< the same
  bool only_out_ = false;
};

}  // namespace sprekk::matrix_flow
