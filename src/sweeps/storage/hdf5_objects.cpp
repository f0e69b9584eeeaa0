#ifdef PINTLE_HDF5

#include "sweeps/storage/hdf5_objects.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>

namespace pintle {
namespace {

constexpr std::uint64_t kChunkBytes = std::uint64_t{1} << 17U;

Hdf5 text_type() {
  Hdf5 type(H5Tcopy(H5T_C_S1), H5Tclose, "text");
  demand(H5Tset_size(type, H5T_VARIABLE), "text");
  demand(H5Tset_cset(type, H5T_CSET_UTF8), "text");
  return type;
}

void write_one(hid_t object, const char* name, hid_t type, const void* value) {
  const Hdf5 space(H5Screate(H5S_SCALAR), H5Sclose, name);
  const Hdf5 attribute(H5Acreate2(object, name, type, space, H5P_DEFAULT, H5P_DEFAULT), H5Aclose, name);
  demand(H5Awrite(attribute, type, value), name);
}

// Chunks of whole rows if they fit; the bytes are the same every time the file is written.
Hdf5 table_properties(hid_t type, std::uint64_t columns) {
  Hdf5 properties(H5Pcreate(H5P_DATASET_CREATE), H5Pclose, "table");
  const std::uint64_t row = std::max<std::uint64_t>(1, columns * H5Tget_size(type));
  const std::array<hsize_t, 2> chunk{std::max<std::uint64_t>(1, kChunkBytes / row), std::max<std::uint64_t>(1, columns)};
  demand(H5Pset_chunk(properties, columns == 0 ? 1 : 2, chunk.data()), "table");
  demand(H5Pset_obj_track_times(properties, false), "table");
  return properties;
}

Hdf5 make_table(hid_t group, const std::string& name, hid_t type, std::uint64_t columns) {
  const int rank = columns == 0 ? 1 : 2;
  const std::array<hsize_t, 2> size{0, columns}, most{H5S_UNLIMITED, columns};
  const Hdf5 space(H5Screate_simple(rank, size.data(), most.data()), H5Sclose, name);
  const Hdf5 properties = table_properties(type, columns);
  return {H5Dcreate2(group, name.c_str(), type, space, H5P_DEFAULT, properties, H5P_DEFAULT), H5Dclose, name};
}

}  // namespace

Hdf5::Hdf5(hid_t id, Close close, const std::string& doing) : id_(id), close_(close) {
  if (id < 0) throw FileError("HDF5 refuses: " + doing);
}

void demand(herr_t result, const std::string& doing) {
  if (result < 0) throw FileError("HDF5 refuses: " + doing);
}

void silence_hdf5() {
  static const herr_t no_exit_handler = H5dont_atexit();  // it crashes if a file could not be written
  demand(no_exit_handler, "to start");
  H5Eset_auto2(H5E_DEFAULT, nullptr, nullptr);
}

void write_attribute(hid_t object, const char* name, const std::string& text) {
  const char* chars = text.c_str();
  write_one(object, name, text_type(), &chars);
}

void write_attribute(hid_t object, const char* name, double number) { write_one(object, name, H5T_NATIVE_DOUBLE, &number); }
void write_attribute(hid_t object, const char* name, std::uint64_t number) { write_one(object, name, H5T_NATIVE_UINT64, &number); }

std::string read_text_attribute(hid_t object, const char* name) {
  if (H5Aexists(object, name) <= 0) return {};
  const Hdf5 attribute(H5Aopen(object, name, H5P_DEFAULT), H5Aclose, name);
  char* chars = nullptr;
  const Hdf5 type = text_type();
  demand(H5Aread(attribute, type, &chars), name);
  std::string text = chars == nullptr ? "" : chars;
  H5free_memory(chars);
  return text;
}

void write_texts(hid_t group, const char* name, const std::vector<std::string>& texts) {
  const hsize_t size = texts.size();
  const Hdf5 space(H5Screate_simple(1, &size, nullptr), H5Sclose, name), type = text_type(), properties(H5Pcreate(H5P_DATASET_CREATE), H5Pclose, name);
  demand(H5Pset_obj_track_times(properties, false), name);
  const Hdf5 data(H5Dcreate2(group, name, type, space, H5P_DEFAULT, properties, H5P_DEFAULT), H5Dclose, name);
  std::vector<const char*> chars;
  for (const std::string& text : texts) chars.push_back(text.c_str());
  if (!texts.empty()) demand(H5Dwrite(data, type, H5S_ALL, H5S_ALL, H5P_DEFAULT, chars.data()), name);
}

std::vector<std::string> read_texts(hid_t group, const char* name) {
  const Hdf5 type = text_type(), data(H5Dopen2(group, name, H5P_DEFAULT), H5Dclose, name), space(H5Dget_space(data), H5Sclose, name);
  std::vector<char*> chars(static_cast<std::size_t>(H5Sget_simple_extent_npoints(space)));
  if (!chars.empty()) demand(H5Dread(data, type, H5S_ALL, H5S_ALL, H5P_DEFAULT, chars.data()), name);
  std::vector<std::string> out(chars.begin(), chars.end());
  for (char* text : chars) H5free_memory(text);
  return out;
}

Hdf5 make_group(hid_t where, const char* name) {
  const Hdf5 properties(H5Pcreate(H5P_GROUP_CREATE), H5Pclose, name);
  demand(H5Pset_obj_track_times(properties, false), name);
  return {H5Gcreate2(where, name, H5P_DEFAULT, properties, H5P_DEFAULT), H5Gclose, name};
}

Hdf5Table::Hdf5Table(hid_t group, const std::string& name, hid_t type, std::uint64_t columns)
    : type_(type), columns_(columns), data_(make_table(group, name, type, columns)) {}

void Hdf5Table::append(const void* rows, std::uint64_t n_rows) {
  const int rank = columns_ == 0 ? 1 : 2;
  const std::array<hsize_t, 2> first{rows_, 0}, count{n_rows, columns_}, size{rows_ + n_rows, columns_};
  demand(H5Dset_extent(data_, size.data()), "to grow a table");
  rows_ += n_rows;
  const Hdf5 space(H5Dget_space(data_), H5Sclose, "table"), memory(H5Screate_simple(rank, count.data(), nullptr), H5Sclose, "table");
  demand(H5Sselect_hyperslab(space, H5S_SELECT_SET, first.data(), nullptr, count.data(), nullptr), "table");
  demand(H5Dwrite(data_, type_, memory, space, H5P_DEFAULT, rows), "to write a table (is the disk full?)");
}

}  // namespace pintle

#endif
