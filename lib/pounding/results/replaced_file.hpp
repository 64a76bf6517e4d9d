#pragma once
/// Replaces a file as a whole, so that a kill at any moment leaves the earlier or the new one.

#include <cstddef>
#include <span>
#include <string>
#include <utility>

namespace pounding {

/// A file descriptor, closed with this object.
class Descriptor {
 public:
  Descriptor() = default;
  explicit Descriptor(int number) : number_(number) {}
  Descriptor(Descriptor&& other) noexcept : number_(std::exchange(other.number_, -1)) {}
  Descriptor& operator=(Descriptor&& other) noexcept {
    std::swap(number_, other.number_);
    return *this;
  }
  ~Descriptor();
  bool is_open() const { return number_ >= 0; }
  operator int() const { return number_; }

 private:
  int number_ = -1;
};

/// A results file that one process replaces, again and again. From its first `replace` until this object goes, other processes and
/// other objects are refused there; readers are not. The kernel frees the place when the process dies.
class ReplacedFile {
 public:
  explicit ReplacedFile(std::string path) : path_(std::move(path)) {}

  /// Throws InputError where `replace` would refuse the path as it is now.
  void require_free() const;
  /// Writes `bytes` to a temporary file in the directory of the path (named `.NAME.HOST.PROCESS.tmp`), brings it to the disk and
  /// renames it; a symbolic link is followed and stays. Temporary files of processes of this host that no longer run are removed.
  ///
  /// Throws InputError, with the earlier file untouched, when the path is a directory or another thing that is not a file, is
  /// write-protected, holds something else than results of pounding, is written by another run, or cannot be written. Where the
  /// folder cannot be brought to the disk the new file is there, and InputError says that a power failure may take it back.
  void replace(std::span<const std::byte> bytes);

 private:
  std::string path_;
  Descriptor written_;  // the file that this object wrote last, held by a lock
};

}  // namespace pounding
