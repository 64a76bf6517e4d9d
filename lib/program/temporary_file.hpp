#pragma once
/// Temporary files that pass data to Python.

#include <unistd.h>

#include <filesystem>
#include <fstream>
#include <string>

#include <pounding/core/error.hpp>

namespace pounding::program {

/// A temporary file, removed by the destructor.
class TemporaryFile {
 public:
  /// Throws InputError if no temporary file can be created.
  explicit TemporaryFile(const std::string& text) {
    std::error_code none;
    name_ = (std::filesystem::temp_directory_path(none) / "pounding-XXXXXX").string();
    const int file = mkstemp(name_.data());
    if (file < 0) throw InputError("no picture: " + name_ + " cannot be written. Set TMPDIR to a writable directory");
    close(file);
    std::ofstream stream(name_);
    stream << text;
    stream.close();
    if (!stream) {
      std::filesystem::remove(name_, none);
      throw InputError("no picture: " + name_ + " cannot be written. Set TMPDIR to a directory with free space");
    }
  }
  TemporaryFile(const TemporaryFile&) = delete;
  TemporaryFile& operator=(const TemporaryFile&) = delete;
  ~TemporaryFile() {
    std::error_code ignored;
    std::filesystem::remove(name_, ignored);
  }

  const std::string& name() const { return name_; }

 private:
  std::string name_;
};

}  // namespace pounding::program
