// Messages on keys that a map of a scene does not have.
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "framework/config/input_error.hpp"

namespace sprekk {

/// Says where a key belongs, as a sentence: "'every' belongs in 'output'", or "".
using PlaceOfKey = std::function<std::string(const std::string& key)>;

/// While it lives, messages on unknown keys say where these belong.
class KnownPlaces {
 public:
  explicit KnownPlaces(PlaceOfKey place);
  ~KnownPlaces();
  KnownPlaces(const KnownPlaces&) = delete;
  KnownPlaces& operator=(const KnownPlaces&) = delete;

 private:
  PlaceOfKey before_;
};

/// What is known of the place of a key, or "".
std::string place_of_key(const std::string& key);

/// Lets messages say what to write instead of a key that users look for in the maps of a spec, and which these do not
/// have.
void write_instead(const std::string& spec, const std::string& key, const std::string& advice);

/// What has been said by write_instead, or "".
std::string instead_of_key(const std::string& spec, const std::string& key);

/// As unknown_name, for a key: the message says also where the key belongs.
InputError unknown_key(const Origin& where, const std::string& what, const std::string& key,
                       const std::vector<std::string>& allowed);

/// The suggestion for an unknown name: those of the known ones that may be meant, and where the name belongs ("" for
/// nothing).
std::string name_advice(const std::string& word, const std::vector<std::string>& known, const std::string& belongs);

}  // namespace sprekk
