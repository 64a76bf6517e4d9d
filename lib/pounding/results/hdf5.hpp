#pragma once
/// A thin layer over the C interface of HDF5 for results and checkpoints: owning identifiers, errors as exceptions with
/// HDF5's own text, and datasets that state their units. Every function throws std::runtime_error if HDF5 fails.

#include <hdf5.h>

#include <cstddef>
#include <functional>
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

/// In-memory file, filled by `write`, with the checksum in its user block. HDF5 never touches the disk.
FileImage checked_image(const std::function<void(hid_t file)>& write);

/// Open file in memory, which HDF5 owns. The caller has the LibraryLock.
Handle memory_file();

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

/// Extents of an array, the slowest first; empty for a scalar. Any extent may be 0.
using Shape = std::vector<hsize_t>;

/// Writes a row-major array or a scalar. Texts have the unit "text"; attributes are too small for long lists of them.
Handle write(hid_t parent, const Label& label, const Shape& shape, const std::vector<double>& values);
Handle write(hid_t parent, const Label& label, const Shape& shape, const std::vector<int>& values);
Handle write(hid_t parent, const Label& label, const Shape& shape, const std::vector<std::byte>& values);
Handle write(hid_t parent, const Label& label, const Shape& shape, const std::vector<std::string>& values);
Handle write(hid_t parent, const Label& label, const Shape& scalar, double value);
Handle write(hid_t parent, const Label& label, const Shape& scalar, long value);
Handle write(hid_t parent, const Label& label, const Shape& scalar, const std::string& value);

/// Number of values.
template <class Value>
std::size_t count(const std::vector<Value>& values) {
  return values.size();
}
template <class Value>
std::size_t count(const Value&) {
  return 1;
}

/// Writes a chunked table of `rows` rows of a compound type, with one unit and one description per field, in order.
Handle table(hid_t parent, const char* name, const char* long_name, hid_t row_type, std::size_t rows, const void* data,
             const std::vector<std::string>& units, const std::vector<std::string>& field_long_names);

/// Dimension of arrays: its scale, a dataset whose name is that of the dimension.
struct Scale {
  hobj_ref_t reference = 0;
  hsize_t size = 0;
  std::vector<std::string> labels{};  ///< empty for numbers, and for a dimension without coordinates
  const char* attribute = nullptr;    ///< attribute of arrays that repeats the labels; null for none
};
/// Writes the scale of a dimension with these labels, which are its coordinates, or of one without coordinates.
Scale scale(hid_t parent, const char* name, const std::vector<std::string>& labels);
Scale scale(hid_t parent, const char* name, hsize_t size);
/// Makes a list in a group the coordinates of the dimension of its name.
Scale make_scale(hid_t parent, const char* name);
/// Hides a dataset from readers of netCDF, to which it is the size of a dimension.
void hide(hid_t parent, const char* name);
/// Names the dimensions of an array, as H5DSattach_scale(). Scales have no list of their arrays: it would exceed the 64
/// kB of an attribute in large models, and no reader needs it.
void attach(hid_t array, std::vector<hobj_ref_t> scales);
/// Also writes the attributes of the scales. A scalar has none.
void attach(hid_t array, const std::vector<const Scale*>& scales);
/// Name and type of the attribute that attach() writes.
constexpr const char* dimension_list = "DIMENSION_LIST";
Handle reference_lists();

/// Group of the run without links.
constexpr const char* without_links_group = "no_pounding";
/// Copies a group to another file that has none of that name.
void copy_group(hid_t from, hid_t to, const char* name);

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
