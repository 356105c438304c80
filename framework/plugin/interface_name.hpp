// The name of the interface that plug-ins are compiled against. It holds the version, a hash of all public headers, the
// alignment of small matrices, and the dimension: a plug-in that was built for other ones is refused by the loader
// before any of its code runs.
#pragma once

#include <Eigen/Core>

#include "framework/plugin/interface_tag.hpp"
#include "framework/types.hpp"

#define SPREKK_JOIN_NAMES(a, b, c, n) a##b##_##c##_##n##d
#define SPREKK_JOIN(a, b, c, n) SPREKK_JOIN_NAMES(a, b, c, n)
/// The symbol that the program defines and that each plug-in asks for.
#define SPREKK_INTERFACE \
  SPREKK_JOIN(sprekk_interface_, SPREKK_INTERFACE_TAG, EIGEN_IDEAL_MAX_ALIGN_BYTES, SPREKK_DIMENSION)
#define SPREKK_TEXT_OF(name) #name
#define SPREKK_TEXT(name) SPREKK_TEXT_OF(name)
