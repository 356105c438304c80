// Binary data in text (RFC 4648).
#pragma once

#include <span>
#include <string>
#include <vector>

namespace sprekk {

/// Four letters for each three bytes, padded with =.
std::string base64(std::span<const unsigned char> bytes);

/// The bytes of an array in the order of memory.
template <class Value>
std::string base64_of(const std::vector<Value>& values) {
  return base64({reinterpret_cast<const unsigned char*>(values.data()), values.size() * sizeof(Value)});
}

}  // namespace sprekk
