#pragma once
/// A thin layer over the C interface of HDF5 for results and checkpoints: owning identifiers, errors as exceptions with
/// HDF5's own text, and datasets that state their units. Every function throws std::runtime_error if HDF5 fails.

#include <hdf5.h>

#include <cstddef>
#include <functional>
#include <set>
#include <stdexcept>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include <pounding/results/file_image.hpp>

namespace pounding::hdf5 {

/// Returns a nonnegative status; otherwise throws `HDF5 could not ACTION: ...`.
hid_t checked(hid_t status, std::string_view action);

/// Silences HDF5's error printing during its lifetime, then restores the handler of the host program.
class Quiet {
 public:
  Quiet() {
    H5Eget_auto2(H5E_DEFAULT, &function_, &data_);
    H5Eset_auto2(H5E_DEFAULT, nullptr, nullptr);
  }
  ~Quiet() { H5Eset_auto2(H5E_DEFAULT, function_, data_); }
  Quiet(const Quiet&) = delete;
  Quiet& operator=(const Quiet&) = delete;

 private:
  H5E_auto2_t function_ = nullptr;
  void* data_ = nullptr;
};

/// Owns one identifier.
class Handle {
 public:
  /// The HDF5 function that closes an identifier of this kind.
  using Close = herr_t (*)(hid_t);
  /// Throws as `checked` does, for this action on the object of this name.
  Handle(hid_t id, Close close, std::string_view action, std::string_view name = {}) : id_(id), close_(close) {
    if (id < 0) checked(id, std::string(action).append(name));
  }
  Handle(Handle&& other) noexcept : id_(std::exchange(other.id_, H5I_INVALID_HID)), close_(other.close_) {}
  ~Handle() {
    if (id_ >= 0) close_(id_);
  }
  Handle& operator=(Handle&&) = delete;
  operator hid_t() const noexcept { return id_; }

 private:
  hid_t id_;
  Close close_;
};

/// In-memory file, filled by `write`: its bytes follow `checked_block_size` undefined bytes. HDF5 never touches the
/// disk.
FileImage file_image(const std::function<void(hid_t file)>& write);

/// As `file_image`, with the checksum in its user block.
FileImage checked_image(const std::function<void(hid_t file)>& write);

/// Opens the image of a file for `read` without copying, and closes it afterwards.
void open_image(const FileImage& image, const std::function<void(hid_t file)>& read);

/// Creates and opens one group; its members are listed in creation order.
Handle group(hid_t parent, const std::string& name);

/// Type of UTF-8 text of `size` bytes, zero-padded. Texts have a fixed length, that of the longest in a list: HDF5
/// stores variable-length text in heaps, and hangs if one of these is damaged.
Handle text_type(std::size_t size);

/// Writes an attribute of an object. Throws InputError for a text of more than 64,000 bytes.
void attribute(hid_t object, const char* name, const std::string& value);
void attribute(hid_t object, const char* name, double value);
void attribute(hid_t object, const char* name, int value);
void attribute(hid_t object, const char* name, const std::vector<std::string>& values);
void attribute(hid_t object, const char* name, const std::vector<double>& values);

/// Name, unit and description of a dataset; the unit of a dimensionless number is "1".
struct Label {
  const char* name;
  const char* units;
  const char* long_name;
};

/// Throws std::invalid_argument unless a list of `what` has the expected length.
inline void check_length(std::size_t length, std::size_t expected, const std::string& what) {
  if (length != expected)
    throw std::invalid_argument(what + " holds " + std::to_string(length) + " values; " + std::to_string(expected) +
                                " are expected");
}

/// Writes a chunked array, time first, row-major; any extent may be 0.
Handle array(hid_t parent, const Label& label, const std::vector<double>& values, const std::vector<hsize_t>& shape);
Handle integers(hid_t parent, const Label& label, const std::vector<int>& values, const std::vector<hsize_t>& shape);
/// Writes a list of texts with the unit "text"; attributes are too small for long lists.
void texts(hid_t parent, const char* name, const char* long_name, const std::vector<std::string>& values);
/// Writes one text with the unit "text".
void text(hid_t parent, const char* name, const char* long_name, const std::string& value);
void scalar(hid_t parent, const Label& label, long value);
void scalar(hid_t parent, const Label& label, double value);
/// Writes a chunked table of `rows` rows of a compound type, with one unit and one description per field, in order.
void table(hid_t parent, const char* name, const char* long_name, hid_t row_type, std::size_t rows, const void* data,
           const std::vector<std::string>& units, const std::vector<std::string>& field_long_names);
/// Writes opaque bytes.
void bytes(hid_t parent, const char* name, const char* long_name, const std::vector<std::byte>& values);

/// Adds the content of a file image, including its attributes, as a group, except root members named in `but`.
void add_file(hid_t file, const std::string& name, const FileImage& image, const std::set<std::string>& but = {});
/// The content of a group as a file image: the inverse of add_file().
FileImage group_image(hid_t file, const std::string& name);

/// Opens a results file on disk for `read` and closes it afterwards. Throws InputError as require_whole().
void open_file(const std::string& path, const std::function<void(hid_t file)>& read);
bool has(hid_t file, const char* path);
/// Names in a group, in alphabetical order.
std::vector<std::string> members(hid_t file, const char* path);
/// Extents of an array.
std::vector<std::size_t> shape(hid_t file, const char* path);
std::string read_attribute(hid_t object, const char* name);
std::string read_text(hid_t file, const char* path);
/// Reads all values of an array, row-major.
void read_array(hid_t file, const char* path, std::vector<double>& values);
void read_bytes(hid_t file, const char* path, std::vector<std::byte>& values);

}  // namespace pounding::hdf5
