#include "framework/config/number.hpp"

#include <cctype>
#include <charconv>
#include <cmath>

namespace sprekk {

std::optional<LeadingNumber> leading_number(const std::string& text) {
  std::size_t begin = !text.empty() && text[0] == '+' ? 1 : 0;
  const bool two_signs = begin == 1 && text.size() > 1 && (text[1] == '-' || text[1] == '+');
  if (two_signs) return std::nullopt;
  // YAML's own spellings of what is not finite.
  const std::size_t digits = begin < text.size() && text[begin] == '-' ? begin + 1 : begin;
  for (const char* special : {".inf", ".Inf", ".INF", ".nan", ".NaN", ".NAN"}) {
    if (text.compare(digits, 4, special) == 0) return LeadingNumber{NAN, digits + 4, false};
  }
  LeadingNumber number;
  const auto [end, error] = std::from_chars(text.data() + begin, text.data() + text.size(), number.value);
  if (error == std::errc::invalid_argument) return std::nullopt;
  number.length = static_cast<std::size_t>(end - text.data());
  number.is_finite = error == std::errc{} && std::isfinite(number.value);
  // "inf" and "nan" are numbers to from_chars, but "info" and "nano" are not.
  const bool is_word = std::isalpha(static_cast<unsigned char>(text[number.length - 1])) != 0;
  if (is_word && number.length < text.size() && std::isalnum(static_cast<unsigned char>(text[number.length])) != 0) {
    return std::nullopt;
  }
  return number;
}

std::string with_exponent_e(const std::string& text) {
  const auto number = leading_number(text);
  if (!number || number->length + 1 >= text.size() || std::tolower(text[number->length]) != 'd') return "";
  const std::size_t sign = number->length + 1, digit = text[sign] == '-' || text[sign] == '+' ? sign + 1 : sign;
  if (digit >= text.size() || std::isdigit(static_cast<unsigned char>(text[digit])) == 0) return "";
  std::string other = text;
  other[number->length] = 'e';
  return other;
}

std::string trimmed(const std::string& text) {
  const std::size_t begin = text.find_first_not_of(" \t\r\n");
  if (begin == std::string::npos) return "";
  return text.substr(begin, text.find_last_not_of(" \t\r\n") - begin + 1);
}

}  // namespace sprekk
