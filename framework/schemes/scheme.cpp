#include "framework/schemes/scheme.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>

#include "framework/assembly/stabilizes.hpp"

namespace sprekk {

namespace {

std::string joined(const std::vector<std::string>& words, const std::string& between) {
  std::string text;
  for (const std::string& word : words) text += (text.empty() ? "" : between) + word;
  return text;
}

/// Letters, digits and '_' of a text.
std::string word_of(const std::string& text) {
  std::string word;
  for (const unsigned char c : text) {
    if (std::isalnum(c) != 0)
      word += static_cast<char>(c);
    else if (!word.empty() && word.back() != '_')
      word += '_';
  }
  while (!word.empty() && word.back() == '_') word.pop_back();
  return word;
}

const char* const response = "response";

/// Whether components that need others may be solved apart from them, with the Schur complement of waiting unknowns.
enum class Apart { as_they_are, with_response };

bool is_unknown_of(const Field& field, const std::string& component) {
  return field.is_solved() && field.size() > 0 && field.spec().owner == component;
}

/// Components that have unknowns, those that belong together as one.
std::vector<Group> atoms(const Model& model, Apart apart) {
  std::vector<Group> atoms;
  for (const auto& component : model.components())
    if (std::ranges::any_of(model.fields().all(),
                            [&](const auto& field) { return is_unknown_of(*field, component->name()); }))
      atoms.push_back({component->name()});
  const auto place_of = [&](const std::string& name) {
    return std::ranges::find_if(atoms, [&](const Group& atom) { return std::ranges::count(atom, name) > 0; });
  };
  for (const Part* part : model.parts())
    for (const Dependence& dependence : part->dependences()) {
      if (apart == Apart::with_response && dependence.ends_with_response) continue;
      const auto one = place_of(dependence.on), other = place_of(dependence.component);
      if (one == atoms.end() || other == atoms.end() || one == other) continue;
      one->insert(one->end(), other->begin(), other->end());
      atoms.erase(other);
    }
  return atoms;
}

/// Puts the next atom into each group, or into one of its own.
void partition(const std::vector<Group>& atoms, std::size_t next, std::vector<Group>& groups,
               std::vector<std::vector<Group>>& all) {
  if (next == atoms.size()) return all.push_back(groups);
  for (std::size_t g = 0; g <= groups.size(); ++g) {
    std::vector<Group> more = groups;
    if (g == more.size()) more.emplace_back();
    more[g].insert(more[g].end(), atoms[next].begin(), atoms[next].end());
    partition(atoms, next + 1, more, all);
  }
}

std::vector<std::vector<Group>> orders(const std::vector<Group>& groups) {
  if (groups.size() == 2) return {groups, {groups[1], groups[0]}};
  std::vector<std::size_t> place(groups.size());
  for (std::size_t i = 0; i < place.size(); ++i) place[i] = i;
  std::vector<std::vector<Group>> all;
  do {
    all.emplace_back();
    for (const std::size_t i : place) all.back().push_back(groups[i]);
  } while (!place.empty() && std::next_permutation(place.begin() + 1, place.end()));
  return all;
}

/// Whether a stabilization lets a balance keep its amount while a group of the coupler's components waits for nothing
/// else: these are solved apart from the owner of the balance.
bool holds_amounts_for(const Coupler& coupler, const std::vector<std::string>& between, const std::string& name,
                       const Group& group) {
  const auto* holds = dynamic_cast<const Stabilizes*>(&coupler);
  if (!holds) return false;
  const auto is_in_group = [&](const std::string& component) { return std::ranges::count(group, component) > 0; };
  try {
    return std::ranges::any_of(holds->holds_amounts_of(name), [&](const Field* field) {
      return !is_in_group(field->spec().owner) && std::ranges::any_of(between, is_in_group);
    });
  } catch (const InputError&) {  // there are none to be held in this scene
    return false;
  }
}

/// The scheme with each stabilization that helps one of its groups: the coupler that offers it stands between groups.
std::vector<Scheme> stabilized(const Model& model, const Scheme& scheme) {
  std::vector<Scheme> all;
  const auto& couplers = model.scene().couplers;
  for (std::size_t k = 0; k < couplers.size(); ++k) {
    const auto* offer = dynamic_cast<const Stabilizes*>(model.couplers()[k].get());
    for (const std::string& name : offer ? offer->stabilizations() : std::vector<std::string>()) {
      Stabilization diagonals;
      offer->stabilize(name, diagonals);
      for (std::size_t g = 0; g < scheme.groups.size(); ++g) {
        if (scheme.stabilizations.contains(g)) continue;
        const auto is_in = [&](const std::string& component) {
          return std::ranges::count(scheme.groups[g], component) > 0;
        };
        const bool has_field =
            std::ranges::any_of(diagonals, [&](const auto& entry) { return is_in(entry.first->spec().owner); });
        const bool holds = holds_amounts_for(*model.couplers()[k], couplers[k].between, name, scheme.groups[g]);
        if (!(has_field || holds) || std::ranges::all_of(couplers[k].between, is_in)) continue;
        all.push_back(scheme);
        all.back().stabilizations[g] = name;
      }
    }
  }
  return all;
}

/// Whether all unknowns of a group are on interfaces.
bool is_on_interfaces(const Model& model, const Group& group) {
  return std::ranges::none_of(model.fields().all(), [&](const auto& field) {
    return is_bulk(field->spec().role.kind()) &&
           std::ranges::any_of(group, [&](const std::string& component) { return is_unknown_of(*field, component); });
  });
}

/// The unit of a component's cumulative balance: what it conserves; or nothing.
std::string conserved_unit(const Model& model, const std::string& component) {
  for (const auto& field : model.fields().all())
    if (const FieldSpec& spec = field->spec(); spec.owner == component && spec.is_amount && !spec.accepted_with.empty())
      return spec.unit;
  return "";
}

/// Whether a group with unknowns of the bulk has a balance on interfaces, of what waiting unknowns of the bulk
/// conserve as well: only what interfaces store determines it then, unless these unknowns answer.
bool has_balance_apart(const Model& model, const Group& group) {
  const auto is_in_group = [&](const std::string& component) { return std::ranges::count(group, component) > 0; };
  return std::ranges::any_of(group, [&](const std::string& one) {
    const std::string unit = conserved_unit(model, one);
    if (unit.empty() || !is_on_interfaces(model, {one})) return false;
    bool waits = false, is_solved = false;
    for (const auto& other : model.components()) {
      if (conserved_unit(model, other->name()) != unit || is_on_interfaces(model, {other->name()})) continue;
      (is_in_group(other->name()) ? is_solved : waits) = true;
    }
    return waits && !is_solved;
  });
}

/// Whether components that need others are solved with them, or in a group that has a response.
bool are_determined(const Model& model, const Scheme& scheme) {
  for (std::size_t g = 0; g < scheme.groups.size(); ++g) {
    if (scheme.stabilization(g) == response) continue;
    const auto is_in = [&](const std::string& component) {
      return std::ranges::count(scheme.groups[g], component) > 0;
    };
    for (const Part* part : model.parts())
      for (const Dependence& dependence : part->dependences())
        if (is_in(dependence.component) && !is_in(dependence.on)) return false;
  }
  return true;
}

std::vector<std::vector<Group>> partitions(const std::vector<Group>& atoms) {
  std::vector<std::vector<Group>> all;
  std::vector<Group> begin;
  partition(atoms, 0, begin, all);
  return all;
}

/// The orders of all partitions in which groups on interfaces alone, and those with a balance there apart from that
/// of the bulk, have the Schur complement of waiting unknowns.
std::vector<Scheme> with_responses(const Model& model) {
  std::vector<Scheme> all;
  for (const std::vector<Group>& groups : partitions(atoms(model, Apart::with_response))) {
    if (groups.size() == 1) continue;
    for (const std::vector<Group>& ordered : orders(groups)) {
      Scheme scheme;
      scheme.groups = ordered;
      for (std::size_t g = 0; g < ordered.size(); ++g)
        if (is_on_interfaces(model, ordered[g]) || has_balance_apart(model, ordered[g]))
          scheme.stabilizations[g] = response;
      // Where all groups are on interfaces, none of them has to wait for the bulk.
      const auto is_alone = [&](const Group& group) { return is_on_interfaces(model, group); };
      if (scheme.stabilizations.empty() || std::ranges::all_of(ordered, is_alone)) continue;
      if (are_determined(model, scheme)) all.push_back(std::move(scheme));
    }
  }
  return all;
}

}  // namespace

std::string Scheme::stabilization(std::size_t group) const {
  const auto found = stabilizations.find(group);
  return found == stabilizations.end() ? "" : found->second;
}

std::string Scheme::all_stabilizations() const {
  std::vector<std::string> names;
  for (const auto& [group, name] : stabilizations)
    if (std::ranges::count(names, name) == 0) names.push_back(name);
  std::ranges::sort(names);
  return joined(names, ", ");
}

std::string Scheme::name() const {
  std::string text = is_jacobi ? "jacobi-" : "";
  for (std::size_t g = 0; g < groups.size(); ++g) text += (g > 0 ? "-" : "") + joined(groups[g], "_");
  if (!stabilizations.empty()) text += "=" + word_of(all_stabilizations());
  if (!acceleration.empty()) text += "=" + word_of(acceleration);
  return text;
}

std::string Scheme::split() const {
  std::string text;
  for (std::size_t g = 0; g < groups.size(); ++g) {
    if (g > 0) text += is_jacobi ? " ‖ " : " → ";
    text += joined(groups[g], " ");
    if (stabilizations.contains(g)) text += " (" + stabilization(g) + ")";
  }
  return text;
}

std::string Scheme::whole_name() const {
  std::string text = Scheme{groups, is_jacobi, {}, ""}.split();
  if (!stabilizations.empty()) text += ", " + all_stabilizations();
  return acceleration.empty() ? text : text + ", " + acceleration;
}

bool Scheme::is_called(const std::string& text) const {
  const auto alike = [](std::string name) {
    for (std::size_t at = name.find("->"); at != std::string::npos; at = name.find("->")) name.replace(at, 2, "→");
    std::ranges::replace(name, '_', ' ');
    return name;
  };
  return std::ranges::any_of(std::vector{name(), split(), whole_name()},
                             [&](const std::string& its) { return alike(its).find(alike(text)) != std::string::npos; });
}

std::string Scheme::schedule(double until, int at_most, const std::vector<std::string>& behind) const {
  std::string solves;
  for (std::size_t g = 0; g < groups.size(); ++g) {
    solves += (g > 0 ? ", {solve: [" : "{solve: [") + joined(groups[g], ", ") + "]";
    if (stabilizations.contains(g)) solves += ", stabilize: " + stabilization(g);
    solves += "}";
  }
  if (!is_monolithic())
    solves = fmt::format(
        "{{iterate: {{until: {{relative: {}, at_most: {}}}, fallback: none, order: {}, accelerate: {{{}}}, "
        "steps: [{}]}}}}",
        until, at_most, is_jacobi ? "jacobi" : "gauss_seidel", acceleration, solves);
  for (const std::string& step : behind) solves += ", " + step;
  return "[" + solves + "]";
}

std::vector<Scheme> sensible_schemes(const Model& model, const std::vector<std::string>& accelerations) {
  std::vector<Scheme> splits, all;
  for (const std::vector<Group>& groups : partitions(atoms(model, Apart::as_they_are))) {
    if (groups.size() == 1) {
      all.emplace_back().groups = groups;
      continue;
    }
    std::vector<Scheme> of_partition;
    for (const std::vector<Group>& ordered : orders(groups)) of_partition.emplace_back().groups = ordered;
    of_partition.emplace_back().groups = groups;
    of_partition.back().is_jacobi = true;
    for (const Scheme& scheme : of_partition) {
      splits.push_back(scheme);
      const std::vector<Scheme> more = stabilized(model, scheme);
      splits.insert(splits.end(), more.begin(), more.end());
    }
  }
  for (const Scheme& scheme : with_responses(model)) {
    splits.push_back(scheme);
    const std::vector<Scheme> more = stabilized(model, scheme);
    splits.insert(splits.end(), more.begin(), more.end());
  }
  for (const Scheme& split : splits)
    for (const std::string& acceleration : accelerations) {
      all.push_back(split);
      all.back().acceleration = acceleration;
    }
  return all;
}

}  // namespace sprekk
