#pragma once
/// Replaces a file as a whole, so that a kill at any moment leaves the earlier or the new one.

#include <cstddef>
#include <span>
#include <string>
#include <string_view>
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

/// Files that may replace each other. An empty file may be replaced by any kind.
struct FileKind {
  std::string_view name;                       ///< for messages: "results of pounding"
  std::string_view example;                    ///< what to type: "-o results.h5"
  bool (*recognises)(std::string_view start);  ///< whether an existing file with these first bytes is of this kind
};

/// Results of runs.
extern const FileKind results_files;
/// Pictures of any format that Python writes.
extern const FileKind picture_files;

/// A file that one process replaces, again and again. From its first `replace` until this object goes, other processes
/// and other objects are refused there; readers are not. The kernel frees the place when the process dies.
class ReplacedFile {
 public:
  explicit ReplacedFile(std::string path, const FileKind& kind = results_files) : path_(std::move(path)), kind_(kind) {}

  /// Throws InputError where `replace` would refuse the path as it is now.
  void require_free() const;
  /// Writes `bytes` to the temporary file `.NAME.tmp` in the same directory, fsyncs it and renames it over the path.
  /// Symbolic links are followed, and the mode of an earlier file is kept.
  ///
  /// Throws InputError, with the earlier file untouched, if the path is not a regular file, is write-protected,
  /// contains data of another kind, is being written by another run, or cannot be written.
  void replace(std::span<const std::byte> bytes);

 private:
  std::string path_;
  const FileKind& kind_;
  Descriptor written_;  // the file that this object wrote last, held by a lock
};

}  // namespace pounding
