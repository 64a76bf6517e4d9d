#include <pounding/results/hdf5.hpp>

#include <algorithm>
#include <cstring>
#include <utility>

#include <fmt/format.h>

#include <pounding/core/error.hpp>

namespace pounding::hdf5 {
namespace {

Handle dataspace(const std::vector<hsize_t>& shape, const hsize_t* limits = nullptr) {
  const int rank = static_cast<int>(shape.size());
  return {rank == 0 ? H5Screate(H5S_SCALAR) : H5Screate_simple(rank, shape.data(), limits), H5Sclose,
          "create a dataspace"};
}

void write_attribute(hid_t object, const char* name, hid_t type, hid_t space, const void* data) {
  const Handle made(H5Acreate2(object, name, type, space, H5P_DEFAULT, H5P_DEFAULT), H5Aclose,
                    std::string("create attribute ") + name);
  if (data != nullptr) checked(H5Awrite(made, type, data), std::string("write attribute ") + name);
}

// Writes the section of `data` (of the whole shape) that is selected in `space`; nothing if `data` is null.
Handle dataset(hid_t parent, const char* name, hid_t type, hid_t space, hid_t creation, const void* data) {
  Handle made(H5Dcreate2(parent, name, type, space, H5P_DEFAULT, creation, H5P_DEFAULT), H5Dclose,
              std::string("create dataset ") + name);
  if (data != nullptr)
    checked(H5Dwrite(made, type, space, space, H5P_DEFAULT, data), std::string("write dataset ") + name);
  return made;
}

bool are_zeros(const std::byte* bytes, std::size_t size) {
  return size == 0 || (bytes[0] == std::byte{} && std::memcmp(bytes, bytes + 1, size - 1) == 0);
}

constexpr hsize_t values_in_a_chunk = 1 << 14;
/// A chunked dataset, which may have no rows or no columns although HDF5 allows no empty chunk. Not compressed: deflate
/// reduces motion histories by a quarter and takes twice as long as the run itself. Leading chunks of zeros are not
/// stored, such as the dissipated energy of a part before it yields: HDF5 reads unwritten values as zero.
Handle chunked(hid_t parent, const char* name, hid_t type, const std::vector<hsize_t>& shape, const void* data) {
  hsize_t row = 1;
  for (std::size_t i = 1; i < shape.size(); ++i) row *= std::max<hsize_t>(1, shape[i]);

  std::vector<hsize_t> chunk(shape), limits(shape);
  for (std::size_t i = 1; i < shape.size(); ++i) limits[i] = chunk[i] = std::max<hsize_t>(1, shape[i]);
  const hsize_t rows = std::max<hsize_t>(1, shape[0]),
                chunks = (rows * row + values_in_a_chunk - 1) / values_in_a_chunk;
  chunk[0] = (rows + chunks - 1) / chunks;  // equal chunk sizes, because the last chunk is stored in full
  limits[0] = H5S_UNLIMITED;

  const Handle creation(H5Pcreate(H5P_DATASET_CREATE), H5Pclose, "create dataset properties");
  checked(H5Pset_chunk(creation, static_cast<int>(chunk.size()), chunk.data()), "set the chunk size");
  const Handle space = dataspace(shape, limits.data());
  if (std::ranges::find(shape, hsize_t{0}) != shape.end()) return dataset(parent, name, type, space, creation, nullptr);
  const auto* const bytes = static_cast<const std::byte*>(data);
  const std::size_t row_size = row * H5Tget_size(type);
  std::vector<hsize_t> start(shape.size()), count(shape);
  hsize_t& first = start[0];  // first row to write
  while (first < shape[0] && are_zeros(bytes + first * row_size, std::min(chunk[0], shape[0] - first) * row_size))
    first = std::min(first + chunk[0], shape[0]);
  count[0] -= first;
  if (count[0] == 0) return dataset(parent, name, type, space, creation, nullptr);
  checked(H5Sselect_hyperslab(space, H5S_SELECT_SET, start.data(), nullptr, count.data(), nullptr), "select rows");
  return dataset(parent, name, type, space, creation, data);
}

}  // namespace

hid_t checked(hid_t status, std::string_view action) {
  if (status >= 0) return status;
  std::string text = "HDF5 could not " + std::string(action);
  const auto append = [](unsigned, const H5E_error2_t* error, void* target) noexcept -> herr_t {
    if (error->desc != nullptr) static_cast<std::string*>(target)->append(": ").append(error->desc);
    return 0;
  };
  H5Ewalk2(H5E_DEFAULT, H5E_WALK_DOWNWARD, append, &text);
  throw std::runtime_error(text);
}

Handle group(hid_t parent, const std::string& name) {
  const Handle creation(H5Pcreate(H5P_GROUP_CREATE), H5Pclose, "create group properties");
  checked(H5Pset_link_creation_order(creation, H5P_CRT_ORDER_TRACKED | H5P_CRT_ORDER_INDEXED),
          "track the creation order");
  // Links in the header of the group: beyond eight members, the default is an index that costs more than a dataset.
  checked(H5Pset_link_phase_change(creation, 64, 48), "set the storage of links");
  checked(H5Pset_est_link_info(creation, 16, 16), "set the expected number of links");
  return {H5Gcreate2(parent, name.c_str(), H5P_DEFAULT, creation, H5P_DEFAULT), H5Gclose, "create group ", name};
}

Handle text_type(std::size_t size) {
  Handle type(H5Tcopy(H5T_C_S1), H5Tclose, "create a string type");
  checked(H5Tset_size(type, std::max<std::size_t>(1, size)), "set the size of a string type");
  checked(H5Tset_cset(type, H5T_CSET_UTF8), "set a string type to UTF-8");
  if (size != H5T_VARIABLE) checked(H5Tset_strpad(type, H5T_STR_NULLPAD), "set the padding of a string type");
  return type;
}

namespace {

/// Contiguous texts, each zero-padded to the length of the longest one.
struct PaddedTexts {
  explicit PaddedTexts(const std::vector<std::string>& values) {
    for (const std::string& value : values) size = std::max(size, value.size());
    bytes.resize(size * values.size());
    for (std::size_t i = 0; i < values.size(); ++i)
      std::memcpy(bytes.data() + i * size, values[i].data(), values[i].size());
  }
  /// HDF5 does not accept a null pointer for an empty list.
  const void* data() const { return bytes.empty() ? nullptr : bytes.data(); }

