// The bytes of a mesh file, read from front to back.
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>

namespace sprekk {

/// Reads one value after the other, and never beyond the end. A value that is missing or malformed is an InputError
/// that begins with the place: "line 12: …" in text files, "byte 345: …" in binary ones.
class MshCursor {
 public:
  /// `bytes` must outlive the cursor.
  explicit MshCursor(std::string_view bytes) : bytes_(bytes) {}

  void set_binary(bool is_binary) { is_binary_ = is_binary; }
  bool is_binary() const { return is_binary_; }
  std::size_t position() const { return at_; }
  std::size_t remaining() const { return bytes_.size() - at_; }

  /// Values of a section, binary or as text. `what` is their name in messages.
  int integer(const char* what);
  std::uint64_t number(const char* what);  ///< of a node or an element, or a count, in files of version 4.1
  double real(const char* what);           ///< finite
  /// The count of the following items, each of at least `least_bytes`. Throws InputError when the rest of the file
  /// cannot hold so many.
  std::size_t count(const char* what, std::size_t least_bytes, bool is_wide);
  /// The same in files of version 4.1, for items that take at least least_bytes(binary, values).
  std::size_t wide_count(const char* what, std::size_t binary, std::size_t values);
  /// The smallest number of bytes that `values` values take: `binary` in a binary file, two for each value in a text.
  std::size_t least_bytes(std::size_t binary, std::size_t values) const { return is_binary_ ? binary : 2 * values; }

  /// Reads values that are text also in binary files.
  int text_integer(const char* what);
  std::string_view word(const char* what);  ///< up to the next blank or line break
  std::string_view rest_of_line();          ///< moves to the start of the next line
  void skip_blanks();                       ///< line breaks as well
  /// Moves behind the next occurrence of `text`; returns false, without a move, if there is none.
  bool skip_past(std::string_view text);

  [[noreturn]] void fail(const std::string& problem) const { fail_at(at_, problem); }
  [[noreturn]] void fail_at(std::size_t position, const std::string& problem) const;

 private:
  template <class Value>
  Value raw(const char* what);
  template <class Value>
  Value whole(const char* what);
  std::string_view bytes_;
  std::size_t at_ = 0;
  bool is_binary_ = false;
};

}  // namespace sprekk
