#pragma once
/// The text in front of a results file: whose it is, how long it is, and its checksum. A reader compares them before
/// HDF5 sees the file, because HDF5 may crash or never end on a damaged one.

#include <cstddef>
#include <span>
#include <string>

namespace pounding {

/// Bytes in front of the HDF5 data: an HDF5 user block, which h5py, h5dump and others skip.
constexpr std::size_t checked_block_size = 512;

/// Writes the block of a file into its first bytes, which are `checked_block_size` bytes without a meaning.
void write_checked_block(std::span<std::byte> file);

/// Whether bytes from the beginning of a file are those of a results file, whole or damaged.
bool begins_results(std::span<const std::byte> start);

/// Throws InputError unless `path` is a results file with every byte as it was written: for a file that cannot be read,
/// that another program or an earlier version wrote, that was cut or changed. Reads it once, at the speed of zlib's
/// crc32, 1 GB/s or more.
void require_whole(const std::string& path);

}  // namespace pounding
