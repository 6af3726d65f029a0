// The history as HDF5, read back: what history.csv holds, column by column, to the last bit.
#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>
#include <fstream>

#include "base/parallel.hpp"
#include "io/history_hdf5.hpp"
#include "io/parallel_hdf5.hpp"

namespace titin {
namespace {

namespace fs = std::filesystem;

std::string scratch(const std::string& name) {
  return (fs::path(testing::TempDir()) / ("titin_hdf5_" + std::to_string(ranks()) + name)).string();
}

std::string text_attribute(const ParallelHdf5& file, const std::string& name, const std::string& attribute) {
  const Hdf5Handle set(H5Dopen2(file.file(), name.c_str(), H5P_DEFAULT), H5Dclose);
  const Hdf5Handle handle(H5Aopen(set, attribute.c_str(), H5P_DEFAULT), H5Aclose), type(H5Aget_type(handle), H5Tclose);
  std::string text(H5Tget_size(type), '?');
  EXPECT_GE(H5Aread(handle, type, text.data()), 0) << name;
  return text.c_str();
}

TEST(HistoryHdf5, HoldsEveryNumberOfTheCsvWithItsUnit) {
  const std::string csv = scratch("history.csv"), h5 = scratch("history.h5");
  const std::vector<Column> columns = {{"time", "s"}, {"mean_stretch", ""}, {"reaction_a/b%_x", "N"}};
  const auto row = [](long n) {
    return std::vector<double>{0.1 * n, n == 7 ? std::nan("") : 1.0 / (n + 1), -2e-300 * n};
  };
  TimeSeries series(csv, columns);
  const long all = 5000, rows = 4999;  // more than one block; a row that was written later stays out
  for (long n = 0; n < all; ++n) series.add(row(n));
  write_history_hdf5(csv, columns, 3, h5);
  write_history_hdf5(csv, columns, rows, h5);
  {
    ParallelHdf5 file(h5, ParallelHdf5::Mode::read);
    EXPECT_EQ(file.names_in("/").size(), columns.size());
    const char* const names[] = {"time", "mean_stretch", "reaction_a%2Fb%25_x"};
    for (std::uint64_t k = 0; k < columns.size(); ++k) {
      ASSERT_EQ(file.rows(names[k]), std::uint64_t(rows));
      EXPECT_EQ(file.attribute(names[k], "column"), k);
      EXPECT_EQ(text_attribute(file, names[k], "unit"), columns[k].unit);
      const auto values = file.read<double>(names[k], 0, rows);
      for (long n = 0; n < rows; ++n)
        ASSERT_TRUE(values[n] == row(n)[k] || (std::isnan(values[n]) && std::isnan(row(n)[k]))) << names[k] << n;
    }
  }
  any_of(false);
  EXPECT_FALSE(fs::exists(h5 + ".part"));
  EXPECT_THROW(write_history_hdf5(csv, columns, all + 1, h5), std::runtime_error) << "no row is made up";
  EXPECT_THROW(write_history_hdf5(csv, {{"time", "s"}}, rows, h5), std::runtime_error);
  any_of(false);
  if (is_root())
    for (const std::string& name : {csv, h5, h5 + ".part"}) fs::remove(name);
}

}  // namespace
}  // namespace titin
