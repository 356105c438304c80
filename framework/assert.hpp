// Assertions: mistakes of the program end it where they are made, in builds that look for them.
#pragma once

// SPREKK_ASSERT(condition, values…): an invariant that this code keeps by itself.
// SPREKK_EXPECT(condition, values…): a precondition that a caller has to keep.
//
// In debug and sanitizer builds (SPREKK_ASSERTIONS, set by CMake) a condition that is false ends the program with a
// message: what kind of mistake, the expression, the values that were named, file and line. In other builds nothing is
// evaluated. What a user can cause is no assertion: it has a message of its own in every build.
//
//   SPREKK_EXPECT(cell >= 0 && cell < mesh.cell_count(), cell, mesh.cell_count());

#ifdef SPREKK_ASSERTIONS

#include <cstdlib>
#include <iostream>
#include <sstream>
#include <string>

namespace sprekk::assertions {

/// "", or " (names = value, value)".
template <class... Values>
std::string described(const char* names, const Values&... values) {
  if constexpr (sizeof...(values) == 0) {
    return "";
  } else {
    std::ostringstream text;
    text.precision(17);
    const char* between = "";
    text << " (" << names << " = ";
    ((text << between << values, between = ", "), ...);
    text << ")";
    return text.str();
  }
}

[[noreturn]] inline void fail(const char* kind, const char* condition, const std::string& values, const char* file,
                              int line) {
  std::cerr << file << ":" << line << ": " << kind << ": " << condition << values << std::endl;
  std::abort();
}

}  // namespace sprekk::assertions

#define SPREKK_CHECK_(kind, condition, ...)                                                                           \
  ((condition) ? static_cast<void>(0)                                                                                 \
               : ::sprekk::assertions::fail(kind, #condition,                                                         \
                                            ::sprekk::assertions::described(#__VA_ARGS__ __VA_OPT__(, ) __VA_ARGS__), \
                                            __FILE__, __LINE__))
#define SPREKK_ASSERT(condition, ...) SPREKK_CHECK_("a broken invariant", condition __VA_OPT__(, ) __VA_ARGS__)
#define SPREKK_EXPECT(condition, ...) SPREKK_CHECK_("a broken precondition", condition __VA_OPT__(, ) __VA_ARGS__)

#else

// The operand of sizeof is not evaluated, and what stands in it counts as used.
#define SPREKK_UNEVALUATED_(condition) static_cast<void>(sizeof((condition) ? 1 : 0))
#define SPREKK_ASSERT(condition, ...) SPREKK_UNEVALUATED_(condition)
#define SPREKK_EXPECT(condition, ...) SPREKK_UNEVALUATED_(condition)

#endif