  std::size_t size = 2;  ///< at least 2: xarray joins a list of single letters to one text
  std::string bytes;
};

}  // namespace

// Attributes are variable-length texts, which h5py and xarray return as str.
void attribute(hid_t object, const char* name, const std::string& value) {
  const char* pointer = value.c_str();
  write_attribute(object, name, text_type(H5T_VARIABLE), dataspace({}), &pointer);
}

void attribute(hid_t object, const char* name, double value) {
  write_attribute(object, name, H5T_NATIVE_DOUBLE, dataspace({}), &value);
}

void attribute(hid_t object, const char* name, int value) {
  write_attribute(object, name, H5T_NATIVE_INT, dataspace({}), &value);
}

void attribute(hid_t object, const char* name, const std::vector<std::string>& values) {
  std::vector<const char*> pointers;
  for (const std::string& value : values) pointers.push_back(value.c_str());
  write_attribute(object, name, text_type(H5T_VARIABLE), dataspace({values.size()}), pointers.data());
}

void attribute(hid_t object, const char* name, const std::vector<double>& values) {
  write_attribute(object, name, H5T_NATIVE_DOUBLE, dataspace({values.size()}), values.data());
}

namespace {

Handle described(Handle made, const Label& label) {
  attribute(made, "units", std::string(label.units));
  attribute(made, "long_name", std::string(label.long_name));
  return made;
}

// A contiguous dataset.
Handle plain(hid_t parent, const Label& label, hid_t type, const Shape& shape, const void* values) {
  return described(dataset(parent, label.name, type, dataspace(shape), H5P_DEFAULT, values), label);
}

// The attributes that H5DSset_scale() writes.
Scale make_scale(hid_t parent, const char* name, const std::string& label) {
  const Handle made(H5Dopen2(parent, name, H5P_DEFAULT), H5Dclose, "open dataset ", name);
  const auto text = [&](const char* key, const std::string& value) {
    const Handle type(H5Tcopy(H5T_C_S1), H5Tclose, "create a string type");
    checked(H5Tset_size(type, value.size() + 1), "set the size of a string type");
    write_attribute(made, key, type, dataspace({}), value.c_str());
  };
  text("CLASS", "DIMENSION_SCALE");
  text("NAME", label);
  Scale scale{};
  checked(H5Rcreate(&scale.reference, parent, name, H5R_OBJECT, -1), std::string("refer to dataset ") + name);
  const Handle space(H5Dget_space(made), H5Sclose, "get the size of dataset ", name);
  scale.size = static_cast<hsize_t>(checked(H5Sget_simple_extent_npoints(space), "get the size of a dimension"));
  return scale;
}

}  // namespace

Handle write(hid_t parent, const Label& label, const Shape& shape, const std::vector<double>& values) {
  return described(chunked(parent, label.name, H5T_NATIVE_DOUBLE, shape, values.data()), label);
}

Handle write(hid_t parent, const Label& label, const Shape& shape, const std::vector<int>& values) {
  return described(chunked(parent, label.name, H5T_NATIVE_INT, shape, values.data()), label);
}

Handle write(hid_t parent, const Label& label, const Shape& shape, const std::vector<std::byte>& values) {
  return described(chunked(parent, label.name, H5T_NATIVE_UINT8, shape, values.data()), label);
}

Handle write(hid_t parent, const Label& label, const Shape& shape, const std::vector<std::string>& values) {
  const PaddedTexts texts(values);
  return plain(parent, label, text_type(texts.size), shape, texts.data());
}

Handle write(hid_t parent, const Label& label, const Shape& scalar, double value) {
  return plain(parent, label, H5T_NATIVE_DOUBLE, scalar, &value);
}

Handle write(hid_t parent, const Label& label, const Shape& scalar, long value) {
  return plain(parent, label, H5T_NATIVE_LONG, scalar, &value);
}

Handle write(hid_t parent, const Label& label, const Shape& scalar, const std::string& value) {
  return plain(parent, label, text_type(value.size()), scalar, value.empty() ? nullptr : value.data());
}

Handle table(hid_t parent, const char* name, const char* long_name, hid_t row_type, std::size_t rows, const void* data,
             const std::vector<std::string>& units, const std::vector<std::string>& field_long_names) {
  Handle made = chunked(parent, name, row_type, {rows}, data);
  attribute(made, "units", units);
  attribute(made, "long_name", std::string(long_name));
  attribute(made, "field_long_names", field_long_names);
  return made;
}

// The start of a name by which readers of netCDF identify a dimension without coordinates.
constexpr const char* without_coordinates = "This is a netCDF dimension but not a netCDF variable.";

// Variable-length texts, which xarray returns as str.
Scale scale(hid_t parent, const char* name, const std::vector<std::string>& labels) {
  std::vector<const char*> pointers;
  for (const std::string& label : labels) pointers.push_back(label.c_str());
  plain(parent, {name, "text", "labels of the dimension"}, text_type(H5T_VARIABLE), {labels.size()},
        labels.empty() ? nullptr : pointers.data());
  Scale made = make_scale(parent, name, name);
  made.labels = labels;
  return made;
}

Scale scale(hid_t parent, const char* name, hsize_t size) {
  plain(parent, {name, "1", "size of the dimension"}, H5T_IEEE_F32BE, {size}, nullptr);
  return make_scale(parent, name, without_coordinates);
}

Scale make_scale(hid_t parent, const char* name) { return make_scale(parent, name, name); }

void hide(hid_t parent, const char* name) { make_scale(parent, name, without_coordinates); }

Handle reference_lists() {
  return {H5Tvlen_create(H5T_STD_REF_OBJ), H5Tclose, "create the type of a list of references"};
}

void attach(hid_t array, std::vector<hobj_ref_t> scales) {
  std::vector<hvl_t> lists;
  for (hobj_ref_t& scale : scales) lists.push_back({1, &scale});
  write_attribute(array, dimension_list, reference_lists(), dataspace({lists.size()}), lists.data());
}

void attach(hid_t array, const std::vector<const Scale*>& scales) {
  if (scales.empty()) return;
  std::vector<hobj_ref_t> references;
  for (const Scale* scale : scales) {
    references.push_back(scale->reference);
    if (scale->attribute) attribute(array, scale->attribute, scale->labels);
  }
  attach(array, std::move(references));
}

}  // namespace pounding::hdf5
