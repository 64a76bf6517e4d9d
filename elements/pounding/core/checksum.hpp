#pragma once
/// Checksum that detects changed data.

#include <cstddef>
#include <cstdint>
#include <cstring>
#include <string>
#include <string_view>
#include <vector>

#include <fmt/format.h>

namespace pounding {

/// 64-bit number of all added data, in their order. A single changed bit always changes it, other damage almost always;
/// it does not protect against deliberate changes.
class Checksum {
 public:
  /// Adds the number of bytes and the bytes.
  void add(const void* data, std::size_t size) {
    mix(size);
    const auto* bytes = static_cast<const unsigned char*>(data);
    for (; size > 0;) {
      const std::size_t taken = size < sizeof(std::uint64_t) ? size : sizeof(std::uint64_t);
      std::uint64_t word = 0;
      std::memcpy(&word, bytes, taken);
      mix(word);
      bytes += taken;
      size -= taken;
    }
  }
  void add(std::string_view text) { add(text.data(), text.size()); }
  template <class T>
    requires std::is_trivially_copyable_v<T>
  void add(const std::vector<T>& values) {
    add(values.data(), sizeof(T) * values.size());
  }
  /// The value in hexadecimal.
  std::string text() const { return fmt::format("{:016x}", value_); }

 private:
  // Both operations are invertible, so different inputs never yield the same value. Constants of FNV-1a.
  void mix(std::uint64_t word) {
    value_ = (value_ ^ word) * 0x100000001b3;
    value_ ^= value_ >> 32;
  }
  std::uint64_t value_ = 0xcbf29ce484222325;
};

}  // namespace pounding
