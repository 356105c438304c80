// Probes: values of a field at a point, on a fracture or over a region, each a column of history.csv.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "framework/assembly/part.hpp"
#include "framework/config/spec.hpp"
#include "framework/field/field_store.hpp"
#include "framework/field/output_field.hpp"

namespace sprekk {

/// Parameters of a probe.
struct ProbeOptions {
  Origin origin;
  std::string of;           ///< a field, "pore.pressure", or what a part writes beside its fields, "rock.stress"
  std::optional<Point> at;  ///< m
  std::string fracture;     ///< name
  std::string region;       ///< name
  std::string take = "value";
  Spec spec();
};

/// Measures one figure of a field, or of an output of a part (Part::output): a weighted sum of values, or the smallest
/// or largest one.
/// - At a point of the matrix: a quadratic fit to the cells around it (quadratic_fit); for fields on nodes and faces
///   the linear value in the cell of the point.
/// - At a point of a fracture: the value of a polynomial along it (along_fracture), with the sign that all its cells
///   have; for a choice that of the cell.
/// - Over a fracture or region: the mean, integral, smallest or largest value.
class Probe {
 public:
  /// `outputs`: what parts write beside their fields. `has_values`: one flag a cell, or fracture cell; empty where all
  /// have. Throws InputError for names that are neither a field nor an
  /// output, for unknown fractures and regions, and for points outside of the mesh.
  Probe(const std::string& name, const ProbeOptions& options, const Mesh& mesh, const FieldStore& fields,
        const std::vector<OutputField>& outputs = {}, const std::vector<char>& has_values = {});
  /// Whether it measures an output, which `measure` then needs.
  bool is_of_output() const { return field_ == nullptr; }
  /// Appends one quantity for each component: "name.x", "name.y" for vectors of the matrix, "name.xx", "name.yy",
  /// "name.xy" for stresses, "name.n", "name.t" on fractures.
  void measure(std::vector<Quantity>& quantities, const std::vector<OutputField>& outputs = {}) const;

 private:
  void check_names(const Mesh& mesh, const ProbeOptions& options) const;
  void set_point_weights(const Mesh& mesh, const ProbeOptions& options);
  void set_domain_weights(const Mesh& mesh, const ProbeOptions& options, const std::vector<char>& has_values);

  std::string name_, take_, of_;
  const Field* field_ = nullptr;  ///< nullptr where the probe measures an output
  bool is_a_choice_ = false;      ///< as that of the output
  Location location_;
  int components_;
  std::string unit_;
  std::vector<std::pair<int, double>> weights_;  ///< entity, weight
};

}  // namespace sprekk
