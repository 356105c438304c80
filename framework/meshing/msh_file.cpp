#include "framework/meshing/msh_file.hpp"

#include <algorithm>
#include <array>
#include <cstdlib>
#include <optional>
#include <set>

#include "framework/config/input_error.hpp"
#include "framework/meshing/msh_cursor.hpp"
#include "framework/meshing/msh_entities.hpp"

namespace sprekk {
namespace {

const std::string save_again = "save it with 'gmsh FILE -save -format msh41 -o NEW.msh'";

/// An element type of gmsh, if its edges are straight and it may be part of a mesh: dimension and number of nodes; 0
/// nodes for all other types.
struct Kind {
  int dimension, node_count;
};
Kind kind_of(int type) {
  switch (type) {
    case 1:
      return {1, 2};
    case 2:
      return {2, 3};
    case 3:
      return {2, 4};
    case 4:
      return {3, 4};
    case 5:
      return {3, 8};
    case 6:
      return {3, 6};
    case 15:
      return {0, 1};
    default:
      return {0, 0};
  }
}

constexpr int pyramid = 7;                                                   // its type
constexpr std::array volumes{4, 5, 6, pyramid, 11, 12, 13, 14, 17, 18, 19};  // up to second order
constexpr int most_tags = 100'000;  // of an element: more is a file that is damaged

/// Whether the type is a line with more than two nodes.
bool is_curved_line(int type) { return type == 8 || (type >= 26 && type <= 28); }

class Parser {
 public:
  explicit Parser(std::string_view bytes) : cursor_(bytes) { file_.bytes = bytes; }

  /// Whether an element that was read has a volume.
  bool has_volumes() const { return has_volumes_; }

  MshFile parse() {
    read_format();
    for (cursor_.skip_blanks(); cursor_.remaining() > 0; cursor_.skip_blanks()) read_section();
    if (!read_.count("$Nodes")) cursor_.fail("the file has no section $Nodes");
    if (!read_.count("$Elements")) cursor_.fail("the file has no section $Elements");
    sort_nodes();
    if (is_new_) assign_groups();
    return std::move(file_);
  }

 private:
  void read_format() {
    const std::string no_mesh = "the file is no mesh: it does not begin with $MeshFormat";
    for (;;) {
      cursor_.skip_blanks();
      if (cursor_.remaining() == 0) cursor_.fail(no_mesh);
      const std::size_t begin = cursor_.position();
      const std::string_view name = cursor_.rest_of_line();
      if (name == "$MeshFormat") break;
      if (name != "$Comments" || !cursor_.skip_past("$EndComments")) cursor_.fail_at(begin, no_mesh);
    }
    const std::size_t begin = cursor_.position();
    const std::string version(cursor_.word("the version"));
    if (version != "2.2" && version != "4.1") {
      cursor_.fail_at(begin,
                      "the format's version is " + quoted(version) + ", and 2.2 and 4.1 are read: " + save_again);
    }
    is_new_ = version == "4.1";
    const int kind = cursor_.text_integer("0 (text) or 1 (binary)");
    if (kind != 0 && kind != 1) cursor_.fail("the kind of file is " + std::to_string(kind) + ", neither 0 nor 1");
    const int size = cursor_.text_integer("the size of a number");
    if (size != 8) cursor_.fail("numbers of " + std::to_string(size) + " bytes are not read: " + save_again);
    cursor_.rest_of_line();
    file_.is_binary = kind == 1;
    cursor_.set_binary(file_.is_binary);
    if (file_.is_binary && cursor_.integer("the number 1") != 1) {
      cursor_.fail("the file was written by a computer with another order of bytes: " + save_again + " there, as text");
    }
    end_section("$MeshFormat");
  }

  void end_section(const std::string& name) {
    const std::string end = "$End" + name.substr(1);
    cursor_.skip_blanks();
    const std::size_t begin = cursor_.position();
    const std::string_view found = cursor_.rest_of_line();
    if (found != end) cursor_.fail_at(begin, quoted(std::string(found)) + " stands where " + end + " is expected");
  }

