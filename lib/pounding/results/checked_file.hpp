#pragma once
/// User block of a results file: format, length and checksum. Readers check it before HDF5 opens the file, because HDF5
/// may crash or hang on a damaged one.

#include <cstddef>
#include <span>
#include <string>

namespace pounding {

/// Size of the HDF5 user block [bytes], which h5py, h5dump and others skip.
constexpr std::size_t checked_block_size = 512;

/// Writes the block into the first `checked_block_size` bytes of a file; their previous content is ignored.
void write_checked_block(std::span<std::byte> file);

/// True if bytes from the start of a file are those of a results file, intact or damaged.
bool begins_results(std::span<const std::byte> start);

/// True if `path` is the table of a study or a suite, intact or damaged; false if it cannot be read.
bool is_study_table(const std::string& path);

/// Throws InputError unless `path` is an intact results file: for a file that is unreadable, was written by another
/// program or an earlier version, or was truncated or changed. Reads the file once, at the speed of zlib's crc32 (1
/// GB/s or more).
void require_whole(const std::string& path);

}  // namespace pounding
