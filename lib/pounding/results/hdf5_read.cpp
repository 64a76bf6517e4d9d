/// Reading of HDF5 files, and copies between them.

#include <pounding/results/hdf5.hpp>

#include <map>
#include <stdexcept>
#include <utility>

#include <pounding/petsc/library_lock.hpp>
#include <pounding/results/checked_file.hpp>

namespace pounding::hdf5 {
namespace {

template <class Info>
herr_t add_name(hid_t, const char* name, const Info*, void* names) noexcept {
  static_cast<std::vector<std::string>*>(names)->emplace_back(name);
  return 0;
}

std::vector<std::string> members_of(hid_t group) {
  std::vector<std::string> names;
  checked(H5Literate(group, H5_INDEX_NAME, H5_ITER_INC, nullptr, add_name<H5L_info_t>, &names), "list a group");
  return names;
}

// References of a dataset to the scales of its dimensions; empty if it has none.
std::vector<hobj_ref_t> scales_of(hid_t object) {
  if (H5Aexists(object, dimension_list) <= 0) return {};
  const Handle lists(H5Aopen(object, dimension_list, H5P_DEFAULT), H5Aclose, "open the list of dimensions");
  const Handle space(H5Aget_space(lists), H5Sclose, "read the list of dimensions");
  std::vector<hvl_t> read(static_cast<std::size_t>(H5Sget_simple_extent_npoints(space)));
  checked(H5Aread(lists, reference_lists(), read.data()), "read the list of dimensions");
  std::vector<hobj_ref_t> scales;
  for (const hvl_t& list : read) scales.push_back(list.len > 0 ? *static_cast<const hobj_ref_t*>(list.p) : 0);
  checked(H5Dvlen_reclaim(reference_lists(), space, H5P_DEFAULT, read.data()), "read the list of dimensions");
  return scales;
}

}  // namespace

void copy_group(hid_t from, hid_t to, const char* name) {
  checked(H5Ocopy(from, name, to, name, H5P_DEFAULT, H5P_DEFAULT), std::string("copy ") + name);
  const Handle source(H5Gopen2(from, name, H5P_DEFAULT), H5Gclose, "open group ", name),
      copy(H5Gopen2(to, name, H5P_DEFAULT), H5Gclose, "open group ", name);
  std::vector<std::string> places;
  checked(H5Lvisit(source, H5_INDEX_NAME, H5_ITER_INC, add_name<H5L_info_t>, &places), "list a group");
  std::map<hobj_ref_t, hobj_ref_t> copies;  // a copied reference is that of the source
  const auto reference = [](hid_t group, const std::string& place) {
    hobj_ref_t made{};
    checked(H5Rcreate(&made, group, place.c_str(), H5R_OBJECT, -1), "refer to " + place);
    return made;
  };
  for (const std::string& place : places) copies.emplace(reference(source, place), reference(copy, place));
  for (const std::string& place : places) {
    const Handle object(H5Oopen(source, place.c_str(), H5P_DEFAULT), H5Oclose, "open ", place);
    std::vector<hobj_ref_t> scales = scales_of(object);
    if (scales.empty()) continue;
    for (hobj_ref_t& scale : scales) scale = copies.at(scale);
    const Handle made(H5Oopen(copy, place.c_str(), H5P_DEFAULT), H5Oclose, "open ", place);
    checked(H5Adelete(made, dimension_list), "delete the list of dimensions");
    attach(made, std::move(scales));
  }
}

void open_file(const std::string& path, const std::function<void(hid_t file)>& read) {
  require_whole(path);
  const LibraryLock lock;
  const Quiet quiet;
  const Handle file(H5Fopen(path.c_str(), H5F_ACC_RDONLY, H5P_DEFAULT), H5Fclose, "open the file");
  read(file);
}

bool has(hid_t file, const char* path) { return H5Lexists(file, path, H5P_DEFAULT) > 0; }

std::vector<std::string> members(hid_t file, const char* path) {
  return members_of(Handle(H5Gopen2(file, path, H5P_DEFAULT), H5Gclose, "open group ", path));
}

namespace {

Handle open_dataset(hid_t file, const char* path) {
  return {H5Dopen2(file, path, H5P_DEFAULT), H5Dclose, "open dataset ", path};
}

// One text with the fixed length of `type`.
template <class Read>
std::string fixed_text(const Handle& type, Read&& read, const char* name) {
  const std::string action = std::string("read ") + name;
  std::string value(H5Tget_size(type), '\0');
  if (H5Tget_class(type) != H5T_STRING || H5Tis_variable_str(type) > 0)
    throw std::runtime_error(std::string(name) + " is not a text of fixed length");
  checked(read(text_type(value.size()), value.data()), action);
  value.resize(value.find_last_not_of('\0') + 1);
  return value;
}

template <class Value>
void read_all(hid_t file, const char* path, hid_t type, std::vector<Value>& values) {
  const Handle dataset = open_dataset(file, path);
  const Handle space(H5Dget_space(dataset), H5Sclose, "get the size of dataset ", path);
  values.resize(static_cast<std::size_t>(
      checked(H5Sget_simple_extent_npoints(space), std::string("get the size of dataset ") + path)));
  if (!values.empty())
    checked(H5Dread(dataset, type, H5S_ALL, H5S_ALL, H5P_DEFAULT, values.data()), std::string("read dataset ") + path);
}

}  // namespace

std::vector<std::size_t> shape(hid_t file, const char* path) {
  const Handle dataset = open_dataset(file, path);
  const Handle space(H5Dget_space(dataset), H5Sclose, "get the size of dataset ", path);
  std::vector<hsize_t> extents(
      static_cast<std::size_t>(checked(H5Sget_simple_extent_ndims(space), "get the size of a dataset")));
  checked(H5Sget_simple_extent_dims(space, extents.data(), nullptr), "get the size of a dataset");
  return {extents.begin(), extents.end()};
}

std::string read_attribute(hid_t object, const char* name) {
  const Handle made(H5Aopen(object, name, H5P_DEFAULT), H5Aclose, "open attribute ", name);
  const Handle type(H5Aget_type(made), H5Tclose, "read attribute ", name);
  const Handle space(H5Aget_space(made), H5Sclose, "read attribute ", name);
  if (H5Tis_variable_str(type) <= 0 || H5Sget_simple_extent_npoints(space) != 1)
    throw std::runtime_error(std::string("attribute ") + name + " is not a text");
  char* text = nullptr;
  checked(H5Aread(made, text_type(H5T_VARIABLE), &text), std::string("read attribute ") + name);
  std::string value = text != nullptr ? text : "";
  H5free_memory(text);
  return value;
}

std::string read_text(hid_t file, const char* path) {
  const Handle dataset = open_dataset(file, path);
  const Handle type(H5Dget_type(dataset), H5Tclose, "read ", path);
  return fixed_text(
      type, [&](hid_t as, char* text) { return H5Dread(dataset, as, H5S_ALL, H5S_ALL, H5P_DEFAULT, text); }, path);
}

void read_array(hid_t file, const char* path, std::vector<double>& values) {
  read_all(file, path, H5T_NATIVE_DOUBLE, values);
}

void read_bytes(hid_t file, const char* path, std::vector<std::byte>& values) {
  read_all(file, path, H5T_NATIVE_UINT8, values);
}

}  // namespace pounding::hdf5
