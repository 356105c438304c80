// A gmsh model that lives as long as this object. Callers include gmsh.h themselves, in .cpp files only.
#pragma once

#include <functional>
#include <string>

namespace sprekk {

/// A guard for a model of gmsh. The first object in a process initializes gmsh (0.1 s), which stays initialized: no
/// other code may initialize or finalize gmsh. There may be one model at a time; the destructor removes it with its
/// size callback. Not thread-safe.
class GmshModel {
 public:
  GmshModel();
  ~GmshModel();
  GmshModel(const GmshModel&) = delete;
  GmshModel& operator=(const GmshModel&) = delete;

  /// Calls `work`, which uses gmsh. An exception of gmsh (std::string) becomes a std::runtime_error
  /// "gmsh failed to <purpose> (<gmsh's words>)".
  void run(const std::string& purpose, const std::function<void()>& work) const;
};

}  // namespace sprekk
