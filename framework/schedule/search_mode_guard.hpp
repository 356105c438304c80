// Sets the search mode of parts for as long as an object lives.
#pragma once

#include <vector>

#include "framework/assembly/part.hpp"

namespace sprekk {

/// A guard: its constructor gives all parts the mode `mode`, its destructor the mode `after`.
class SearchModeGuard {
 public:
  SearchModeGuard(SearchMode mode, SearchMode after, const std::vector<Part*>& parts) : after_(after), parts_(parts) {
    for (Part* part : parts_) part->set_search_mode(mode);
  }
  ~SearchModeGuard() {
    for (Part* part : parts_) part->set_search_mode(after_);
  }
  SearchModeGuard(const SearchModeGuard&) = delete;
  SearchModeGuard& operator=(const SearchModeGuard&) = delete;

 private:
  SearchMode after_;
  const std::vector<Part*>& parts_;
};

}  // namespace sprekk
