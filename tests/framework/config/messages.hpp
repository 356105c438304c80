// What the tests of wrong input share.
#pragma once

#include <stdexcept>
#include <string>

#include "framework/config/input_error.hpp"

namespace sprekk {

/// The message of the InputError that `action` throws; "no error" when it throws none.
template <class Action>
std::string input_error_of(const Action& action) {
  try {
    action();
  } catch (const InputError& error) {
    return error.what();
  }
  return "no error";
}

/// The message of the std::runtime_error that `action` throws and that is no InputError.
template <class Action>
std::string runtime_error_of(const Action& action) {
  try {
    action();
  } catch (const InputError& error) {
    return std::string("an input error: ") + error.what();
  } catch (const std::runtime_error& error) {
    return error.what();
  }
  return "no error";
}

}  // namespace sprekk
