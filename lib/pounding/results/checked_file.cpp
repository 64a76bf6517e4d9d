#include <pounding/results/checked_file.hpp>

#include <zlib.h>

#include <array>
#include <cerrno>
#include <cstdint>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <string_view>
#include <system_error>

#include <fmt/format.h>

#include <pounding/core/error.hpp>

namespace pounding {
namespace {

constexpr std::string_view first_line = "results of pounding\n";
constexpr std::string_view first_line_of_study = "study of pounding\n";
constexpr std::string_view hdf5_signature = "\x89HDF\r\n\x1a\n";

std::string_view text_of(std::span<const std::byte> bytes) {
  return {reinterpret_cast<const char*>(bytes.data()), bytes.size()};
}

// CRC-32, as in PNG and gzip: detects every burst of up to 32 changed bits, and misses other damage in one file of 4e9.
std::uint32_t crc32_of(std::uint32_t before, std::span<const std::byte> bytes) {
  return static_cast<std::uint32_t>(crc32_z(before, reinterpret_cast<const Bytef*>(bytes.data()), bytes.size()));
}

// Every byte of the block follows from two numbers, so readers detect any change in it.
std::string block(std::uint64_t size, std::uint32_t crc) {
  std::string text = fmt::format(
      "{}size {:020}\ncrc32 {:08x}\n"
      "The HDF5 file begins at byte {}, as HDF5 allows; h5py and h5dump open it as it is.\n"
      "size: all bytes, these included. crc32: of the bytes behind these.\n",
      first_line, size, crc, checked_block_size);
  text.resize(checked_block_size - 1, ' ');
  return text + '\n';
}

[[noreturn]] void refuse_unread(const std::string& path) {
  throw InputError(fmt::format("{}: cannot be read: {}", path, std::generic_category().message(errno)));
}

[[noreturn]] void refuse_foreign(const std::string& path, std::string_view start) {
  if (start.empty()) throw InputError(fmt::format("{}: file is empty; run the model again", path));
  if (start.starts_with(hdf5_signature))
    throw InputError(
        fmt::format("{}: has no checksum, so damage cannot be detected: it was written by an earlier version of "
                    "pounding or by another program. Run the model again, or read your own results unchecked in "
                    "Python: pounding.read(\"{}\", checked=False)",
                    path, path));
  if (start.starts_with(first_line_of_study))
    throw InputError(
        fmt::format("{}: is a study table, not results of a run; type pounding study show {}", path, path));
  throw InputError(
      fmt::format("{}: is not a results file of pounding; type pounding run MODEL.yaml -o OUT.h5 to write one", path));
}

[[noreturn]] void refuse_damaged(const std::string& path, const std::string& what) {
  throw InputError(fmt::format(
      "{}: file is damaged or was changed by another program: {}. Use an intact copy, or run the model again", path,
      what));
}

}  // namespace

void write_checked_block(std::span<std::byte> file) {
  const std::string text = block(file.size(), crc32_of(0, file.subspan(checked_block_size)));
  std::memcpy(file.data(), text.data(), text.size());
}

bool begins_results(std::span<const std::byte> start) { return text_of(start).starts_with(first_line); }

bool is_study_table(const std::string& path) {
  std::array<char, first_line_of_study.size()> start{};
  std::ifstream file(path, std::ios::binary);
  file.read(start.data(), start.size());
  return std::string_view(start.data(), static_cast<std::size_t>(file.gcount())) == first_line_of_study;
}

void require_whole(const std::string& path) {
  std::error_code error;
  const std::filesystem::file_status status = std::filesystem::status(path, error);
  if (status.type() == std::filesystem::file_type::not_found) throw InputError(fmt::format("{}: no such file", path));
  if (std::filesystem::is_directory(status))
    throw InputError(fmt::format("{}: is a directory, not a results file", path));
  errno = EINVAL;
  std::ifstream file(path, std::ios::binary);
  if (!file) refuse_unread(path);
  std::array<char, checked_block_size> start{};
  file.read(start.data(), start.size());
  const auto began = static_cast<std::size_t>(file.gcount());
  const std::string_view text(start.data(), began);
  const bool behind_a_block = [&] {  // a results file whose first line is damaged
    std::array<char, hdf5_signature.size()> signature{};
    file.read(signature.data(), signature.size());
    return std::string_view(signature.data(), signature.size()) == hdf5_signature;
  }();
  if (text.starts_with(first_line_of_study) || (!text.starts_with(first_line) && !behind_a_block))
    refuse_foreign(path, text);

  file.clear();
  file.seekg(static_cast<std::streamoff>(began));
  std::string buffer(std::size_t{1} << 20, '\0');
  std::uint64_t size = began;
  std::uint32_t crc = 0;
  do {
    file.read(buffer.data(), static_cast<std::streamsize>(buffer.size()));
    const std::span<const char> read(buffer.data(), static_cast<std::size_t>(file.gcount()));
    crc = crc32_of(crc, std::as_bytes(read));
    size += read.size();
  } while (file);
  if (file.bad()) refuse_unread(path);
  if (text == block(size, crc)) return;
  std::uint64_t written = 0;
  const std::size_t digits = first_line.size() + std::string_view("size ").size();
  if (text.size() > digits + 20) written = std::strtoull(std::string(text.substr(digits, 20)).c_str(), nullptr, 10);
  if (size < written && text.starts_with(first_line))
    refuse_damaged(path, fmt::format("it has {} of {} bytes", size, written));
  refuse_damaged(path, "checksum mismatch");
}

}  // namespace pounding