  void read_section() {
    const std::size_t begin = cursor_.position();
    const std::string name(cursor_.rest_of_line());
    if (name.size() < 2 || name[0] != '$' || name.rfind("$End", 0) == 0) {
      cursor_.fail_at(begin, quoted(name) + " stands where a section is expected");
    }
    const bool is_read = name == "$PhysicalNames" || name == "$Nodes" || name == "$Elements" ||
                         (is_new_ && (name == "$Entities" || name == "$PartitionedEntities"));
    if (!is_read) {
      if (name == "$MeshFormat") cursor_.fail_at(begin, "the section $MeshFormat is there twice");
      if (!cursor_.skip_past("$End" + name.substr(1))) {
        cursor_.fail_at(begin, "the section " + quoted(name) + " does not end");
      }
      return;
    }
    if (!read_.insert(name).second) cursor_.fail_at(begin, "the section " + name + " is there twice");
    if (name == "$PhysicalNames") read_names();
    if (name == "$Entities") entities_.read(cursor_, false, file_.group_lists);
    if (name == "$PartitionedEntities") entities_.read(cursor_, true, file_.group_lists);
    if (name == "$Nodes") is_new_ ? read_nodes() : read_old_nodes();
    if (name == "$Elements") is_new_ ? read_elements() : read_old_elements();
    end_section(name);
  }

  std::size_t old_count(const char* what, std::size_t least_bytes) {
    const std::size_t begin = cursor_.position();
    const int count = cursor_.text_integer(what);
    if (count < 0 || static_cast<std::size_t>(count) > cursor_.remaining() / least_bytes) {
      cursor_.fail_at(begin, std::string(what) + " is " + std::to_string(count) +
                                 (count < 0 ? "" : ", more than the rest of the file can hold"));
    }
    return static_cast<std::size_t>(count);
  }

  void read_names() {
    const std::size_t count = old_count("the number of names", 6);
    for (std::size_t i = 0; i < count; ++i) {
      const int dimension = cursor_.text_integer("a group's dimension");
      const std::size_t begin = cursor_.position();
      const int number = cursor_.text_integer("a group's number");
      if (dimension < 0 || dimension > 3 || number < 1) {
        cursor_.fail_at(begin,
                        "there is no group " + std::to_string(number) + " of dimension " + std::to_string(dimension));
      }
      std::string_view name = cursor_.rest_of_line();
      if (name.size() < 2 || name.front() != '"' || name.back() != '"') {
        cursor_.fail_at(begin, "a group's name stands in double quotes, on the line of its number");
      }
      name = name.substr(1, name.size() - 2);
      if (!file_.names.try_emplace({dimension, number}, name).second) {
        cursor_.fail_at(
            begin, "group " + std::to_string(number) + " of dimension " + std::to_string(dimension) + " has two names");
      }
    }
  }

  void add_node(std::uint64_t number, std::size_t place) {
    MshFile::Node node{number, {}, place};
    for (double& coordinate : node.position) coordinate = cursor_.real("a coordinate");
    file_.nodes.push_back(node);
  }

  void read_old_nodes() {
    const std::size_t count = old_count("the number of nodes", cursor_.least_bytes(28, 4));
    if (file_.is_binary) cursor_.rest_of_line();
    file_.nodes.reserve(count);
    for (std::size_t i = 0; i < count; ++i) {
      if (!file_.is_binary) cursor_.skip_blanks();
      const std::size_t place = cursor_.position();
      const int number = cursor_.integer("a node's number");
      if (number < 1) cursor_.fail_at(place, "there is no node " + std::to_string(number));
      add_node(static_cast<std::uint64_t>(number), place);
    }
  }

  void read_nodes() {
    const std::size_t blocks = cursor_.wide_count("the number of blocks", 20, 4);
    const std::size_t count = cursor_.wide_count("the number of nodes", 32, 4);
    cursor_.number("the smallest number of a node");
    cursor_.number("the largest number of a node");
    file_.nodes.reserve(count);
    std::vector<std::pair<std::uint64_t, std::size_t>> numbers;
    for (std::size_t block = 0; block < blocks; ++block) {
      const std::size_t begin = cursor_.position();
      const int dimension = cursor_.integer("an entity's dimension");
      cursor_.integer("an entity's number");
      const int is_parametric = cursor_.integer("0 or 1 (parametric)");
      if (dimension < 0 || dimension > 3 || is_parametric < 0 || is_parametric > 1) {
        cursor_.fail_at(begin, "a block of nodes has dimension " + std::to_string(dimension) +
                                   " and is parametric: " + std::to_string(is_parametric));
      }
      const std::size_t size = cursor_.wide_count("the number of nodes of a block", 32, 4);
      numbers.clear();
      numbers.reserve(size);
      for (std::size_t i = 0; i < size; ++i) {
        if (!file_.is_binary) cursor_.skip_blanks();
        const std::size_t place = cursor_.position();
        numbers.emplace_back(cursor_.number("a node's number"), place);
      }
      for (const auto& [number, place] : numbers) {
        add_node(number, place);
        for (int i = 0; i < is_parametric * dimension; ++i) cursor_.real("a node's parameter");
      }
    }
    if (file_.nodes.size() != count) {
      cursor_.fail("the blocks hold " + std::to_string(file_.nodes.size()) + " nodes, and " + std::to_string(count) +
                   " were announced");
    }
  }

