#include "framework/report/base64.hpp"

namespace sprekk {

std::string base64(std::span<const unsigned char> bytes) {
  static const char letters[] = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  std::string text;
  text.reserve((bytes.size() + 2) / 3 * 4);
  for (std::size_t i = 0; i < bytes.size(); i += 3) {
    const std::size_t left = bytes.size() - i;
    const unsigned group = (bytes[i] << 16U) | ((left > 1 ? bytes[i + 1] : 0U) << 8U) | (left > 2 ? bytes[i + 2] : 0U);
    for (unsigned k = 0; k < 4; ++k) text += k <= left ? letters[(group >> (18 - 6 * k)) & 63U] : '=';
  }
  return text;
}

}  // namespace sprekk
