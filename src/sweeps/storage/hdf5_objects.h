// Owning wrappers of HDF5 objects; HDF5 errors become FileError.
#pragma once

#include <hdf5.h>

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include "pintle/results.h"

namespace pintle {

/// An identifier that is closed by its own function.
class Hdf5 {
 public:
  using Close = herr_t (*)(hid_t);
  Hdf5(hid_t id, Close close, const std::string& doing);
  Hdf5(Hdf5&& other) noexcept : id_(other.id_), close_(other.close_) { other.id_ = -1; }
  Hdf5(const Hdf5&) = delete;
  Hdf5& operator=(const Hdf5&) = delete;
  ~Hdf5() {
    if (id_ >= 0) close_(id_);
  }
  operator hid_t() const { return id_; }

 private:
  hid_t id_;
  Close close_;
};

/// Throws FileError if a call to HDF5 failed.
void demand(herr_t result, const std::string& doing);
/// From now on HDF5 prints nothing, and does nothing when the program exits. To be called before any other HDF5 function.
void silence_hdf5();

/// Text and numbers attached to an object.
void write_attribute(hid_t object, const char* name, const std::string& text);
void write_attribute(hid_t object, const char* name, double number);
void write_attribute(hid_t object, const char* name, std::uint64_t number);
std::string read_text_attribute(hid_t object, const char* name);  ///< "" if there is none

/// A list of texts as a separate data set.
void write_texts(hid_t group, const char* name, const std::vector<std::string>& texts);
std::vector<std::string> read_texts(hid_t group, const char* name);

Hdf5 make_group(hid_t where, const char* name);

/// A table of rows that can grow, written a block of rows at a time.
class Hdf5Table {
 public:
  Hdf5Table(hid_t group, const std::string& name, hid_t type, std::uint64_t columns);
  void append(const void* rows, std::uint64_t n_rows);
  void attribute(const char* name, const std::string& text) const { write_attribute(data_, name, text); }

 private:
  hid_t type_;
  std::uint64_t columns_, rows_ = 0;
  Hdf5 data_;
};

/// The whole of a table.
template <class T>
std::vector<T> read_table(hid_t group, const char* name, hid_t type) {
  const Hdf5 data(H5Dopen2(group, name, H5P_DEFAULT), H5Dclose, name);
  const Hdf5 space(H5Dget_space(data), H5Sclose, name);
  std::vector<T> out(static_cast<std::size_t>(H5Sget_simple_extent_npoints(space)));
  if (!out.empty()) demand(H5Dread(data, type, H5S_ALL, H5S_ALL, H5P_DEFAULT, out.data()), name);
  return out;
}

}  // namespace pintle
