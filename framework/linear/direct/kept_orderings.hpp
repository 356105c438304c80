// Orderings of direct solvers that outlive their solvers.
#pragma once

namespace sprekk {

/// While an object of this class lives, orderings of small systems are shared by later solvers, since the systems of
/// models on meshes of one topology have one pattern. An ordering follows from the pattern alone, so solutions keep
/// their bits. Only on one process, and for one thread.
class KeptOrderings {
 public:
  KeptOrderings();
  ~KeptOrderings();
  KeptOrderings(const KeptOrderings&) = delete;
  KeptOrderings& operator=(const KeptOrderings&) = delete;
};

}  // namespace sprekk
