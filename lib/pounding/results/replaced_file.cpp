#include <pounding/results/replaced_file.hpp>

#include <dirent.h>
#include <fcntl.h>
#include <signal.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <charconv>
#include <climits>
#include <cstdio>
#include <ctime>
#include <filesystem>
#include <limits>
#include <memory>
#include <string_view>
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
  refuse(path, "another run writes it now", "Wait for its end, or name another file: -o other.h5");
}

std::string other_name(const FileKind& kind) { return std::string("Name another file: ").append(kind.example); }
std::string file_name(const FileKind& kind) { return std::string("Name a file: ").append(kind.example); }

std::string reason(int error) { return std::generic_category().message(error); }

// One byte that no file reaches: HDF5 and other readers lock whole files, which must not meet with this.
struct flock place_of_lock(short kind) {
  struct flock place = {};
  place.l_type = kind;
  place.l_whence = SEEK_SET;
  place.l_start = std::numeric_limits<off_t>::max() - 1;
  place.l_len = 1;
  return place;
}

// The lock is of an open file, not of a process: two objects of one process are refused alike. A file system without
// locks holds nothing.
void hold(const Descriptor& file) {
  struct flock place = place_of_lock(F_RDLCK);
  fcntl(file, F_OFD_SETLK, &place);
}

bool is_held_by_others(const Descriptor& file) {
  struct flock place = place_of_lock(F_WRLCK);
  return fcntl(file, F_OFD_GETLK, &place) == 0 && place.l_type != F_UNLCK;
}

bool is_same_file(const Descriptor& file, const fs::path& path) {
  struct stat open_one = {}, named = {};
  return fstat(file, &open_one) == 0 && stat(path.c_str(), &named) == 0 && open_one.st_ino == named.st_ino &&
         open_one.st_dev == named.st_dev;
}

/// Results of versions before 0.2, which have no checksum in front: HDF5 with names that only ours have among its first
/// ones.
bool begins_results_without_checksum(std::string_view start) {
  using namespace std::string_view_literals;
  constexpr std::array names{"program\0"sv, "pounding"sv, "resolved.yaml"sv};
  return start.starts_with("\x89HDF\r\n\x1a\n") &&
         std::all_of(names.begin(), names.end(), [&](std::string_view name) { return start.find(name) != start.npos; });
}

bool is_results(std::string_view start) {
  return begins_results(std::as_bytes(std::span(start))) || begins_results_without_checksum(start);
}

// As in python/pounding/outputs.py.
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

/// Only empty files and earlier ones of the same kind are replaced, never a model, a record or another program's data.
bool may_be_replaced(const Descriptor& file, const FileKind& kind) {
  std::array<char, 4096> start{};
  const ssize_t count = pread(file, start.data(), start.size(), 0);
  return count == 0 || (count > 0 && kind.recognises({start.data(), static_cast<std::size_t>(count)}));
}

/// The end of a chain of symbolic links, which stay links, even where it leads to a file that is not there yet.
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

/// The file that is to be replaced, with what its lock, its content and its kind forbid. `own` is what this process
/// wrote there last.
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
  if (is_held_by_others(earlier)) refuse_busy(path);
  if (!may_be_replaced(earlier, kind))
    refuse(path, std::string("a file of this name exists and holds no ").append(kind.name),
           other_name(kind) + ", or first type: rm " + path);
  if (own.is_open())
    refuse(path, "another program has replaced it since this run wrote it", "Name another file: -o other.h5");
  return place;
}

std::string host_name() {
  std::array<char, HOST_NAME_MAX + 1> name{};
  return gethostname(name.data(), name.size() - 1) == 0 ? name.data() : "host";
}

/// Removes the temporary files of killed processes of this host, as far as possible. Those of others, which may share
/// the disk, stay.
void remove_leftovers(const fs::path& directory, const std::string& prefix, std::string_view suffix) {
  // Where memory ends, the iterator of the standard library ends the process.
  const std::unique_ptr<DIR, int (*)(DIR*)> folder(opendir(directory.c_str()), closedir);
  if (!folder) return;
  while (const dirent* entry = readdir(folder.get())) {
    const std::string name = entry->d_name;
    if (name.size() <= prefix.size() + suffix.size() || !name.starts_with(prefix) || !name.ends_with(suffix)) continue;
    const char* digits_end = name.data() + name.size() - suffix.size();
    pid_t process = 0;
    const auto parsed = std::from_chars(name.data() + prefix.size(), digits_end, process);
    if (parsed.ec != std::errc{} || parsed.ptr != digits_end || process <= 0) continue;
    if (kill(process, 0) == 0 || errno != ESRCH) continue;
    // A container of the same name may have processes of its own.
    const fs::path path = directory / name;
    const Descriptor leftover(open(path.c_str(), O_RDONLY | O_CLOEXEC | O_NOFOLLOW));
    std::error_code ignored;
    if (leftover.is_open() && !is_held_by_others(leftover)) fs::remove(path, ignored);
  }
}

