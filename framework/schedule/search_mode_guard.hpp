// Sets the search mode of parts for as long as an object lives.
#pragma once

#include <vector>

#include "framework/assembly/piecewise_smooth.hpp"

namespace sprekk {

/// A guard: its constructor gives all parts the mode `mode`, its destructor the mode `after`.
class SearchModeGuard {
 public:
  SearchModeGuard(SearchMode mode, SearchMode after, const std::vector<PiecewiseSmooth*>& parts)
      : after_(after), parts_(parts) {
    for (PiecewiseSmooth* part : parts_) part->set_search_mode(mode);
  }
  ~SearchModeGuard() {
    for (PiecewiseSmooth* part : parts_) part->set_search_mode(after_);
  }
  SearchModeGuard(const SearchModeGuard&) = delete;
  SearchModeGuard& operator=(const SearchModeGuard&) = delete;

 private:
  SearchMode after_;
  const std::vector<PiecewiseSmooth*>& parts_;
};

}  // namespace sprekk
