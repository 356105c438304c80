// The declarative parameter spec: one declaration per parameter, from which come parsing, validation, `explain`,
// `show`, the reference pages and the JSON schema.
//
//   struct Options { Data permeability; double eta = 1.0 / 3; };
//   Options options;
//   Spec spec("role/name", "What a component of this type does, in one sentence.");
//   spec.data("permeability", options.permeability,
//             {.unit = "m^2", .range = positive(), .doc = "Permeability of the rock.", .source = "Eq. 6 of the paper",
//              .material = true});
//   spec.read(node, context);
#pragma once

#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "framework/config/data.hpp"
#include "framework/config/node.hpp"
#include "framework/config/parameter.hpp"

namespace sprekk {

/// The parameters of one map of a scene, with the variables that they are read into.
class Spec {
 public:
  Spec(std::string name, std::string doc);

  // Each target must outlive `read`. An std::optional target is absent unless it is given.
  // A name declared twice, a unit that is not SI or a default out of range is a std::logic_error.
  //
  // What a scene may write for data (all with units; see parse_data in units.hpp):
  //   20 MPa                                              a number
  //   (1 + 0.1*sin(pi*x)) MPa                             an expression of x, y (in space z; m) and t (s)
  //   {regions: {granite: 1e-18 m^2, default: 1e-20 m^2}} a datum for each region of the mesh
  //   {fractures: {fault: 0.3, default: 0.6}}     a datum for each fracture
  //   {column: friction, default: 0.6}            a column of the tables that fractures come from
  //   {table: p.csv, column: p, of: t, unit: MPa}         linear between the rows, constant outside
  //   {value: 5e-9 m^2/s, from: 6 h, to: 21 h}            zero outside [from, to); a list of these adds up
  // for vectors [x, y]; for tensors one datum (isotropic), {xx:, yy:, xy:} or {along:, across:, angle:}, also by
  // region.
  Spec& quantity(const std::string& name, double& target, About about);
  Spec& quantity(const std::string& name, std::optional<double>& target, About about);
  Spec& data(const std::string& name, Data& target, About about);
  Spec& data(const std::string& name, std::optional<Data>& target, About about);
  Spec& vector(const std::string& name, VectorData& target, About about);
  Spec& vector(const std::string& name, std::optional<VectorData>& target, About about);
  Spec& tensor(const std::string& name, TensorData& target, About about);
  Spec& tensor(const std::string& name, std::optional<TensorData>& target, About about);
  Spec& point(const std::string& name, Point& target, About about);  ///< [x, y]
  Spec& point(const std::string& name, std::optional<Point>& target, About about);
  Spec& points(const std::string& name, std::vector<Point>& target, About about);       ///< [[x, y], …]
  Spec& quantities(const std::string& name, std::vector<double>& target, About about);  ///< [a, b, …]
  Spec& integer(const std::string& name, int& target, About about);
  Spec& flag(const std::string& name, bool& target, About about);
  Spec& text(const std::string& name, std::string& target, About about);
  Spec& text(const std::string& name, std::optional<std::string>& target, About about);
  Spec& texts(const std::string& name, std::vector<std::string>& target, About about);  ///< one text or a list of them
  Spec& choice(const std::string& name, std::string& target,
               std::vector<std::pair<std::string, std::string>> values_and_docs, About about);
  /// A nested map with a fixed set of keys. If `given` is not null, it tells afterwards whether the scene has the
  /// section, and an absent section is not read at all. Without `given`, the defaults of an absent section are taken
  /// (unless it has required parameters).
  Spec& section(const std::string& name, Spec inner, About about, bool* given = nullptr);
  /// A nested map whose keys the user chooses (boundary sides, fractures, probes): for each entry `add` is called with
  /// the key and its origin; it returns the spec to read the entry with, whose targets `add` has created.
  using AddEntry = std::function<Spec(const std::string& key, const Origin& origin)>;
  Spec& named_sections(const std::string& name, const Spec& example, AddEntry add, About about);
  /// A list of maps: for each item `add` is called with its index.
  using AddItem = std::function<Spec(int index, const Origin& origin)>;
  Spec& list_of_sections(const std::string& name, const Spec& example, AddItem add, About about);
  /// A value that `read` takes from the tree (schedules).
  Spec& custom(const std::string& name, std::function<void(const Node&)> read, About about);
  /// A check across parameters, made after all are read; throws InputError.
  Spec& check(std::function<void(const Node& whole)> check);
  /// Keys that other code reads (for example `type`): allowed and ignored.
  Spec& ignore(const std::string& name);

  /// Reads all parameters into their targets. Unknown keys, missing required ones, wrong dimensions, values out of
  /// range and malformed values throw one InputError with all of them: the origin, the reason, and the nearest or
  /// allowed names. A material is looked up in the component first, then in `context.materials`.
  void read(const Node& node, const ReadContext& context) const;

  const std::string& name() const { return name_; }
  const std::string& doc() const { return doc_; }
  const std::vector<Parameter>& parameters() const { return parameters_; }
  const std::vector<std::string>& ignored() const { return ignored_; }
  bool has_required() const;  ///< whether an empty map would be refused because a parameter is required

 private:
  using Reader = std::function<void(const Node& value, const ReadContext& context)>;
  Spec& add(Parameter parameter, Reader reader, Reader when_absent = nullptr);
  void read_unknown_keys(const Node& node, std::vector<std::string>& problems, std::vector<std::string>& meant) const;
  void read_parameter(std::size_t i, const Node& node, const ReadContext& context,
                      const std::vector<std::string>& meant) const;
  std::vector<std::string> parameter_names() const;

  std::string name_, doc_;
  std::vector<Parameter> parameters_;
  std::vector<Reader> readers_;      ///< one a parameter
  std::vector<Reader> when_absent_;  ///< one a parameter, given the map that lacks it; may be null
  std::vector<std::function<void(const Node&)>> checks_;
  std::vector<std::string> ignored_;
};

/// The text that `sprekk explain` prints.
std::string explain(const Spec& spec);
/// The explanation as Markdown, for docs/reference.
std::string reference_page(const Spec& spec);
/// The JSON schema (draft 2020-12) of a map read by `spec`, as JSON text.
std::string json_schema(const Spec& spec);

}  // namespace sprekk
