#include "framework/config/unknown_key.hpp"

#include <map>
#include <utility>

namespace sprekk {
namespace {

PlaceOfKey& current() {
  static PlaceOfKey place;
  return place;
}

std::map<std::pair<std::string, std::string>, std::string>& advice_on_keys() {
  static std::map<std::pair<std::string, std::string>, std::string> advice;
  return advice;
}

}  // namespace

void write_instead(const std::string& spec, const std::string& key, const std::string& advice) {
  advice_on_keys()[{spec, key}] = advice;
}

std::string instead_of_key(const std::string& spec, const std::string& key) {
  const auto found = advice_on_keys().find({spec, key});
  return found == advice_on_keys().end() ? "" : found->second;
}

KnownPlaces::KnownPlaces(PlaceOfKey place) : before_(std::exchange(current(), std::move(place))) {}

KnownPlaces::~KnownPlaces() { current() = std::move(before_); }

std::string place_of_key(const std::string& key) { return current() ? current()(key) : ""; }

InputError unknown_key(const Origin& where, const std::string& what, const std::string& key,
                       const std::vector<std::string>& allowed) {
  return InputError(where, "unknown " + what + " " + quoted(key),
                    allowed.empty() ? "there is none" : "it is not one of: " + listed(allowed),
                    name_advice(key, allowed, place_of_key(key)));
}

}  // namespace sprekk
