#pragma once
/// A results file in memory, and the state in it from which an interrupted run resumes.

#include <cstddef>
#include <memory>
#include <string>
#include <utility>
#include <vector>

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

/// State between two steps, and everything that must be unchanged for bitwise identical results after a resume.
struct Checkpoint {
  std::string model_file;            ///< absolute path of the input; relative paths in the input start from its folder
  std::vector<std::string> options;  ///< PETSc options that change the results, sorted: "-pounding_ts_rtol 1e-6"
  std::string ground;                ///< checksum of the record's samples; empty for a closed form
  std::vector<std::byte> state;      ///< stepper, TS and recorder of every process (Archive)
};

}  // namespace pounding
