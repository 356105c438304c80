// What is said between this program and another one: a word, and named lists of numbers or texts.
#pragma once

#include <string>
#include <utility>
#include <vector>

#include "framework/types.hpp"

namespace sprekk {

/// A message. In bytes it is one line "WORD COUNT\n" and COUNT items. An item is one line "NAME TYPE SIZE\n" and SIZE
/// values: TYPE is real (8 bytes each), int (4 bytes each) or text (1 byte each), all as the machine has them. Names
/// are without spaces.
struct OutsideMessage {
  std::string word;
  std::vector<std::pair<std::string, Vector>> reals = {};
  std::vector<std::pair<std::string, std::vector<int>>> ints = {};
  std::vector<std::pair<std::string, std::string>> texts = {};

  const Vector* real(const std::string& name) const;  ///< nullptr where there is none
  const std::vector<int>* integers(const std::string& name) const;
  const std::string* text(const std::string& name) const;
  std::string bytes() const;
};

/// A message while its bytes arrive.
class ArrivingMessage {
 public:
  /// Takes bytes that have arrived. Throws OutsideError for what is no message.
  void take(const char* bytes, std::size_t count);
  bool is_complete();
  const OutsideMessage& message() const { return message_; }

 private:
  bool take_line(std::string& line);
  bool take_item();

  std::string bytes_;
  std::size_t at_ = 0;
  bool has_word_ = false;
  long left_ = 0;  ///< items that have not arrived
  OutsideMessage message_;
};

}  // namespace sprekk