  /// The kind of an element by its type. Throws InputError at `place` for other types.
  Kind require_kind(int type, std::size_t place) {
    if (std::find(volumes.begin(), volumes.end(), type) != volumes.end()) has_volumes_ = true;
    const Kind kind = kind_of(type);
    if (kind.node_count > 0 && kind.dimension <= dimension) return kind;
    cursor_.fail_at(place, std::string("the file holds elements that are no ") +
                               (is_curved_line(type) ? "two-node lines"
                                : dimension == 2     ? "three-node triangles or four-node quadrilaterals"
                                : type == pyramid    ? "tetrahedra, wedges or hexahedra"
                                                     : "elements of first order") +
                               " (gmsh type " + std::to_string(type) + "): mesh it with 'gmsh -" +
                               std::to_string(dimension) + " -order 1'" +
                               (dimension == 3 && type == pyramid ? ", without pyramids" : ""));
  }

  template <class Number>
  void add_element(const Kind& kind, int group_list, std::size_t place, const Number& number) {
    MshFile::Element element{{}, kind.node_count, group_list, place};
    for (int i = 0; i < kind.node_count; ++i) element.nodes[i] = number();
    if (kind.dimension == dimension - 1) file_.faces.push_back(element);
    if (kind.dimension == dimension) file_.cells.push_back(element);
  }

  std::uint64_t old_node() {
    const std::size_t begin = cursor_.position();
    const int number = cursor_.integer("a node's number");
    if (number < 1) cursor_.fail_at(begin, "there is no node " + std::to_string(number));
    return static_cast<std::uint64_t>(number);
  }

  /// Elements of version 2.2 contain the number of their group.
  void add_old_element(const Kind& kind, int tag_count, std::size_t place) {
    int group = 0;
    for (int i = 0; i < tag_count; ++i) {
      const int tag = cursor_.integer("an element's tag");
      if (i == 0) group = tag;
    }
    if (group == -2147483647 - 1) cursor_.fail_at(place, "there is no group " + std::to_string(group));
    group = std::abs(group);
    const auto [list, is_new] = old_lists_.try_emplace(group, static_cast<int>(file_.group_lists.size()));
    if (is_new) file_.group_lists.push_back(group == 0 ? std::vector<int>{} : std::vector<int>{group});
    add_element(kind, list->second, place, [&] { return old_node(); });
  }

  int tag_count(std::size_t place) {
    const int count = cursor_.integer("the number of tags");
    if (count < 0 || count > most_tags) cursor_.fail_at(place, "an element has " + std::to_string(count) + " tags");
    return count;
  }

  void read_old_elements() {
    const std::size_t count = old_count("the number of elements", cursor_.least_bytes(8, 4));
    if (!file_.is_binary) {
      for (std::size_t i = 0; i < count; ++i) {
        cursor_.skip_blanks();
        const std::size_t place = cursor_.position();
        cursor_.integer("an element's number");
        const Kind kind = require_kind(cursor_.integer("an element's type"), place);
        const int tags = tag_count(place);
        add_old_element(kind, tags, place);
      }
      return;
    }
    cursor_.rest_of_line();
    for (std::size_t read = 0; read < count;) {
      const std::size_t begin = cursor_.position();
      const Kind kind = require_kind(cursor_.integer("an element's type"), begin);
      const std::size_t size = cursor_.count("the number of elements of a block", 4 * (1 + kind.node_count), false);
      const int tags = tag_count(begin);
      if (size == 0 || size > count - read) {
        cursor_.fail_at(begin, "a block has " + std::to_string(size) + " elements, and " +
                                   std::to_string(count - read) + " are to come");
      }
      for (std::size_t i = 0; i < size; ++i) {
        const std::size_t place = cursor_.position();
        cursor_.integer("an element's number");
        add_old_element(kind, tags, place);
      }
      read += size;
    }
  }

