// The declaration of one parameter, and what is known of a scene when parameters are read.
#pragma once

#include <functional>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "framework/config/node.hpp"
#include "framework/config/range.hpp"

namespace sprekk {

/// The declaration of a parameter besides its name and its target.
struct About {
  std::string unit = "";  ///< SI unit, "" for a plain number; the scene may use any unit of this dimension
  Range range = {};
  std::string doc = "";        ///< one sentence
  std::string source = "";     ///< equation or paper
  bool required = false;       ///< if not, the target's value at declaration is the default
  bool material = false;       ///< may also be given in the scene's `materials:` section, shared by all components
  bool constant_only = false;  ///< data that cannot be a function, a table or a value per region
  bool in_time = false;        ///< data that are evaluated in every step; others must not depend on t
  std::string fixed = "";      ///< why the data must not depend on t, for the message
};

/// A number that a table of fractures gives for one of them, in the column's unit ("" for none).
struct ColumnValue {
  std::string column, unit;
  double value = 0;
  Origin where = {};
};

/// The meaning of names in a scene, gathered before the components are read.
struct ReadContext {
  const Node* materials = nullptr;          ///< the `materials:` map or nullptr
  std::vector<std::string> region_names;    ///< for values per region, by index
  std::vector<std::string> fracture_names;  ///< for values per fracture, by index
  /// Where the component that is read lives, by names or their beginnings, `joints_*`; empty for everywhere. Data by
  /// name need no value elsewhere.
  std::vector<std::string> own_regions, own_fractures;
  std::vector<std::vector<ColumnValue>> fracture_values;  ///< from tables of fractures, by index
  std::string folder = ".";                               ///< of the scene file: tables are found relative to it
  /// Records path, value (YAML on one line) and origin ("scene.yaml:3:4" or "default") of every parameter read or
  /// defaulted, for `show`; may be null.
  std::function<void(const std::string& path, const std::string& value, const std::string& origin)> record;
  /// Receives every key of `materials:` that some spec knows, also where the component's own value wins; may be null.
  std::function<void(const std::string& key)> material_used;
  /// Receives the column of tables of fractures that a datum takes; may be null.
  std::function<void(const std::string& column)> column_used;
};

/// One declared parameter, as `explain` and the schema see it.
struct Parameter {
  std::string name;
  /// "quantity", "data", "vector", "tensor", "point", "points", "quantities", "integer", "flag", "text", "texts",
  /// "choice", "section", "named sections", "list of sections", "custom"
  std::string kind;
  About about;
  std::string default_text;                                  ///< "" when there is none
  std::vector<std::pair<std::string, std::string>> choices;  ///< value, doc
  std::shared_ptr<const class Spec> inner;                   ///< of sections
};

}  // namespace sprekk
