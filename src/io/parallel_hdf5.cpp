#include "io/parallel_hdf5.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <stdexcept>

#include "base/parallel.hpp"

namespace titin {
namespace {

constexpr hsize_t rows_of_chunk = 16384;  // compressed at a time: some hundred kilobytes

}  // namespace

Slab Slab::of(std::uint64_t count) {
  std::vector<double> counts(ranks());  // exact up to 2^53
  counts[rank()] = static_cast<double>(count);
  sum(counts);
  Slab slab{0, count, 0};
  for (int r = 0; r < ranks(); ++r) {
    if (r < rank()) slab.first += static_cast<std::uint64_t>(counts[r]);
    slab.total += static_cast<std::uint64_t>(counts[r]);
  }
  return slab;
}

ParallelHdf5::ParallelHdf5(const std::string& path, Mode mode, std::uint64_t head) : path_(path) {
  H5Eset_auto2(H5E_DEFAULT, nullptr, nullptr);
  const Hdf5Handle access(H5Pcreate(H5P_FILE_ACCESS), H5Pclose), creation(H5Pcreate(H5P_FILE_CREATE), H5Pclose);
  transfer_ = {H5Pcreate(H5P_DATASET_XFER), H5Pclose};
  if (ranks() > 1) {
    H5Pset_fapl_mpio(access, MPI_COMM_WORLD, MPI_INFO_NULL);
    H5Pset_all_coll_metadata_ops(access, true);
    H5Pset_coll_metadata_write(access, true);
    H5Pset_dxpl_mpio(transfer_, H5FD_MPIO_COLLECTIVE);
  }
  if (head > 0) H5Pset_userblock(creation, head);
  if (mode == Mode::change)
    file_ = {H5Fopen(path.c_str(), H5F_ACC_RDWR, access), H5Fclose};
  else if (mode == Mode::create)
    file_ = {H5Fcreate(path.c_str(), H5F_ACC_TRUNC, creation, access), H5Fclose};
  else
    file_ = {H5Fopen(path.c_str(), H5F_ACC_RDONLY, access), H5Fclose};
  check(file_.ok(), "cannot be opened");
}

void ParallelHdf5::check(bool ok, const std::string& what) const {
  if (any_of(!ok)) throw std::runtime_error(fmt::format("{}: {}", path_, what));
}

/// Lays out a dataset of `rows` rows; in chunks where it is to grow or to be compressed.
Hdf5Handle ParallelHdf5::create(const std::string& name, hid_t type, const Layout& layout) {
  const int rank = layout.width > 0 ? 2 : 1;
  const hsize_t width = layout.width, shape[] = {layout.rows, width};
  const hsize_t most[] = {layout.grows ? H5S_UNLIMITED : layout.rows, width};
  const Hdf5Handle links(H5Pcreate(H5P_LINK_CREATE), H5Pclose), creation(H5Pcreate(H5P_DATASET_CREATE), H5Pclose);
  H5Pset_create_intermediate_group(links, 1);
  if (layout.grows || (layout.level > 0 && layout.rows > 0)) {
    const hsize_t chunk[] = {std::clamp(layout.rows, hsize_t(1), rows_of_chunk), width};
    H5Pset_chunk(creation, rank, chunk);
    if (layout.level > 0) {
      H5Pset_shuffle(creation);
      H5Pset_deflate(creation, layout.level);
    }
  }
  const Hdf5Handle space(H5Screate_simple(rank, shape, most), H5Sclose);
  Hdf5Handle set(H5Dcreate2(file_, name.c_str(), type, space, links, creation, H5P_DEFAULT), H5Dclose);
  check(set.ok(), name + " cannot be written");
  return set;
}

/// This rank's rows into a dataset of `total` rows.
void ParallelHdf5::put(hid_t set, const Slab& slab, hid_t type, const void* values, const std::string& name) {
  const Hdf5Handle space(H5Dget_space(set), H5Sclose);
  const int rank = H5Sget_simple_extent_ndims(space);
  hsize_t shape[] = {0, 1};
  H5Sget_simple_extent_dims(space, shape, nullptr);
  const hsize_t first[] = {slab.first, 0}, count[] = {slab.count, shape[1]};
  const Hdf5Handle memory(H5Screate_simple(rank, count, nullptr), H5Sclose);
  if (slab.count > 0) {
    H5Sselect_hyperslab(space, H5S_SELECT_SET, first, nullptr, count, nullptr);
  } else {
    H5Sselect_none(space);
    H5Sselect_none(memory);
  }
  check(slab.total == 0 || H5Dwrite(set, type, memory, space, transfer_, values) >= 0, name + " cannot be written");
}

void ParallelHdf5::write(const std::string& name, hid_t type, const Slab& slab, int width, const void* values,
                         int level) {
  Hdf5Handle set = create(name, type, {slab.total, hsize_t(width), level, false});
  put(set, slab, type, values, name);
  check(set.close(), name + " cannot be written");
}

void ParallelHdf5::append(const std::string& name, hid_t type, const Slab& slab, int width, const void* values,
                          int level) {
  const bool there = has(name);
  const std::uint64_t before = there ? rows(name) : 0;
  Hdf5Handle set = there ? Hdf5Handle(H5Dopen2(file_, name.c_str(), H5P_DEFAULT), H5Dclose)
                         : create(name, type, {slab.total, hsize_t(width), level, true});
  const hsize_t shape[] = {before + slab.total, hsize_t(width)};
  check(!there || H5Dset_extent(set, shape) >= 0, name + " cannot be extended");
  put(set, {before + slab.first, slab.count, slab.total}, type, values, name);
  check(set.close(), name + " cannot be written");
}

void ParallelHdf5::cut_off(const std::string& name, std::uint64_t rows) {
  std::vector<hsize_t> shape = this->shape(name);
  check(shape[0] >= rows, name + " is too short");
  shape[0] = rows;
  const Hdf5Handle set(H5Dopen2(file_, name.c_str(), H5P_DEFAULT), H5Dclose);
  check(H5Dset_extent(set, shape.data()) >= 0, name + " cannot be cut off");
}

void ParallelHdf5::make_group(const std::string& name) {
  const Hdf5Handle group(H5Gcreate2(file_, name.c_str(), H5P_DEFAULT, H5P_DEFAULT, H5P_DEFAULT), H5Gclose);
  check(group.ok(), name + " cannot be written");
}

std::vector<std::string> ParallelHdf5::names_in(const std::string& group) const {
  const Hdf5Handle handle(H5Gopen2(file_, group.c_str(), H5P_DEFAULT), H5Gclose);
  std::vector<std::string> names;
  H5G_info_t info{};
  if (handle.ok()) H5Gget_info(handle, &info);
  for (hsize_t i = 0; i < info.nlinks; ++i) {
    char name[256] = "";
    H5Lget_name_by_idx(handle, ".", H5_INDEX_NAME, H5_ITER_INC, i, name, sizeof name, H5P_DEFAULT);
    names.emplace_back(name);
  }
  return names;
}

std::vector<hsize_t> ParallelHdf5::shape(const std::string& name) const {
  const Hdf5Handle set(H5Dopen2(file_, name.c_str(), H5P_DEFAULT), H5Dclose);
  if (!set.ok()) return {0, 1};
  const Hdf5Handle space(H5Dget_space(set), H5Sclose);
  const int rank = H5Sget_simple_extent_ndims(space);
  check(rank == 1 || rank == 2, name + " is no table");
  std::vector<hsize_t> shape(2, 1);
  H5Sget_simple_extent_dims(space, shape.data(), nullptr);
  return shape;
}

std::uint64_t ParallelHdf5::rows(const std::string& name) const { return shape(name)[0]; }
std::uint64_t ParallelHdf5::width(const std::string& name) const { return shape(name)[1]; }
bool ParallelHdf5::has(const std::string& name) const {
  return Hdf5Handle(H5Dopen2(file_, name.c_str(), H5P_DEFAULT), H5Dclose).ok();
}

void ParallelHdf5::read(const std::string& name, hid_t type, std::uint64_t first, std::uint64_t count, void* values) {
  const std::vector<hsize_t> all = shape(name);
  const Hdf5Handle set(H5Dopen2(file_, name.c_str(), H5P_DEFAULT), H5Dclose);
  check(set.ok(), name + " is missing");
  const Hdf5Handle space(H5Dget_space(set), H5Sclose);
  const hsize_t start[] = {first, 0}, size[] = {count, all[1]};
  const int rank = H5Sget_simple_extent_ndims(space);
  const Hdf5Handle memory(H5Screate_simple(rank, size, nullptr), H5Sclose);
  if (count > 0) {
    H5Sselect_hyperslab(space, H5S_SELECT_SET, start, nullptr, size, nullptr);
  } else {
    H5Sselect_none(space);
    H5Sselect_none(memory);
  }
  check(all[0] == 0 || H5Dread(set, type, memory, space, transfer_, values) >= 0, name + " cannot be read");
}

void ParallelHdf5::set_attribute(const std::string& name, const std::string& attribute, std::uint64_t value) {
  const Hdf5Handle set(H5Oopen(file_, name.c_str(), H5P_DEFAULT), H5Oclose);
  const Hdf5Handle space(H5Screate(H5S_SCALAR), H5Sclose);
  const Hdf5Handle handle(H5Acreate2(set, attribute.c_str(), H5T_STD_U64LE, space, H5P_DEFAULT, H5P_DEFAULT), H5Aclose);
  check(handle.ok() && H5Awrite(handle, H5T_NATIVE_UINT64, &value) >= 0, name + " cannot be written");
}

void ParallelHdf5::set_text(const std::string& name, const std::string& attribute, const std::string& text) {
  const Hdf5Handle object(H5Oopen(file_, name.c_str(), H5P_DEFAULT), H5Oclose);
  const Hdf5Handle type(H5Tcopy(H5T_C_S1), H5Tclose), space(H5Screate(H5S_SCALAR), H5Sclose);
  H5Tset_size(type, std::max<std::size_t>(text.size(), 1));  // of this length: VTK reads no others
  H5Tset_strpad(type, H5T_STR_NULLPAD);
  const Hdf5Handle handle(H5Acreate2(object, attribute.c_str(), type, space, H5P_DEFAULT, H5P_DEFAULT), H5Aclose);
  check(handle.ok() && H5Awrite(handle, type, text.c_str()) >= 0, name + " cannot be written");
}

void ParallelHdf5::set_numbers(const std::string& name, const std::string& attribute,
                               const std::vector<std::int64_t>& numbers) {
  const Hdf5Handle object(H5Oopen(file_, name.c_str(), H5P_DEFAULT), H5Oclose);
  const hsize_t size[] = {numbers.size()};
  const Hdf5Handle space(size[0] == 1 ? H5Screate(H5S_SCALAR) : H5Screate_simple(1, size, nullptr), H5Sclose);
  if (H5Aexists(object, attribute.c_str()) > 0) H5Adelete(object, attribute.c_str());
  const Hdf5Handle handle(H5Acreate2(object, attribute.c_str(), H5T_STD_I64LE, space, H5P_DEFAULT, H5P_DEFAULT),
                          H5Aclose);
  check(handle.ok() && H5Awrite(handle, H5T_NATIVE_INT64, numbers.data()) >= 0, name + " cannot be written");
}

std::uint64_t ParallelHdf5::attribute(const std::string& name, const std::string& attribute) const {
  const Hdf5Handle set(H5Oopen(file_, name.c_str(), H5P_DEFAULT), H5Oclose);
  const Hdf5Handle handle(H5Aopen(set, attribute.c_str(), H5P_DEFAULT), H5Aclose);
  std::uint64_t value = 0;
  check(handle.ok() && H5Aread(handle, H5T_NATIVE_UINT64, &value) >= 0, fmt::format("{} has no {}", name, attribute));
  return value;
}

bool ParallelHdf5::close() {
  const bool flushed = H5Fflush(file_, H5F_SCOPE_GLOBAL) >= 0;
  return !any_of(!(file_.close() && flushed));
}

}  // namespace titin
