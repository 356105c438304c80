// What the file of a study may hold.
#include <algorithm>
#include <cctype>

#include "framework/study/study.hpp"

namespace sprekk {
namespace {

/// "time.step: 1 h" of a map; maps as values stay maps, which are merged into the scene.
std::vector<Setting> read_settings(const Node& node, const std::string& what) {
  std::vector<Setting> settings;
  for (const Node& item : node.items)  // one after the other, as --set takes them
    for (Setting& setting : read_settings(item, "an item of " + what)) settings.push_back(std::move(setting));
  if (!node.is_map() && !node.is_null() && !node.is_list())
    throw InputError(node.origin, what + " is not a map", "it gives values by their path in the scene",
                     "write '{time.step: 1 h}'");
  for (const Node::Entry& entry : node.entries)
    settings.push_back({entry.key, entry.value.text(), entry.origin, entry.value.origin});
  return settings;
}

StudyOptions::Axis read_axis(const Node::Entry& entry) {
  if (!entry.value.is_list() || entry.value.items.empty())
    throw InputError(entry.value.origin, quoted(entry.key) + " in 'grid' has no list of values",
                     "the grid has a run for every combination of its lists", "write '" + entry.key + ": [a, b]'");
  StudyOptions::Axis axis{entry.key, {}};
  for (const Node& item : entry.value.items) {
    const Setting setting{entry.key, item.text(), entry.origin, item.origin};
    const auto same = std::find_if(axis.values.begin(), axis.values.end(),
                                   [&](const Setting& other) { return other.value == setting.value; });
    if (same != axis.values.end())
      throw InputError(item.origin, quoted(setting.value) + " stands twice in the list of " + quoted(entry.key),
                       "both runs would be the same", "remove one");
    axis.values.push_back(setting);
  }
  return axis;
}

/// Names of runs become names of folders.
void check_run_name(const Node::Entry& entry, const std::string& what = "a run") {
  const auto is_allowed = [](unsigned char c) { return std::isalnum(c) || c == '_' || c == '-' || c == '='; };
  if (entry.key.empty() || !std::all_of(entry.key.begin(), entry.key.end(), is_allowed))
    throw InputError(entry.origin, what + " cannot be called " + quoted(entry.key),
                     "names of runs are made of letters, digits, '_', '-' and '='", "choose another name");
}

/// "scheme: {monolithic: {schedule: …}, split: {schedule: …, newton.residual: …}}".
StudyOptions::Choice read_choice(const Node::Entry& entry) {
  check_run_name(entry, "a choice");
  if (!entry.value.is_map() || entry.value.entries.empty())
    throw InputError(entry.value.origin, "the choice " + quoted(entry.key) + " has no options",
                     "it gives values by path for each of its names",
                     "write '" + entry.key + ": {small: {mesh.size: 1 m}, large: {mesh.size: 2 m}}'");
  StudyOptions::Choice choice{entry.key, {}, entry.origin};
  for (const Node::Entry& option : entry.value.entries) {
    check_run_name(option, "an option");
    choice.options.push_back({option.key, read_settings(option.value, "the option " + quoted(option.key))});
  }
  return choice;
}

Origin origin_of(const Node& map, const std::string& key) {
  const Node* value = map.find(key);
  return value ? value->origin : map.origin;
}

Spec compare_spec(StudyOptions& options) {
  Spec spec("compare", "What of the runs is compared.");
  spec.texts("plot", options.plot,
             {.doc = "Columns of history.csv to draw against time; by default the first ones, at most six."});
  static FigureOptions example;
  spec.named_sections("table", example.spec(),
                      [&options](const std::string& key, const Origin& origin) {
                        options.table.emplace_back();
                        options.table.back().name = key;
                        options.table.back().origin = origin;
                        return options.table.back().spec();
                      },
                      {.doc = "Figures of each run by name; by default the last value of what is drawn."});
  spec.text("reference", options.reference,
            {.doc = "A run; the deviation of the others from its figures is added, in percent."});
  spec.check([&options](const Node& node) {
    options.plot_origin = origin_of(node, "plot");
    options.reference_origin = origin_of(node, "reference");
  });
  return spec;
}

}  // namespace

Spec StudyOptions::spec() {
  Spec spec("study", "Runs of one scene that differ in some values: the file of sprekk sweep.");
  spec.text("name", name, {.doc = "Name of the study; the file's name by default."});
  spec.texts("scene", scene,
             {.doc = "The scene, or several files that are merged, relative to the study's file.", .required = true});
  spec.custom("set", [this](const Node& node) { set = read_settings(node, "'set'"); },
              {.doc = "Values of the scene for all runs, by path: {time.end: 30 h}; or a list of these, set one after "
                      "the other."});
  spec.custom("grid",
              [this](const Node& node) {
                if (!node.is_map() && !node.is_null())
                  throw InputError(node.origin, "'grid' is not a map", "it gives lists of values by path",
                                   "write '{time.step: [1 h, 2 h]}'");
                for (const Node::Entry& entry : node.entries) grid.push_back(read_axis(entry));
              },
              {.doc = "Lists of values by path: one run for each combination."});
  spec.custom("choices",
              [this](const Node& node) {
                if (!node.is_map() && !node.is_null())
                  throw InputError(node.origin, "'choices' is not a map", "it gives the options of each choice by name",
                                   "write '{scheme: {monolithic: {…}, split: {…}}}'");
                for (const Node::Entry& entry : node.entries) choices.push_back(read_choice(entry));
              },
              {.doc = "Sets of values by name, for schemes and types that are exchanged: one run for each combination, "
                      "also with those of the grid."});
  spec.section("samples", samples.spec(),
               {.doc = "Values drawn from distributions: so many runs for each combination of the others."},
               &samples.is_given);
  spec.custom("runs",
              [this](const Node& node) {
                if (!node.is_map() && !node.is_null())
                  throw InputError(node.origin, "'runs' is not a map", "it gives the values of each run by its name",
                                   "write '{fine: {time.step: 1 h}}'");
                for (const Node::Entry& entry : node.entries) {
                  check_run_name(entry);
                  runs.push_back({entry.key, read_settings(entry.value, "the run " + quoted(entry.key))});
                }
              },
              {.doc = "Single runs by name, each with its values by path; beside the grid or instead of it."});
  spec.section("compare", compare_spec(*this), {.doc = "What of the runs is compared."});
  spec.check([this](const Node& node) {
    scene_origin = origin_of(node, "scene");
    if (grid.empty() && choices.empty() && runs.empty() && !samples.is_given)
      throw InputError(node.origin, "the study has no runs",
                       "'grid', 'choices', 'samples' and 'runs' say which there are",
                       "write 'grid: {time.step: [1 h, 2 h]}'");
  });
  return spec;
}

Spec study_spec() {
  static StudyOptions options;
  return options.spec();
}

}  // namespace sprekk
