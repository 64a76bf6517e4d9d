#pragma once
/// Replaces a file as a whole, so that a kill at any moment leaves the earlier or the new one.

#include <cstddef>
#include <span>
#include <string>

namespace pounding {

/// Writes `bytes` to a temporary file in the directory of `path` (named `.NAME.PROCESS.tmp`), brings it to the disk and
/// renames it to `path`; a symbolic link is followed. Temporary files of processes that no longer run are removed.
/// Throws InputError, with the earlier file untouched, when `path` is a directory or another thing that is not a file,
/// is write-protected, or cannot be written.
void replace_file(const std::string& path, std::span<const std::byte> bytes);

}  // namespace pounding
