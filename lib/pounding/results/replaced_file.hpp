#pragma once
/// Atomic replacement of a file: a kill at any time leaves either the earlier or the new one.

#include <cstddef>
#include <span>
#include <string>
#include <string_view>
#include <utility>

namespace pounding {

/// An owning file descriptor.
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
  bool (*recognises)(std::string_view start);  ///< true if an existing file with these first bytes is of this kind
};

/// Results of runs.
extern const FileKind results_files;
/// Pictures in any format that Python writes.
extern const FileKind picture_files;
/// Reports of runs, PDF or HTML.
extern const FileKind run_report_files;

/// A file that one process replaces repeatedly. From the first `replace` to the destruction of this object, it is
/// locked against other writers, but not against readers. The kernel releases the lock if the process dies.
class ReplacedFile {
 public:
  explicit ReplacedFile(std::string path, const FileKind& kind = results_files) : path_(std::move(path)), kind_(kind) {}

  /// Throws InputError if `replace` would currently refuse the path.
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
  Descriptor written_;  // last file written by this object, locked
};

}  // namespace pounding
