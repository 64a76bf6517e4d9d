#pragma once
/// A results file in memory.

#include <cstddef>
#include <memory>
#include <utility>

namespace pounding {

/// The bytes of a whole file, which do not change any more. Copies share them. A range: it is given where a
/// `std::span<const std::byte>` is asked for.
class FileImage {
 public:
  FileImage() = default;
  /// `bytes` holds `size` bytes or more.
  FileImage(std::shared_ptr<const std::byte> bytes, std::size_t size) : bytes_(std::move(bytes)), size_(size) {}

  /// Whether there is no file.
  bool empty() const { return size_ == 0; }
  /// Number of bytes, and the first of them.
  std::size_t size() const { return size_; }
  const std::byte* data() const { return bytes_.get(); }
  /// For loops over the bytes.
  const std::byte* begin() const { return data(); }
  const std::byte* end() const { return data() + size_; }

 private:
  std::shared_ptr<const std::byte> bytes_;
  std::size_t size_ = 0;
};

}  // namespace pounding
