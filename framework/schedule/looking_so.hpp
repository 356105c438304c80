// How parts support the search for a solution, for as long as an object lives.
#pragma once

#include <vector>

#include "framework/assembly/part.hpp"

namespace sprekk {

/// A guard: its constructor passes `look` to all parts, its destructor `after`.
class LookingSo {
 public:
  LookingSo(Look look, Look after, const std::vector<Part*>& parts) : after_(after), parts_(parts) {
    for (Part* part : parts_) part->look_for_solution(look);
  }
  ~LookingSo() {
    for (Part* part : parts_) part->look_for_solution(after_);
  }
  LookingSo(const LookingSo&) = delete;
  LookingSo& operator=(const LookingSo&) = delete;

 private:
  Look after_;
  const std::vector<Part*>& parts_;
};

}  // namespace sprekk
