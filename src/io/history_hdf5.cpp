#include "io/history_hdf5.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <filesystem>
#include <fstream>
#include <stdexcept>

#include "base/parallel.hpp"
#include "io/output_error.hpp"
#include "io/parallel_hdf5.hpp"

namespace titin {
namespace {

constexpr long block = 4096;  // rows in memory at a time

std::string dataset_of(const Column& column) {
  std::string name;
  for (const char c : column.name) name += c == '/' ? "%2F" : c == '%' ? "%25" : std::string(1, c);
  return name;
}

/// Adds the numbers of a row to their columns; false unless there is one for each.
bool take_row(const std::string& line, std::vector<std::vector<double>>& columns) {
  const char *at = line.data(), *end = at + line.size();
  for (std::size_t k = 0; k < columns.size(); ++k) {
    if (k > 0 && (at == end || *at++ != ',')) return false;
    const auto [next, status] = std::from_chars(at, end, columns[k].emplace_back());
    if (status != std::errc()) return false;
    at = next;
  }
  return at == end;
}

/// The next rows on rank 0, nothing on the others. Collective.
std::vector<std::vector<double>> read_rows(std::ifstream& in, long rows, std::size_t width, const std::string& path) {
  std::vector<std::vector<double>> columns(width);
  bool good = true;
  std::string line;
  for (long row = 0; row < rows && is_root() && good; ++row) good = std::getline(in, line) && take_row(line, columns);
  if (any_of(!good)) throw std::runtime_error(path + " is no longer what this run has written");
  return columns;
}

}  // namespace

void write_history_hdf5(const std::string& csv, const std::vector<Column>& columns, long rows,
                        const std::string& path) {
  const std::string part = path + ".part";
  std::ifstream in;
  std::string head;
  if (is_root()) in.open(csv), std::getline(in, head);
  ParallelHdf5 file(part, ParallelHdf5::Mode::create);
  for (long first = 0; first < rows || first == 0; first += block) {
    const auto values = read_rows(in, std::min(block, rows - first), columns.size(), csv);
    for (std::size_t k = 0; k < columns.size(); ++k)
      file.append(dataset_of(columns[k]), Slab::of(values[k].size()), 0, values[k].data());
  }
  for (std::size_t k = 0; k < columns.size(); ++k) {
    file.set_text(dataset_of(columns[k]), "unit", columns[k].unit);
    file.set_attribute(dataset_of(columns[k]), "column", k);
  }
  std::error_code error;
  const bool closed = file.close();
  if (closed && is_root()) std::filesystem::rename(part, path, error);
  if (any_of(!closed || error)) throw OutputError(path);
}

}  // namespace titin