  void read_elements() {
    const std::size_t blocks = cursor_.wide_count("the number of blocks", 20, 4);
    const std::size_t count = cursor_.wide_count("the number of elements", 16, 2);
    cursor_.number("the smallest number of an element");
    cursor_.number("the largest number of an element");
    std::size_t read = 0;
    for (std::size_t block = 0; block < blocks; ++block) {
      if (!file_.is_binary) cursor_.skip_blanks();
      const std::size_t begin = cursor_.position();
      const int dimension = cursor_.integer("an entity's dimension");
      const int entity = cursor_.integer("an entity's number");
      const int type = cursor_.integer("an element's type");
      const std::size_t size = cursor_.wide_count("the number of elements of a block", 16, 2);
      if (size == 0) continue;
      const Kind kind = require_kind(type, begin);
      if (kind.dimension != dimension) {
        cursor_.fail_at(begin, "elements of gmsh type " + std::to_string(type) + " belong to an entity of dimension " +
                                   std::to_string(dimension));
      }
      blocks_.push_back({{dimension, entity}, begin});
      for (std::size_t i = 0; i < size; ++i) {
        if (!file_.is_binary) cursor_.skip_blanks();
        const std::size_t place = cursor_.position();
        cursor_.number("an element's number");
        add_element(kind, static_cast<int>(blocks_.size()) - 1, place,
                    [&] { return cursor_.number("a node's number"); });
      }
      read += size;
    }
    if (read != count) {
      cursor_.fail("the blocks hold " + std::to_string(read) + " elements, and " + std::to_string(count) +
                   " were announced");
    }
  }

  /// Replaces the blocks of elements of version 4.1 by lists of groups. In a file, the entities may come after the
  /// elements.
  void assign_groups() {
    std::vector<int> list_of_block;
    const int no_groups = static_cast<int>(file_.group_lists.size());
    file_.group_lists.emplace_back();
    for (const Block& block : blocks_) {
      const auto [dimension, number] = block.entity;
      const std::optional<int> groups = entities_.groups_of(dimension, number);
      if (!groups && !entities_.empty() && dimension > 0) {
        cursor_.fail_at(block.place, "entity " + std::to_string(number) + " of dimension " + std::to_string(dimension) +
                                         " is not among the $Entities");
      }
      list_of_block.push_back(groups.value_or(no_groups));
    }
    for (auto* elements : {&file_.faces, &file_.cells}) {
      for (MshFile::Element& element : *elements) element.group_list = list_of_block[element.group_list];
    }
  }

  void sort_nodes() {
    std::stable_sort(file_.nodes.begin(), file_.nodes.end(),
                     [](const MshFile::Node& a, const MshFile::Node& b) { return a.number < b.number; });
    const auto twice =
        std::adjacent_find(file_.nodes.begin(), file_.nodes.end(),
                           [](const MshFile::Node& a, const MshFile::Node& b) { return a.number == b.number; });
    if (twice != file_.nodes.end()) {
      cursor_.fail_at((twice + 1)->place, "node " + std::to_string(twice->number) + " is there twice");
    }
  }

  struct Block {
    std::pair<int, int> entity;  ///< dimension and number
    std::size_t place;
  };

  MshCursor cursor_;
  MshFile file_;
  bool is_new_ = false;  ///< version 4.1
  bool has_volumes_ = false;
  std::set<std::string> read_;
  MshEntities entities_;
  std::map<int, int> old_lists_;  ///< list of groups, by group
  std::vector<Block> blocks_;     ///< of elements
};

}  // namespace

std::string MshFile::where(std::size_t place) const {
  place = std::min(place, bytes.size());
  if (is_binary) return "byte " + std::to_string(place);
  const auto lines = std::count(bytes.begin(), bytes.begin() + static_cast<std::ptrdiff_t>(place), '\n');
  return "line " + std::to_string(lines + 1);
}

MshFile parse_msh(std::string_view bytes) { return Parser(bytes).parse(); }

int dimension_of_msh(std::string_view bytes) {
  Parser parser(bytes);
  try {
    parser.parse();
  } catch (const InputError&) {
    // A plane's parser ends at the first volume; whatever else is wrong is told by who uses the file.
  }
  return parser.has_volumes() ? 3 : 2;
}

}  // namespace sprekk
