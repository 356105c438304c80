// Laws of one kind by name: exchangeable parts of a component, each with parameters of its own. Plug-ins add to them.
#pragma once

#include <functional>
#include <map>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "framework/config/spec.hpp"
#include "framework/plugin/plugin.hpp"
#include "framework/scene/law_kinds.hpp"

namespace sprekk {

/// The registered laws with the interface `Law`, which are built from `Input`.
template <class Law, class Input>
class LawRegistry {
 public:
  using Build = std::function<std::unique_ptr<Law>(const Input&)>;
  /// The parameters of a law before they are read, and what builds the law from them.
  struct Unread {
    Spec spec;
    Build build;
  };
  /// A law by its name.
  struct Type {
    std::string name, doc;
    std::function<Unread()> begin;
  };

  /// `built_in`: names of the built-in laws, which no registered law may take, and what they are.
  explicit LawRegistry(NamesWithDocs built_in = {}) : built_in_(std::move(built_in)) {}

  void add(Type type) {
    for (const auto& [name, doc] : built_in_)
      if (name == type.name) return refuse_registration(type.name);
    for (const Type& known : types_)
      if (known.name == type.name) return refuse_registration(type.name);
    note_registration(type.name);
    types_.push_back(std::move(type));
  }
  const std::vector<Type>& types() const { return types_; }
  /// Of all laws: those that are built in, then the registered ones.
  NamesWithDocs names() const {
    NamesWithDocs names = built_in_;
    for (const Type& type : types_) names.emplace_back(type.name, type.doc);
    return names;
  }

 private:
  NamesWithDocs built_in_;
  std::vector<Type> types_;
};

/// Registers a law when it is constructed. Options is a struct with `Spec spec()`, whose targets are its own members
/// and whose text says what the law is, and `std::unique_ptr<Law> build(const Input&) const`.
template <class Options, class Law, class Input>
struct RegisterLaw {
  RegisterLaw(LawRegistry<Law, Input>& laws, const std::string& name) {
    laws.add({name, Options().spec().doc(), [] {
                auto options = std::make_shared<Options>();
                Spec spec = options->spec();
                return typename LawRegistry<Law, Input>::Unread{
                    std::move(spec), [options](const Input& input) { return options->build(input); }};
              }});
  }
};

/// What a scene says of a choice among registered laws: parameters of the law `name` stand in a section of that name.
template <class Law, class Input>
class LawChoice {
 public:
  /// Adds the sections of all registered laws.
  void add_sections(Spec& spec, const LawRegistry<Law, Input>& laws) {
    for (const auto& type : laws.types()) {
      auto unread = type.begin();
      builders_[type.name] = unread.build;
      needs_section_[type.name] = unread.spec.has_required();
      spec.section(type.name, std::move(unread.spec), {.doc = "Parameters of the law " + type.name + "."},
                   &is_given_[type.name]);
    }
  }
  /// Throws InputError for a section of a law that is not the chosen one, and for a missing one.
  void check(const Node& node, const std::string& chosen, const std::string& key) const {
    for (const auto& [name, is_given] : is_given_) {
      if (is_given && name != chosen)
        throw InputError(node.find(name)->origin, sprekk::quoted(name) + " has no effect",
                         "the law is " + sprekk::quoted(chosen), "write '" + key + ": " + name + "', or remove it");
      if (!is_given && name == chosen && needs_section_.at(name))
        throw InputError(node.origin, "the section " + sprekk::quoted(name) + " is missing",
                         "the law " + sprekk::quoted(name) + " has parameters that are needed", "see 'sprekk explain'");
    }
  }
  /// The law of this name; nullptr if none of it is registered.
  std::unique_ptr<Law> build(const std::string& name, const Input& input) const {
    const auto found = builders_.find(name);
    return found == builders_.end() ? nullptr : found->second(input);
  }

 private:
  std::map<std::string, typename LawRegistry<Law, Input>::Build> builders_;
  std::map<std::string, bool> is_given_, needs_section_;
};

}  // namespace sprekk
