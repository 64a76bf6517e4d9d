#include <pounding/reduction/cached_modes.hpp>

#include <unistd.h>

#include <algorithm>
#include <atomic>
#include <filesystem>
#include <fstream>
#include <memory>
#include <stdexcept>
#include <utility>

#include <fmt/format.h>

#include <pounding/core/archive.hpp>
#include <pounding/core/archive_eigen.hpp>
#include <pounding/core/checksum.hpp>
#include <pounding/core/error.hpp>
#include <pounding/core/version.hpp>

namespace pounding::petsc {
namespace {

namespace fs = std::filesystem;

// Change the number if the same origin produces different modes, or if the file format changes.
constexpr const char* format = "modes of pounding " POUNDING_VERSION ", 1";
constexpr const char* ending = ".modes";
constexpr const char* unfinished = ".modes.tmp";

void archive_matrix(Archive& archive, SparseMatrix matrix) {
  matrix.makeCompressed();
  std::vector<int> starts(matrix.outerIndexPtr(), matrix.outerIndexPtr() + matrix.outerSize() + 1),
      rows(matrix.innerIndexPtr(), matrix.innerIndexPtr() + matrix.nonZeros());
  std::vector<double> values(matrix.valuePtr(), matrix.valuePtr() + matrix.nonZeros());
  archive(starts, rows, values);
}

void archive_group(Archive& archive, ReducedGroup& group) {
  GroupModes modes = group.modes ? *group.modes : GroupModes{};
  ShadowModes shadow = group.shadow ? *group.shadow : ShadowModes{};
  bool has_shadow = group.shadow != nullptr;
  archive(modes.shapes, modes.squares, has_shadow, shadow.in_modes, shadow.squares, group.made.flexibility_error,
          group.made.shadow_flexibility_error);
  if (!archive.reading()) return;
  group.modes = std::make_shared<const GroupModes>(std::move(modes));
  if (has_shadow) group.shadow = std::make_shared<const ShadowModes>(std::move(shadow));
}

// Start of each file.
Archive archive_of(const std::vector<std::byte>& origin) {
  Archive archive;
  std::string written = format;
  std::vector<std::byte> of = origin;
  archive(written, of);
  return archive;
}

std::string checksum_of(const std::vector<std::byte>& bytes) {
  Checksum checksum;
  checksum.add(bytes);
  return checksum.text();
}

bool write_whole(const std::string& path, const std::vector<std::byte>& bytes) {
  std::ofstream file(path, std::ios::binary);
  file << checksum_of(bytes);
  file.write(reinterpret_cast<const char*>(bytes.data()), static_cast<std::streamsize>(bytes.size()));
  file.close();
  return file.good();
}

// nullopt if the file cannot be read or its checksum does not match.
std::optional<std::vector<std::byte>> read_whole(const std::string& path) {
  std::string checksum = checksum_of({});
  std::error_code failed;
  const std::uintmax_t size = fs::file_size(path, failed);
  if (failed || size < checksum.size()) return std::nullopt;
  std::vector<std::byte> bytes(size - checksum.size());
  std::ifstream file(path, std::ios::binary);
  file.read(checksum.data(), static_cast<std::streamsize>(checksum.size()));
  file.read(reinterpret_cast<char*>(bytes.data()), static_cast<std::streamsize>(bytes.size()));
  if (!file || checksum != checksum_of(bytes)) return std::nullopt;
  return bytes;
}

}  // namespace

std::vector<std::byte> ModesOrigin::bytes() const {
  Archive archive;
  ReducedInputs vectors = inputs;
  archive_matrix(archive, mass);
  archive_matrix(archive, stiffness);
  for (double number : {damping.by_mass, damping.by_stiffness, damping.modal, inputs.shift}) archive(number);
  for (Eigen::MatrixXd* columns : {&vectors.links, &vectors.parts, &vectors.ground, &vectors.starts}) archive(*columns);
  for (int number : {depth.links, depth.ground, depth.shifted ? 1 : 0, depth.parts, shadow ? 1 : 0}) archive(number);
  return archive.bytes();
}

CachedModes::CachedModes(std::string folder, std::uintmax_t max_bytes)
    : folder_(std::move(folder)), max_bytes_(max_bytes) {
  std::error_code failed;
  fs::create_directories(folder_, failed);
  const auto refuse = [&](const std::string& why) {
    throw InputError(
        fmt::format("cannot store modes in \"{}\": {}; type -pounding_red_cache FOLDER with a writable directory, or "
                    "omit the option",
                    folder_, why));
  };
  if (!fs::is_directory(folder_, failed)) refuse(failed ? failed.message() : "it is not a directory");
  if (access(folder_.c_str(), R_OK | W_OK | X_OK) != 0) refuse("it is write-protected");
}

std::string CachedModes::file_of(const std::vector<std::byte>& origin) const {
  return folder_ + '/' + checksum_of(origin);
}

std::optional<ReducedGroup> CachedModes::find(const std::vector<std::byte>& origin) const {
  const std::string path = file_of(origin) + ending;
  std::optional<std::vector<std::byte>> bytes = read_whole(path);
  if (!bytes) return std::nullopt;
  ReducedGroup group;
  try {
    Archive archive(std::move(*bytes));
    std::string written;
    std::vector<std::byte> of;
    archive(written, of);
    if (written != format || of != origin) return std::nullopt;
    archive_group(archive, group);
    archive.expect_end();
  } catch (const std::runtime_error&) {
    return std::nullopt;
  }
  std::error_code ignored;
  fs::last_write_time(path, fs::file_time_type::clock::now(), ignored);
  return group;
}

void CachedModes::keep(const std::vector<std::byte>& origin, const ReducedGroup& group) const {
  const std::string path = file_of(origin);
  Archive archive = archive_of(origin);
  ReducedGroup kept = group;
  archive_group(archive, kept);
  static std::atomic<int> writes = 0;  // of all threads
  const std::string temporary = fmt::format("{}.{}.{}{}", path, getpid(), writes++, unfinished);
  const bool written = write_whole(temporary, archive.bytes());
  std::error_code failed;
  if (written) fs::rename(temporary, path + ending, failed);
  if (!written || failed) {
    fs::remove(temporary, failed);
    return;
  }
  make_room();
}

// Other processes may remove files concurrently.
void CachedModes::make_room() const {
  struct Found {
    fs::file_time_type used;
    std::uintmax_t size;
    fs::path path;
  };
  std::vector<Found> found;
  std::uintmax_t all = 0;
  std::error_code failed;
  for (const fs::directory_entry& entry : fs::directory_iterator(folder_, failed)) {
    const std::string name = entry.path().filename().string();
    if (!name.ends_with(ending) && !name.ends_with(unfinished)) continue;
    const fs::file_time_type used = entry.last_write_time(failed);
    if (failed) continue;
    const std::uintmax_t size = entry.file_size(failed);
    if (failed) continue;
    found.push_back({used, size, entry.path()});
    all += size;
  }
  std::ranges::sort(found, {}, &Found::used);
  for (std::size_t i = 0; i + 1 < found.size() && all > max_bytes_; ++i)
    if (fs::remove(found[i].path, failed)) all -= found[i].size;
}

}  // namespace pounding::petsc
