#pragma once
/// A results file in memory.

#include <cstddef>
#include <memory>
#include <utility>

namespace pounding {

/// Immutable bytes of a whole file. Copies share them. A contiguous range that converts to `std::span<const
/// std::byte>`.
class FileImage {
 public:
  FileImage() = default;
  /// `bytes` holds at least `size` bytes.
  FileImage(std::shared_ptr<const std::byte> bytes, std::size_t size) : bytes_(std::move(bytes)), size_(size) {}

  /// True if the file is empty.
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
