// A gmsh model that lives as long as this object. Callers include gmsh.h themselves, in .cpp files only.
#pragma once

#include <functional>
#include <string>

namespace sprekk {

/// Starts gmsh at the first use in a process (0.1 s) and leaves it running: nobody else may initialize or finalize it.
/// One model at a time; it is removed, with its size callback, at the end of life. Not for several threads.
class GmshModel {
 public:
  GmshModel();
  ~GmshModel();
  GmshModel(const GmshModel&) = delete;
  GmshModel& operator=(const GmshModel&) = delete;

  /// Calls `work`, which talks to gmsh. What gmsh throws (std::string) becomes a std::runtime_error
  /// "gmsh failed to <purpose> (<gmsh's words>)".
  void run(const std::string& purpose, const std::function<void()>& work) const;
};

}  // namespace sprekk
