// A study: runs of one scene that differ in some of its values. Read from a file like
//
//   scene: onset.yaml
//   grid: {time.step: [0.5 h, 1 h], mesh.fracture_size: [10 mm, 20 mm]}
//   choices: {flow: {one: {components.pore.type: TYPE}, other: {components.pore.type: OTHER_TYPE}}}
//   samples: {count: 64, of: {time.step: {from: 1 h, to: 2 h}}}
//   runs: {reference: {time.step: 0.25 h, mesh.fracture_size: 5 mm}}
//   compare: {plot: [p_C], table: {final p_C: {of: p_C, at: end}}, reference: reference}
#pragma once

#include <list>
#include <map>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "framework/scene/scene.hpp"
#include "framework/study/figure.hpp"
#include "framework/study/samples.hpp"

namespace sprekk {

/// A value of the scene that a study sets.
struct Setting {
  std::string path;
  std::string value;  ///< YAML on one line
  Origin key_origin, value_origin;
};

/// The parameters in the file of a study, declared by `spec`.
struct StudyOptions {
  /// A path of the scene, and the values that the study gives it.
  struct Axis {
    std::string path;
    std::vector<Setting> values;
  };
  /// One of several sets of settings, under one name in the names of runs and in tables.
  struct Choice {
    std::string name;
    /// A name, and what it stands for.
    struct Option {
      std::string name;
      std::vector<Setting> settings;
    };
    std::vector<Option> options;
    Origin origin;
  };
  /// A run with its own settings.
  struct NamedRun {
    std::string name;
    std::vector<Setting> settings;
  };

  std::optional<std::string> name;
  std::vector<std::string> scene;
  std::vector<Setting> set;
  std::vector<Axis> grid;
  std::vector<Choice> choices;
  SampleOptions samples;
  std::vector<NamedRun> runs;
  std::vector<std::string> plot;
  std::list<FigureOptions> table;
  std::optional<std::string> reference;
  Origin scene_origin, plot_origin, reference_origin;
  Spec spec();
};

/// A run of a study.
struct StudyRun {
  std::string name;                                ///< of the run and of its folder
  std::vector<Setting> settings;                   ///< all, in the order in which they are applied
  std::vector<std::string> values;                 ///< of the study's keys in the scene of the run
  std::string identity;                            ///< changes with anything that the run reads
  std::map<std::string, std::string> chosen = {};  ///< the options of choices, by the choices' names
  std::string samples_of = "";                     ///< the name without the number of the sample; "" for none
};

/// All runs of a study, and what is to be compared.
struct Study {
  std::string name;
  std::vector<std::string> scene_files;
  std::vector<std::string> keys;  ///< the paths that differ between runs, and the names of choices
  std::vector<StudyRun> runs;
  std::vector<std::string> plot;  ///< columns, as the user wrote them
  Origin plot_origin;
  std::list<FigureOptions> table;
  std::optional<std::string> reference;  ///< the name of a run
  bool has_samples = false;

  Scene scene_of(const StudyRun& run) const;
};

/// Reads the file of a study and the scene of every run. Throws InputError for any mistake in them.
Study read_study(const std::string& file);

/// The spec with its defaults, for `explain`, the reference and the schema.
Spec study_spec();

}  // namespace sprekk
