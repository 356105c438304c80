// The kinds of laws, for commands that list them.
#pragma once

#include <string>
#include <utility>
#include <vector>

namespace sprekk {

/// Names, each with what it stands for.
using NamesWithDocs = std::vector<std::pair<std::string, std::string>>;

/// Laws among which a scene chooses.
struct LawKind {
  std::string name;  ///< "closure"
  std::string key;   ///< how a scene chooses one, "closure: {law: NAME}"
  NamesWithDocs (*laws)();
};

/// All kinds of laws.
std::vector<LawKind>& law_kinds();

/// Registers a kind when it is constructed.
struct RegisterLawKind {
  explicit RegisterLawKind(LawKind kind);
};

}  // namespace sprekk
