// All outputs. Each registers itself with one line at the end of its source, also from a plug-in:
//
//   const RegisterFrameOutput<LinesOptions> registration("lines");
#pragma once

#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "framework/config/spec.hpp"
#include "framework/frame_output/frame_output.hpp"

namespace sprekk {

/// The parameters of one output in a scene.
struct FrameOutputChoice {
  std::string name;
  std::function<bool()> is_chosen;
  std::function<std::unique_ptr<FrameOutput>(const OutputPlace&)> build;
  /// Throws InputError for what cannot be written of this state, the one before the first step; null where nothing of
  /// it is asked.
  std::function<void(const Frame& start)> check;
  std::function<bool()> has_nothing_to_check = [] { return false; };
};

/// All outputs of the program.
class FrameOutputRegistry {
 public:
  /// An output by its key in a scene; `declare` adds the key to the spec of `output:`.
  struct Type {
    std::string name;
    std::function<FrameOutputChoice(Spec& output)> declare;
  };
  static FrameOutputRegistry& instance();
  void add(Type type);                                       ///< refuses a name that exists (refuse_registration)
  const std::vector<Type>& types() const { return types_; }  ///< sorted by name

 private:
  std::vector<Type> types_;
};

/// Registers an output when it is constructed. Options is a struct with `Spec spec()`, whose targets are its own
/// members and whose text says what is written, and `std::unique_ptr<FrameOutput> build(const OutputPlace&) const`; it
/// may have `void check(const Frame& start) const` and `bool has_nothing_to_check() const`. Its parameters are a
/// section. An output whose key is no section declares the key itself, by `void declare(Spec&, const std::string&
/// name)` and `bool is_chosen() const`.
template <class Options>
struct RegisterFrameOutput {
  explicit RegisterFrameOutput(const std::string& name) {
    FrameOutputRegistry::instance().add({name, [name](Spec& output) { return choice(name, output); }});
  }

 private:
  static FrameOutputChoice choice(const std::string& name, Spec& output) {
    auto options = std::make_shared<Options>();
    FrameOutputChoice choice;
    choice.name = name;
    choice.build = [options](const OutputPlace& place) { return options->build(place); };
    if constexpr (requires(const Frame& start) { options->check(start); })
      choice.check = [options](const Frame& start) { options->check(start); };
    if constexpr (requires { options->has_nothing_to_check(); })
      choice.has_nothing_to_check = [options] { return options->has_nothing_to_check(); };
    if constexpr (requires { options->declare(output, name); }) {
      options->declare(output, name);
      choice.is_chosen = [options] { return options->is_chosen(); };
    } else {
      auto is_given = std::make_shared<bool>(false);
      Spec spec = options->spec();
      const std::string doc = spec.doc();
      output.section(name, std::move(spec), {.doc = doc}, is_given.get());
      choice.is_chosen = [options, is_given] { return *is_given; };
    }
    return choice;
  }
};

}  // namespace sprekk
