/// Datasets that all ranks write or read together: each its rows of a table, one rank's after the other's.
///
/// On one rank the file is an ordinary one; on more, MPI-IO's. Calls that fail throw on all ranks alike.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "io/hdf5_handle.hpp"

namespace titin {

/// This rank's rows among those of all ranks.
struct Slab {
  std::uint64_t first = 0, count = 0, total = 0;
  static Slab of(std::uint64_t count);  ///< collective
};

class ParallelHdf5 {
 public:
  enum class Mode { create, read, change };
  /// `head`: bytes kept free in front, a power of two from 512 on, or 0. Collective. Throws std::runtime_error.
  ParallelHdf5(const std::string& path, Mode mode, std::uint64_t head = 0);

  /// A dataset of `slab.total` rows of `width` numbers (0: of one dimension); compressed if level > 0, on one rank or
  /// many. Groups in its name are made. Collective.
  template <class T>
  void write(const std::string& name, const Slab& slab, int width, const T* values, int level = 0) {
    write(name, type<T>(), slab, width, values, level);
  }
  /// Rows behind those that a dataset has; it is made with the first. Collective.
  template <class T>
  void append(const std::string& name, const Slab& slab, int width, const T* values, int level = 0) {
    append(name, type<T>(), slab, width, values, level);
  }
  void cut_off(const std::string& name, std::uint64_t rows);  ///< leaves so many rows of one that was appended to
  void make_group(const std::string& name);
  std::vector<std::string> names_in(const std::string& group) const;
  /// These rows of a dataset; slab.total is not asked for. Collective; each rank reads what it likes.
  template <class T>
  std::vector<T> read(const std::string& name, std::uint64_t first, std::uint64_t count) {
    const std::vector<hsize_t> shape = this->shape(name);
    check(first + count <= shape[0] && first + count >= first, name + " is too short");
    std::vector<T> values(count * shape[1]);
    read(name, type<T>(), first, count, values.data());
    return values;
  }
  bool has(const std::string& name) const;
  std::uint64_t rows(const std::string& name) const;   ///< 0 when it is not there
  std::uint64_t width(const std::string& name) const;  ///< numbers in a row
  void set_attribute(const std::string& name, const std::string& attribute, std::uint64_t value);
  std::uint64_t attribute(const std::string& name, const std::string& attribute) const;
  void set_text(const std::string& name, const std::string& attribute, const std::string& text);
  void set_numbers(const std::string& name, const std::string& attribute, const std::vector<std::int64_t>& numbers);
  hid_t file() const { return file_; }
  /// All is on disk when it returns true, as far as the operating system says. Collective.
  bool close();

 private:
  template <class T>
  static hid_t type();
  void write(const std::string& name, hid_t type, const Slab& slab, int width, const void* values, int level);
  void append(const std::string& name, hid_t type, const Slab& slab, int width, const void* values, int level);
  struct Layout {
    hsize_t rows, width;
    int level;
    bool grows;
  };
  Hdf5Handle create(const std::string& name, hid_t type, const Layout& layout);
  void put(hid_t set, const Slab& slab, hid_t type, const void* values, const std::string& name);
  void read(const std::string& name, hid_t type, std::uint64_t first, std::uint64_t count, void* values);
  std::vector<hsize_t> shape(const std::string& name) const;
  void check(bool ok, const std::string& what) const;

  std::string path_;
  Hdf5Handle file_, transfer_;
};

template <>
inline hid_t ParallelHdf5::type<double>() {
  return H5T_NATIVE_DOUBLE;
}
template <>
inline hid_t ParallelHdf5::type<float>() {
  return H5T_NATIVE_FLOAT;
}
template <>
inline hid_t ParallelHdf5::type<std::int64_t>() {
  return H5T_NATIVE_INT64;
}
template <>
inline hid_t ParallelHdf5::type<std::uint8_t>() {
  return H5T_NATIVE_UINT8;
}

}  // namespace titin
