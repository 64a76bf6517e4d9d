#pragma once
/// Tells whether data have changed.

#include <cstddef>
#include <cstdint>
#include <cstring>
#include <string>
#include <string_view>
#include <vector>

#include <fmt/format.h>

namespace pounding {

/// A 64-bit number that follows from everything that was added, in its order. One changed bit always changes it, other
/// damage nearly always; it does not resist intention.
class Checksum {
 public:
  /// Adds bytes, their number included.
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
  /// In hexadecimal.
  std::string text() const { return fmt::format("{:016x}", value_); }

 private:
  // Both steps can be undone, so that two different words never give the same number. Constants of FNV-1a.
  void mix(std::uint64_t word) {
    value_ = (value_ ^ word) * 0x100000001b3;
    value_ ^= value_ >> 32;
  }
  std::uint64_t value_ = 0xcbf29ce484222325;
};

}  // namespace pounding
