/// HDF5 files in memory, without copies.

#include <pounding/results/hdf5.hpp>

#include <algorithm>
#include <cstdlib>
#include <memory>
#include <string>
#include <utility>

#include <pounding/petsc/library_lock.hpp>
#include <pounding/results/checked_file.hpp>

namespace pounding::hdf5 {
namespace {

/// Memory for a file that HDF5 creates. It survives the closing of the file.
class GrowingMemory {
 public:
  GrowingMemory() = default;
  ~GrowingMemory() { std::free(bytes_); }
  GrowingMemory(const GrowingMemory&) = delete;
  GrowingMemory& operator=(const GrowingMemory&) = delete;

  /// C callback for HDF5, which requests small increments.
  static void* grow(void*, std::size_t size, H5FD_file_image_op_t, void* memory) noexcept {
    auto& self = *static_cast<GrowingMemory*>(memory);
    if (size <= self.size_) return self.bytes_;
    const std::size_t larger = std::max(size, self.size_ + self.size_ / 4);
    void* const bytes = std::realloc(self.bytes_, larger);
    if (bytes == nullptr) return nullptr;
    self.bytes_ = static_cast<std::byte*>(bytes);
    self.size_ = larger;
    return bytes;
  }

  /// Releases ownership of the first `size` bytes.
  std::shared_ptr<std::byte> release(std::size_t size) {
    if (void* const bytes = std::realloc(bytes_, size)) bytes_ = static_cast<std::byte*>(bytes);
    return {std::exchange(bytes_, nullptr), [](std::byte* bytes) { std::free(bytes); }};
  }

 private:
  std::byte* bytes_ = nullptr;
  std::size_t size_ = 0;
};

Handle in_memory_access() {
  constexpr std::size_t growth = std::size_t{1} << 20;
  Handle access(H5Pcreate(H5P_FILE_ACCESS), H5Pclose, "create file properties");
  checked(H5Pset_fapl_core(access, growth, false), "select an in-memory file");
  return access;
}

}  // namespace

FileImage checked_image(const std::function<void(hid_t file)>& write) {
  const LibraryLock lock;
  const Quiet quiet;
  GrowingMemory memory;
  std::size_t size = checked_block_size;
  {
    H5FD_file_image_callbacks_t callbacks{};
    callbacks.image_realloc = GrowingMemory::grow;
    callbacks.image_free = [](void*, H5FD_file_image_op_t, void*) -> herr_t { return 0; };
    callbacks.udata_copy = [](void* same) { return same; };
    callbacks.udata_free = [](void*) -> herr_t { return 0; };
    callbacks.udata = &memory;
    const Handle access = in_memory_access();
    checked(H5Pset_file_image_callbacks(access, &callbacks), "set the file image callbacks");
    const Handle creation(H5Pcreate(H5P_FILE_CREATE), H5Pclose, "create file properties");
    checked(H5Pset_userblock(creation, checked_block_size), "set the user block size");
    const Handle file(H5Fcreate("results in memory", H5F_ACC_TRUNC, creation, access), H5Fclose, "create a file");
    write(file);
    checked(H5Fflush(file, H5F_SCOPE_GLOBAL), "flush the file");
    // File addresses in HDF5 include the user block, but this size does not.
    size += static_cast<std::size_t>(checked(H5Fget_file_image(file, nullptr, 0), "get the file size"));
  }
  const std::shared_ptr<std::byte> bytes = memory.release(size);
  write_checked_block({bytes.get(), size});
  return {bytes, size};
}

Handle memory_file() {
  static int count = 0;  // HDF5 identifies files in memory by name, and several may be open; callers have LibraryLock
  const std::string name = "group in memory " + std::to_string(++count);
  return {H5Fcreate(name.c_str(), H5F_ACC_TRUNC, H5P_DEFAULT, in_memory_access()), H5Fclose, "create a file"};
}

}  // namespace pounding::hdf5
