// What the physics calls the medium that is meshed.
#pragma once

#include <string>

namespace sprekk {

/// "rock", say: for messages, and the name of the region that no other one covers. "medium" unless a physics that is
/// linked to the program has named it.
const std::string& medium_name();

/// Names the medium before main begins:
///
///   const RegisterMedium registration("rock");
///
/// Throws std::logic_error when it has another name already.
struct RegisterMedium {
  explicit RegisterMedium(const std::string& name);
};

}  // namespace sprekk
