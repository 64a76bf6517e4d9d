#include <pounding/results/replace_file.hpp>

#include <fcntl.h>
#include <signal.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <charconv>
#include <filesystem>
#include <fstream>
#include <string_view>
#include <system_error>

#include <pounding/core/error.hpp>

namespace pounding {
namespace {

namespace fs = std::filesystem;

[[noreturn]] void refuse(const std::string& path, const std::string& reason, const std::string& advice) {
  throw InputError("cannot write \"" + path + "\": " + reason + ". " + advice);
}

std::string reason(int error) { return std::generic_category().message(error); }

/// Only empty files and earlier results are replaced, never a model or a record; HDF5 files start with these eight bytes.
bool may_be_replaced(const fs::path& path) {
  static constexpr std::array<char, 8> signature = {'\x89', 'H', 'D', 'F', '\r', '\n', '\x1a', '\n'};
  std::array<char, 8> start{};
  std::ifstream file(path, std::ios::binary);
  file.read(start.data(), start.size());
  return file.gcount() == 0 || (file.gcount() == 8 && start == signature);
}

/// Resolves a symbolic link, which stays a link. Refuses everything that a rename would destroy in silence.
fs::path destination(const std::string& path) {
  if (path.empty()) refuse(path, "the name is empty", "Name a file: -o results.h5");
  std::error_code error;
  const fs::file_status status = fs::status(path, error);
  if (fs::is_directory(status)) refuse(path, "it is a directory", "Name a file in it: -o " + path + "/results.h5");
  if (!fs::exists(status)) return path;
  if (!fs::is_regular_file(status)) refuse(path, "it is not a regular file", "Name a file: -o results.h5");
  if (access(path.c_str(), W_OK) != 0) refuse(path, reason(errno), "Name another file: -o results.h5");
  if (!may_be_replaced(path))
    refuse(path, "a file of this name exists and holds no results", "Name another file: -o results.h5");
  return fs::canonical(path);
}

/// Removes the temporary files of killed processes, as far as possible.
void remove_leftovers(const fs::path& directory, const std::string& prefix, std::string_view suffix) {
  std::error_code error;
  for (fs::directory_iterator entry(directory, error), end; !error && entry != end; entry.increment(error)) {
    const std::string name = entry->path().filename().string();
    if (name.size() <= prefix.size() + suffix.size() || !name.starts_with(prefix) || !name.ends_with(suffix)) continue;
    const char* digits_end = name.data() + name.size() - suffix.size();
    pid_t process = 0;
    const auto parsed = std::from_chars(name.data() + prefix.size(), digits_end, process);
    if (parsed.ec != std::errc{} || parsed.ptr != digits_end || process <= 0) continue;
    std::error_code ignored;
    if (kill(process, 0) != 0 && errno == ESRCH) fs::remove(entry->path(), ignored);
  }
}

/// Returns 0 or the error number.
int write_all(int descriptor, std::span<const std::byte> bytes) {
  while (!bytes.empty()) {
    const ssize_t written = write(descriptor, bytes.data(), bytes.size());
    if (written >= 0) {
      bytes = bytes.subspan(static_cast<std::size_t>(written));
    } else if (errno != EINTR) {
      return errno;
    }
  }
  return fsync(descriptor) == 0 ? 0 : errno;
}

}  // namespace

void replace_file(const std::string& path, std::span<const std::byte> bytes) {
  const fs::path place = destination(path);
  const fs::path directory = place.has_parent_path() ? place.parent_path() : fs::path(".");
  const std::string prefix = std::string(".").append(place.filename().string()).append(".");
  const std::string_view suffix = ".tmp";
  remove_leftovers(directory, prefix, suffix);

  const fs::path temporary = directory / (prefix + std::to_string(getpid()) + std::string(suffix));
  const int descriptor = open(temporary.c_str(), O_WRONLY | O_CREAT | O_TRUNC | O_CLOEXEC, 0666);
  if (descriptor < 0) {
    refuse(path, reason(errno),
           "Name a file in an existing directory that you may write to: -o results.h5, or first type: mkdir -p " +
               directory.string());
  }
  int error = write_all(descriptor, bytes);
  if (close(descriptor) != 0 && error == 0) error = errno;
  if (error == 0 && rename(temporary.c_str(), place.c_str()) != 0) error = errno;
  if (error != 0) {
    unlink(temporary.c_str());
    refuse(path, reason(error), "Make room, or name a file on another disk: -o /other/disk/results.h5");
  }
}

}  // namespace pounding
