// Messages on keys that a map of a scene does not have.
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "framework/config/input_error.hpp"

namespace sprekk {

/// Says where a key belongs, as a sentence: "'every' belongs in 'output'", or "".
using PlaceOfKey = std::function<std::string(const std::string& key)>;

/// A guard: while it exists, messages on unknown keys say where these belong.
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

/// Adds advice to the message on a key that users may write in the maps of a spec although these do not have it.
void write_instead(const std::string& spec, const std::string& key, const std::string& advice);

/// The advice that write_instead was given, or "".
std::string instead_of_key(const std::string& spec, const std::string& key);

/// As unknown_name, for a key: the message says also where the key belongs.
InputError unknown_key(const Origin& where, const std::string& what, const std::string& key,
                       const std::vector<std::string>& allowed);

/// The suggestion for an unknown name: those of the known ones that may be meant, and where the name belongs ("" for
/// nothing).
std::string name_advice(const std::string& word, const std::vector<std::string>& known, const std::string& belongs);

/// A guard: while it exists, the parameter of this name is being read.
class ReadsParameter {
 public:
  explicit ReadsParameter(const std::string& name);
  ~ReadsParameter();
  ReadsParameter(const ReadsParameter&) = delete;
  ReadsParameter& operator=(const ReadsParameter&) = delete;

 private:
  const std::string* before_;
};

/// Names the specs whose parameter, of the same name as the one that is being read, may be a formula of this variable:
/// "a formula of 'p' is taken as 'permeability' by …, and not here"; "" if there are none.
std::string formula_takers(const std::string& variable);

}  // namespace sprekk
