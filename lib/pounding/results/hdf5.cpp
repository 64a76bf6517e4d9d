#include <pounding/results/hdf5.hpp>

#include <algorithm>
#include <stdexcept>

namespace pounding::hdf5 {
namespace {

/// Silences HDF5's own printing while it lives; a host program's handler comes back afterwards.
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

Handle dataspace(const std::vector<hsize_t>& shape, const hsize_t* limits = nullptr) {
  const int rank = static_cast<int>(shape.size());
  return {rank == 0 ? H5Screate(H5S_SCALAR) : H5Screate_simple(rank, shape.data(), limits), H5Sclose, "make a shape"};
}

void write_attribute(hid_t object, const char* name, hid_t type, hid_t space, const void* data) {
  const Handle made(H5Acreate2(object, name, type, space, H5P_DEFAULT, H5P_DEFAULT), H5Aclose,
                    std::string("create attribute ") + name);
  // HDF5 refuses the null pointer of an empty list, which has nothing to write.
  if (data != nullptr) checked(H5Awrite(made, type, data), std::string("write attribute ") + name);
}

Handle dataset(hid_t parent, const char* name, hid_t type, hid_t space, hid_t creation, const void* data) {
  Handle made(H5Dcreate2(parent, name, type, space, H5P_DEFAULT, creation, H5P_DEFAULT), H5Dclose,
              std::string("create dataset ") + name);
  checked(H5Dwrite(made, type, H5S_ALL, H5S_ALL, H5P_DEFAULT, data), std::string("write dataset ") + name);
  return made;
}

constexpr hsize_t values_in_a_chunk = 1 << 14;
/// A chunked dataset that may have no rows or no columns, although HDF5 allows no empty chunk. Not compressed: deflate makes histories
/// of a motion a quarter smaller and takes twice the time of the run that made them.
Handle chunked(hid_t parent, const char* name, hid_t type, const std::vector<hsize_t>& shape, const void* data) {
  hsize_t row = 1;
  for (std::size_t i = 1; i < shape.size(); ++i) row *= std::max<hsize_t>(1, shape[i]);

  std::vector<hsize_t> chunk(shape), limits(shape);
  for (std::size_t i = 1; i < shape.size(); ++i) limits[i] = chunk[i] = std::max<hsize_t>(1, shape[i]);
  const hsize_t rows = std::max<hsize_t>(1, shape[0]), chunks = (rows * row + values_in_a_chunk - 1) / values_in_a_chunk;
  chunk[0] = (rows + chunks - 1) / chunks;  // alike, since the last one is stored whole
  limits[0] = H5S_UNLIMITED;

  const Handle creation(H5Pcreate(H5P_DATASET_CREATE), H5Pclose, "describe a dataset");
  checked(H5Pset_chunk(creation, static_cast<int>(chunk.size()), chunk.data()), "set the chunks");
  return dataset(parent, name, type, dataspace(shape, limits.data()), creation, data);
}

void describe(hid_t object, const Label& label) {
  attribute(object, "units", std::string(label.units));
  attribute(object, "long_name", std::string(label.long_name));
}

}  // namespace

hid_t checked(hid_t status, std::string_view action) {
  if (status >= 0) return status;
  std::string message = "HDF5 could not " + std::string(action);
  const auto append = [](unsigned, const H5E_error2_t* error, void* target) -> herr_t {
    if (error->desc != nullptr) static_cast<std::string*>(target)->append(": ").append(error->desc);
    return 0;
  };
  H5Ewalk2(H5E_DEFAULT, H5E_WALK_DOWNWARD, append, &message);
  throw std::runtime_error(message);
}

std::vector<std::byte> file_image(const std::function<void(hid_t file)>& write) {
  const Quiet quiet;
  constexpr std::size_t growth = std::size_t{1} << 20;
  const Handle access(H5Pcreate(H5P_FILE_ACCESS), H5Pclose, "describe a file");
  checked(H5Pset_fapl_core(access, growth, false), "choose a file in memory");
  const Handle file(H5Fcreate("results in memory", H5F_ACC_TRUNC, H5P_DEFAULT, access), H5Fclose, "create a file");
  write(file);
  checked(H5Fflush(file, H5F_SCOPE_GLOBAL), "complete the file");
  std::vector<std::byte> image(static_cast<std::size_t>(checked(H5Fget_file_image(file, nullptr, 0), "size the file")));
  checked(H5Fget_file_image(file, image.data(), image.size()), "copy the file");
  return image;
}

Handle group(hid_t parent, const std::string& name) {
  const Handle creation(H5Pcreate(H5P_GROUP_CREATE), H5Pclose, "describe a group");
  checked(H5Pset_link_creation_order(creation, H5P_CRT_ORDER_TRACKED | H5P_CRT_ORDER_INDEXED), "keep the order");
  return {H5Gcreate2(parent, name.c_str(), H5P_DEFAULT, creation, H5P_DEFAULT), H5Gclose, "create group " + name};
}

Handle text_type(std::size_t size) {
  Handle type(H5Tcopy(H5T_C_S1), H5Tclose, "make a text type");
  checked(H5Tset_size(type, size), "size a text type");
  checked(H5Tset_cset(type, H5T_CSET_UTF8), "make a text type UTF-8");
  if (size != H5T_VARIABLE) checked(H5Tset_strpad(type, H5T_STR_NULLPAD), "pad a text type");
  return type;
}

void attribute(hid_t object, const char* name, const std::string& value) {
  const char* pointer = value.c_str();
  write_attribute(object, name, text_type(), dataspace({}), &pointer);
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
  write_attribute(object, name, text_type(), dataspace({pointers.size()}), pointers.data());
}

void attribute(hid_t object, const char* name, const std::vector<double>& values) {
  write_attribute(object, name, H5T_NATIVE_DOUBLE, dataspace({values.size()}), values.data());
}

Handle integers(hid_t parent, const Label& label, const std::vector<int>& values, const std::vector<hsize_t>& shape) {
  Handle made = chunked(parent, label.name, H5T_NATIVE_INT, shape, values.data());
  describe(made, label);
  return made;
}

void texts(hid_t parent, const char* name, const char* long_name, const std::vector<std::string>& values) {
  std::vector<const char*> pointers;
  for (const std::string& value : values) pointers.push_back(value.c_str());
  describe(dataset(parent, name, text_type(), dataspace({pointers.size()}), H5P_DEFAULT, pointers.data()), {name, "text", long_name});
}

Handle array(hid_t parent, const Label& label, const std::vector<double>& values, const std::vector<hsize_t>& shape) {
  Handle made = chunked(parent, label.name, H5T_NATIVE_DOUBLE, shape, values.data());
  describe(made, label);
  return made;
}

void text(hid_t parent, const char* name, const char* long_name, const std::string& value) {
  const char* pointer = value.c_str();
  describe(dataset(parent, name, text_type(), dataspace({}), H5P_DEFAULT, &pointer), {name, "text", long_name});
}

void scalar(hid_t parent, const Label& label, long value) {
  describe(dataset(parent, label.name, H5T_NATIVE_LONG, dataspace({}), H5P_DEFAULT, &value), label);
}

void scalar(hid_t parent, const Label& label, double value) {
  describe(dataset(parent, label.name, H5T_NATIVE_DOUBLE, dataspace({}), H5P_DEFAULT, &value), label);
}

void table(hid_t parent, const char* name, const char* long_name, hid_t row_type, std::size_t rows, const void* data,
           const std::vector<std::string>& units, const std::vector<std::string>& field_long_names) {
  const Handle made = chunked(parent, name, row_type, {rows}, data);
  attribute(made, "units", units);
  attribute(made, "long_name", std::string(long_name));
  attribute(made, "field_long_names", field_long_names);
}

void bytes(hid_t parent, const char* name, const char* long_name, const std::vector<std::byte>& values) {
  describe(chunked(parent, name, H5T_NATIVE_UINT8, {values.size()}, values.data()), {name, "byte", long_name});
}

namespace {

std::vector<std::string> members_of(hid_t group) {
  std::vector<std::string> found;
  const auto add = [](hid_t, const char* name, const H5L_info_t*, void* target) -> herr_t {
    static_cast<std::vector<std::string>*>(target)->emplace_back(name);
    return 0;
  };
  checked(H5Literate(group, H5_INDEX_NAME, H5_ITER_INC, nullptr, add, &found), "list a group");
  return found;
}

// Copies all members and the attributes, which are texts, of a group or of the root of a file.
void copy_content(hid_t from, hid_t to, const std::set<std::string>& but) {
  std::vector<std::string> attributes;
  const auto list_attribute = [](hid_t, const char* name, const H5A_info_t*, void* target) -> herr_t {
    static_cast<std::vector<std::string>*>(target)->emplace_back(name);
    return 0;
  };
  checked(H5Aiterate2(from, H5_INDEX_NAME, H5_ITER_INC, nullptr, list_attribute, &attributes), "list attributes");
  for (const std::string& name : attributes) attribute(to, name.c_str(), read_attribute(from, name.c_str()));
  for (const std::string& name : members_of(from))
    if (!but.contains(name)) checked(H5Ocopy(from, name.c_str(), to, name.c_str(), H5P_DEFAULT, H5P_DEFAULT), "copy " + name);
}

}  // namespace

void add_file(hid_t file, const std::string& name, const std::vector<std::byte>& image, const std::set<std::string>& but) {
  const Handle access(H5Pcreate(H5P_FILE_ACCESS), H5Pclose, "describe a file");
  checked(H5Pset_fapl_core(access, image.size(), false), "choose a file in memory");
  std::vector<std::byte> bytes = image;  // HDF5 asks for a buffer that it may change, and copies it
  checked(H5Pset_file_image(access, bytes.data(), bytes.size()), "give a file image");
  const Handle from(H5Fopen("results to add", H5F_ACC_RDONLY, access), H5Fclose, "open a file image");
  copy_content(from, group(file, name), but);
}

std::vector<std::byte> group_image(hid_t file, const std::string& name) {
  const Handle from(H5Gopen2(file, name.c_str(), H5P_DEFAULT), H5Gclose, "open group " + name);
  return file_image([&](hid_t to) { copy_content(from, to, {}); });
}

void open_file(const std::string& path, const std::function<void(hid_t file)>& read) {
  const Quiet quiet;
  const Handle file(H5Fopen(path.c_str(), H5F_ACC_RDONLY, H5P_DEFAULT), H5Fclose, "open the file");
  read(file);
}

bool has(hid_t file, const char* path) { return H5Lexists(file, path, H5P_DEFAULT) > 0; }

std::vector<std::string> members(hid_t file, const char* path) {
  return members_of(Handle(H5Gopen2(file, path, H5P_DEFAULT), H5Gclose, std::string("open group ") + path));
}

namespace {

Handle open_dataset(hid_t file, const char* path) {
  return {H5Dopen2(file, path, H5P_DEFAULT), H5Dclose, std::string("open dataset ") + path};
}

// One text of any length, which HDF5 allocates.
template <class Read>
std::string owned_text(Read&& read, const char* name) {
  char* pointer = nullptr;
  checked(read(&pointer), std::string("read ") + name);
  const std::string value = pointer ? pointer : "";
  H5free_memory(pointer);
  return value;
}

template <class Value>
void read_all(hid_t file, const char* path, hid_t type, std::vector<Value>& values) {
  const Handle dataset = open_dataset(file, path);
  const Handle space(H5Dget_space(dataset), H5Sclose, std::string("size dataset ") + path);
  values.resize(static_cast<std::size_t>(checked(H5Sget_simple_extent_npoints(space), std::string("size dataset ") + path)));
  if (!values.empty())
    checked(H5Dread(dataset, type, H5S_ALL, H5S_ALL, H5P_DEFAULT, values.data()), std::string("read dataset ") + path);
}

}  // namespace

std::vector<std::size_t> shape(hid_t file, const char* path) {
  const Handle dataset = open_dataset(file, path);
  const Handle space(H5Dget_space(dataset), H5Sclose, std::string("size dataset ") + path);
  std::vector<hsize_t> extents(static_cast<std::size_t>(checked(H5Sget_simple_extent_ndims(space), "size a dataset")));
  checked(H5Sget_simple_extent_dims(space, extents.data(), nullptr), "size a dataset");
  return {extents.begin(), extents.end()};
}

std::string read_attribute(hid_t object, const char* name) {
  const Handle made(H5Aopen(object, name, H5P_DEFAULT), H5Aclose, std::string("open attribute ") + name);
  return owned_text([&](char** pointer) { return H5Aread(made, text_type(), pointer); }, name);
}

std::string read_text(hid_t file, const char* path) {
  const Handle dataset = open_dataset(file, path);
  return owned_text([&](char** pointer) { return H5Dread(dataset, text_type(), H5S_ALL, H5S_ALL, H5P_DEFAULT, pointer); },
                    path);
}

void read_array(hid_t file, const char* path, std::vector<double>& values) {
  read_all(file, path, H5T_NATIVE_DOUBLE, values);
}

void read_bytes(hid_t file, const char* path, std::vector<std::byte>& values) {
  read_all(file, path, H5T_NATIVE_UINT8, values);
}

}  // namespace pounding::hdf5
