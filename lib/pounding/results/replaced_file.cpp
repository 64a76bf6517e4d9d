#include <pounding/results/replaced_file.hpp>

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <filesystem>
#include <limits>
#include <system_error>

#include <pounding/core/error.hpp>
#include <pounding/results/checked_file.hpp>

namespace pounding {
namespace {

namespace fs = std::filesystem;

[[noreturn]] void refuse(const std::string& path, const std::string& reason, const std::string& advice) {
  throw InputError("cannot write \"" + path + "\": " + reason + ". " + advice);
}

[[noreturn]] void refuse_busy(const std::string& path) {
  refuse(path, "it is being written by another run", "Wait until it ends, or name another file: -o other.h5");
}

std::string other_name(const FileKind& kind) { return std::string("Name another file: ").append(kind.example); }
std::string file_name(const FileKind& kind) { return std::string("Name a file: ").append(kind.example); }

std::string reason(int error) { return std::generic_category().message(error); }

// The lock covers one byte that no file reaches, so it does not conflict with whole-file locks of HDF5 and other
// readers.
struct flock place_of_lock(short kind) {
  struct flock place = {};
  place.l_type = kind;
  place.l_whence = SEEK_SET;
  place.l_start = std::numeric_limits<off_t>::max() - 1;
  place.l_len = 1;
  return place;
}

// The lock belongs to an open file, not to a process, so two objects of one process exclude each other. False if
// another open file has the lock. On file systems without locks it always succeeds.
bool lock(const Descriptor& file) {
  struct flock place = place_of_lock(F_WRLCK);
  return fcntl(file, F_OFD_SETLK, &place) == 0 || (errno != EAGAIN && errno != EACCES);
}

bool is_locked(const Descriptor& file) {
  struct flock place = place_of_lock(F_WRLCK);
  return fcntl(file, F_OFD_GETLK, &place) == 0 && place.l_type != F_UNLCK;
}

bool is_same_file(const Descriptor& file, const fs::path& path) {
  struct stat open_one = {}, named = {};
  return fstat(file, &open_one) == 0 && stat(path.c_str(), &named) == 0 && open_one.st_ino == named.st_ino &&
         open_one.st_dev == named.st_dev;
}

bool is_results(std::string_view start) { return begins_results(std::as_bytes(std::span(start))); }

// As in python/pounding/_outputs.py.
bool is_picture(std::string_view start) {
  using namespace std::string_view_literals;
  constexpr std::array signatures{"\x89PNG"sv, "%PDF-"sv,        "GIF8"sv,
                                  "%!PS"sv,    "\xff\xd8\xff"sv, "RIFF"sv,
                                  "II*\0"sv,   "MM\0*"sv,        "%% Creator: Matplotlib"sv};
  if (std::any_of(signatures.begin(), signatures.end(), [&](std::string_view each) { return start.starts_with(each); }))
    return true;
  if (start.size() > 8 && start.substr(4, 4) == "ftyp") return true;
  return (start.starts_with("<?xml") || start.starts_with("<svg")) && start.find("<svg") != start.npos;
}

/// True for empty files and files of the same kind only, so models, records and other data are never overwritten.
bool may_be_replaced(const Descriptor& file, const FileKind& kind) {
  std::array<char, 4096> start{};
  const ssize_t count = pread(file, start.data(), start.size(), 0);
  return count == 0 || (count > 0 && kind.recognises({start.data(), static_cast<std::size_t>(count)}));
}

/// Target of a chain of symbolic links, which remain links; the target may not exist yet.
fs::path followed(const std::string& path, const FileKind& kind) {
  fs::path place = path;
  std::error_code error;
  for (int links = 0; fs::is_symlink(fs::symlink_status(place, error)); ++links) {
    if (links == 40) refuse(path, reason(ELOOP), file_name(kind));
    const fs::path target = fs::read_symlink(place, error);
    if (error) refuse(path, error.message(), file_name(kind));
    place = place.parent_path() / target;
  }
  return place;
}

/// Returns the file to replace. Throws InputError if its lock, content or type forbid it. `own` is the file last
/// written by this process.
fs::path destination(const std::string& path, const FileKind& kind, const Descriptor& own) {
  if (path.empty()) refuse(path, "the name is empty", file_name(kind));
  const fs::path place = followed(path, kind);
  std::error_code error;
  const fs::file_status status = fs::status(place, error);
  if (fs::is_directory(status)) {
    const std::string example(kind.example);
    const std::size_t name = example.rfind(' ') + 1;
    refuse(path, "it is a directory",
           "Name a file in it: " + example.substr(0, name) + path + "/" + example.substr(name));
  }
  if (!fs::exists(status)) return place;
  if (!fs::is_regular_file(status)) refuse(path, "it is not a regular file", file_name(kind));
  if (own.is_open() && is_same_file(own, place)) return place;
  if (access(place.c_str(), W_OK) != 0) refuse(path, reason(errno), other_name(kind));
  const Descriptor earlier(open(place.c_str(), O_RDONLY | O_CLOEXEC));
  if (!earlier.is_open()) refuse(path, reason(errno), other_name(kind));
  if (is_locked(earlier)) refuse_busy(path);
  if (!may_be_replaced(earlier, kind))
    refuse(path, std::string("a file of this name exists and contains no ").append(kind.name),
           other_name(kind) + ", or first type: rm " + path);
  if (own.is_open())
    refuse(path, "another program has replaced it since this run last wrote it", "Name another file: -o other.h5");
  return place;
}

/// Returns 0 or the error number.
int write_all(const Descriptor& file, std::span<const std::byte> bytes) {
  while (!bytes.empty()) {
    const ssize_t written = ::write(file, bytes.data(), bytes.size());
    if (written > 0) {
      bytes = bytes.subspan(static_cast<std::size_t>(written));
    } else if (written == 0) {
      return EIO;
    } else if (errno != EINTR) {
      return errno;
    }
  }
  return 0;
}

/// Returns 0 or the error number.
int bring_to_disk(const Descriptor& file) {
  while (fsync(file) != 0)
    if (errno != EINTR) return errno;
  return 0;
}

/// Copies the mode of the replaced file to the new one, and its owner if permitted.
void keep_mode(const fs::path& earlier, const Descriptor& file) {
  struct stat before = {};
  if (stat(earlier.c_str(), &before) != 0) return;
  [[maybe_unused]] const int owned = fchown(file, before.st_uid, before.st_gid);
  fchmod(file, before.st_mode & 07777);
}

}  // namespace

const FileKind results_files{"results of pounding", "-o results.h5", is_results};
const FileKind picture_files{"picture", "-o picture.png", is_picture};
const FileKind run_report_files{"report", "--report report.pdf", [](std::string_view start) {
                                  return start.starts_with("%PDF-") || start.starts_with("<!DOCTYPE html>");
                                }};

Descriptor::~Descriptor() {
  if (number_ >= 0) close(number_);
}

void ReplacedFile::require_free() const { destination(path_, kind_, written_); }

void ReplacedFile::replace(std::span<const std::byte> bytes) {
  const fs::path place = destination(path_, kind_, written_);
  const fs::path directory = place.has_parent_path() ? place.parent_path() : fs::path(".");
  const fs::path temporary = directory / std::string(".").append(place.filename().string()).append(".tmp");
  Descriptor file(open(temporary.c_str(), O_RDWR | O_CREAT | O_CLOEXEC | O_NOFOLLOW, 0666));
  if (!file.is_open()) {
    refuse(path_, reason(errno),
           std::string("Name a file in an existing directory that you may write to: ").append(kind_.example) +
               ", or first type: mkdir -p " + directory.string());
  }
  // Only one run at a time owns the temporary file; the run that has just renamed its file still holds the lock on the
  // result.
  if (!lock(file) || !is_same_file(file, temporary)) refuse_busy(path_);
  int error = ftruncate(file, 0) == 0 ? 0 : errno;
  if (error == 0) error = write_all(file, bytes);
  if (error == 0) error = bring_to_disk(file);
  if (error == 0) keep_mode(place, file);
  if (error == 0) error = rename(temporary.c_str(), place.c_str()) == 0 ? 0 : errno;
  if (error != 0) {
    unlink(temporary.c_str());
    refuse(path_, reason(error), "Free disk space, or name a file on another disk: -o /other/disk/results.h5");
  }
  written_ = std::move(file);
  // The new name is directory data, which needs its own fsync.
  if (const Descriptor folder(open(directory.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC)); folder.is_open())
    fsync(folder);
}

}  // namespace pounding
