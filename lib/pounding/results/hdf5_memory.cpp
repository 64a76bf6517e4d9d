/// Files of HDF5 in memory, which are not copied.

#include <pounding/results/hdf5.hpp>

#include <algorithm>
#include <cstdlib>
#include <memory>
#include <utility>

#include <pounding/results/checked_file.hpp>

namespace pounding::hdf5 {
namespace {

/// Memory in which HDF5 makes a file. It grows as a whole, and is here when HDF5 has closed the file.
class GrowingMemory {
 public:
  GrowingMemory() = default;
  ~GrowingMemory() { std::free(bytes_); }
  GrowingMemory(const GrowingMemory&) = delete;
  GrowingMemory& operator=(const GrowingMemory&) = delete;

  /// For HDF5, which calls in C and asks for a little more each time.
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

  /// Gives the first bytes away.
  std::shared_ptr<std::byte> release(std::size_t size) {
    if (void* const bytes = std::realloc(bytes_, size)) bytes_ = static_cast<std::byte*>(bytes);
    return {std::exchange(bytes_, nullptr), [](std::byte* bytes) { std::free(bytes); }};
  }

 private:
  std::byte* bytes_ = nullptr;
  std::size_t size_ = 0;
};

/// A file in memory of the caller, who keeps it.
Handle access_to(H5FD_file_image_callbacks_t callbacks, void* memory) {
  constexpr std::size_t growth = std::size_t{1} << 20;
  Handle access(H5Pcreate(H5P_FILE_ACCESS), H5Pclose, "describe a file");
  checked(H5Pset_fapl_core(access, growth, false), "choose a file in memory");
  callbacks.image_free = [](void*, H5FD_file_image_op_t, void*) -> herr_t { return 0; };
  callbacks.udata_copy = [](void* same) { return same; };
  callbacks.udata_free = [](void*) -> herr_t { return 0; };
  callbacks.udata = memory;
  checked(H5Pset_file_image_callbacks(access, &callbacks), "keep the memory of a file");
  return access;
}

FileImage made_by(const std::function<void(hid_t file)>& write, bool with_checksum) {
  const Quiet quiet;
  GrowingMemory memory;
  std::size_t size = checked_block_size;
  {
    H5FD_file_image_callbacks_t callbacks{};
    callbacks.image_realloc = GrowingMemory::grow;
    const Handle access = access_to(callbacks, &memory);
    const Handle creation(H5Pcreate(H5P_FILE_CREATE), H5Pclose, "describe a file");
    checked(H5Pset_userblock(creation, checked_block_size), "leave room in front");
    const Handle file(H5Fcreate("results in memory", H5F_ACC_TRUNC, creation, access), H5Fclose, "create a file");
    write(file);
    checked(H5Fflush(file, H5F_SCOPE_GLOBAL), "complete the file");
    // HDF5 counts the block in front in every address of the file, and leaves it out of this size.
    size += static_cast<std::size_t>(checked(H5Fget_file_image(file, nullptr, 0), "size the file"));
  }
  const std::shared_ptr<std::byte> bytes = memory.release(size);
  if (with_checksum) write_checked_block({bytes.get(), size});
  return {bytes, size};
}

}  // namespace

void open_image(const FileImage& image, const std::function<void(hid_t file)>& read) {
  void* const bytes = const_cast<std::byte*>(image.data());  // HDF5 reads them and writes nothing
  H5FD_file_image_callbacks_t callbacks{};
  callbacks.image_malloc = [](std::size_t, H5FD_file_image_op_t, void* bytes) { return bytes; };
  callbacks.image_memcpy = [](void* same, const void*, std::size_t, H5FD_file_image_op_t, void*) { return same; };
  const Handle access = access_to(callbacks, bytes);
  checked(H5Pset_file_image(access, bytes, image.size()), "give a file image");
  // HDF5 takes files in memory for the same where they have one name.
  const Handle file(H5Fopen("image of results", H5F_ACC_RDONLY, access), H5Fclose, "open a file image");
  read(file);
}

FileImage file_image(const std::function<void(hid_t file)>& write) { return made_by(write, false); }

FileImage checked_image(const std::function<void(hid_t file)>& write) { return made_by(write, true); }

}  // namespace pounding::hdf5