/// A limit on the size of files (ulimit -f) ends a process by SIGXFSZ; while this lives, writing fails with EFBIG
/// instead.
class SizeLimitIsAnError {
 public:
  SizeLimitIsAnError() {
    sigemptyset(&limit_);
    sigaddset(&limit_, SIGXFSZ);
    pthread_sigmask(SIG_BLOCK, &limit_, &before_);
  }
  ~SizeLimitIsAnError() {
    if (sigismember(&before_, SIGXFSZ) == 0) {
      const timespec at_once = {};
      sigtimedwait(&limit_, nullptr, &at_once);
    }
    pthread_sigmask(SIG_SETMASK, &before_, nullptr);
  }
  SizeLimitIsAnError(const SizeLimitIsAnError&) = delete;
  SizeLimitIsAnError& operator=(const SizeLimitIsAnError&) = delete;

 private:
  sigset_t limit_, before_;
};

/// Returns 0 or the error number.
int write_all(const Descriptor& file, std::span<const std::byte> bytes) {
  const SizeLimitIsAnError limited;
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

/// The new name of a file is in its folder, which is brought to the disk by itself. File systems that know no such
/// thing say EINVAL.
int bring_folder_to_disk(const fs::path& directory) {
  const Descriptor folder(open(directory.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC));
  if (!folder.is_open()) return errno == EACCES ? 0 : errno;  // a folder may be written and not read
  const int error = bring_to_disk(folder);
  return error == EINVAL || error == ENOTSUP ? 0 : error;
}

/// Gives a new file the mode of the one that it replaces, and its owner as far as this process may.
void keep_mode(const fs::path& earlier, const Descriptor& file) {
  struct stat before = {};
  if (stat(earlier.c_str(), &before) != 0) return;
  [[maybe_unused]] const int owned = fchown(file, before.st_uid, before.st_gid);
  fchmod(file, before.st_mode & 07777);
}

/// Returns 0 or the error number: EEXIST where the new name must be free and is not.
int rename_to(const fs::path& from, const fs::path& to, bool must_be_free) {
  if (renameat2(AT_FDCWD, from.c_str(), AT_FDCWD, to.c_str(), must_be_free ? RENAME_NOREPLACE : 0) == 0) return 0;
  if (!must_be_free || errno != EINVAL) return errno;
  return rename(from.c_str(), to.c_str()) == 0 ? 0 : errno;  // a file system that cannot ask whether a name is free
}

}  // namespace

const FileKind results_files{"results of pounding", "-o results.h5", is_results};
const FileKind picture_files{"picture", "-o picture.png", is_picture};

Descriptor::~Descriptor() {
  if (number_ >= 0) close(number_);
}

void ReplacedFile::require_free() const { destination(path_, kind_, written_); }

void ReplacedFile::replace(std::span<const std::byte> bytes) {
  const fs::path place = destination(path_, kind_, written_);
  const fs::path directory = place.has_parent_path() ? place.parent_path() : fs::path(".");
  const std::string prefix =
      std::string(".").append(place.filename().string()).append(".").append(host_name()).append(".");
  const std::string_view suffix = ".tmp";
  remove_leftovers(directory, prefix, suffix);

  const fs::path temporary = directory / (prefix + std::to_string(getpid()) + std::string(suffix));
  Descriptor file(open(temporary.c_str(), O_RDWR | O_CREAT | O_CLOEXEC | O_NOFOLLOW, 0666));
  if (!file.is_open()) {
    refuse(path_, reason(errno),
           std::string("Name a file in an existing directory that you may write to: ").append(kind_.example) +
               ", or first type: mkdir -p " + directory.string());
  }
  if (is_held_by_others(file)) refuse_busy(path_);
  hold(file);
  int error = ftruncate(file, 0) == 0 ? 0 : errno;
  if (error == 0) error = write_all(file, bytes);
  if (error == 0) error = bring_to_disk(file);
  if (error == 0) keep_mode(place, file);
  // The first to arrive at a free place has it.
  const bool is_first = !written_.is_open() && !fs::exists(place);
  if (error == 0) error = rename_to(temporary, place, is_first);
  if (error != 0) {
    unlink(temporary.c_str());
    if (is_first && error == EEXIST) refuse_busy(path_);
    refuse(path_, reason(error), "Make room, or name a file on another disk: -o /other/disk/results.h5");
  }
  written_ = std::move(file);
  error = bring_folder_to_disk(directory);
  if (error != 0)
    refuse(path_,
           "it is written, but its folder could not be brought to the disk, and a power failure may take it back: " +
               reason(error),
           "Name a file on another disk: -o /other/disk/results.h5");
}

}  // namespace pounding
