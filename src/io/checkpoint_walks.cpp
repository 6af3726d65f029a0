#include "io/checkpoint_walks.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <bit>
#include <limits>
#include <numeric>
#include <stdexcept>

#include "base/digest.hpp"
#include "base/parallel.hpp"

namespace titin {
namespace {

constexpr std::uint64_t numbers_at_once = 1u << 20;  // that a rank reads of others: 8 MB
constexpr const char* check_sum = "check_sum";

/// Of numbers by their places in a dataset, so that ranks can add up theirs.
std::uint64_t sum_of(const double* values, std::uint64_t first, std::uint64_t count) {
  std::uint64_t sum = 0;
  for (std::uint64_t i = 0; i < count; ++i)
    sum += Digest::mixed(std::bit_cast<std::uint64_t>(values[i]) ^ Digest::mixed(first + i + 1));
  return sum;
}

/// Modulo 2^64. Collective.
std::uint64_t over_ranks(std::uint64_t x) {
  const auto low = static_cast<std::uint64_t>(sum(static_cast<long>(x & 0xffffffffu)));
  const auto high = static_cast<std::uint64_t>(sum(static_cast<long>(x >> 32)));
  return low + (high << 32);
}

bool differ(const std::vector<int>& sizes) {
  double least = std::numeric_limits<double>::infinity(), most = -least;
  for (const int size : sizes) least = std::min(least, double(size)), most = std::max(most, double(size));
  return min(least) < max(most);
}

Slab on_root(std::uint64_t count) { return {0, is_root() ? count : 0, count}; }

}  // namespace

void CheckpointWriter::write(const std::string& name, const Slab& slab, int width, const double* values) {
  const std::uint64_t per_row = width > 0 ? width : 1;
  file_.write(name, slab, width, values);
  file_.set_attribute(name, check_sum, over_ranks(sum_of(values, slab.first * per_row, slab.count * per_row)));
}

void CheckpointWriter::common(const std::string& name, std::vector<double>& values) {
  write("common/" + name, on_root(values.size()), 0, values.data());
}

void CheckpointWriter::parts(const std::string& name, std::vector<double>& values) {
  write("parts/" + name, Slab::of(1), static_cast<int>(values.size()), values.data());
}

void CheckpointWriter::write_numbers(const StateRows& rows) {
  if (kinds_.count(rows.kind)) return;
  const Slab slab = kinds_[rows.kind] = Slab::of(rows.number.size());
  const std::vector<std::int64_t> numbers(rows.number.begin(), rows.number.end());
  const auto first = static_cast<std::int64_t>(slab.first);
  file_.write(rows.kind + "/number", slab, 0, numbers.data());
  file_.write(rows.kind + "/first", Slab::of(1), 0, &first);
}

void CheckpointWriter::rows(const std::string& name, const StateRows& rows, int width, double* values) {
  write_numbers(rows);
  write(rows.kind + "/" + name, Slab::of(rows.number.size() * width), 0, values);
}

void CheckpointWriter::ragged(const std::string& name, const StateRows& rows, const std::vector<int>& sizes,
                              double* values) {
  write_numbers(rows);
  const std::string path = rows.kind + "/" + name;
  write(path, Slab::of(std::accumulate(sizes.begin(), sizes.end(), std::uint64_t(0))), 0, values);
  if (!differ(sizes)) return;
  const std::vector<std::int64_t> lengths(sizes.begin(), sizes.end());
  file_.write(path + "_sizes", kinds_[rows.kind], 0, lengths.data());
}

void CheckpointReader::fail_if(bool wrong, const std::string& name, const std::string& problem) const {
  if (any_of(wrong)) throw std::runtime_error(fmt::format("{}: {} {}", path_, name, problem));
}

void CheckpointReader::verify(const std::string& name, std::uint64_t sum) const {
  fail_if(file_.attribute(name, check_sum) != sum, name, "was changed after it was written");
}

void CheckpointReader::common(const std::string& name, std::vector<double>& values) {
  const std::string path = "common/" + name;
  fail_if(!file_.has(path), path, "is missing");
  const std::uint64_t count = file_.rows(path);
  values = file_.read<double>(path, 0, count);
  verify(path, sum_of(values.data(), 0, count));
}

void CheckpointReader::parts(const std::string& name, std::vector<double>& values) {
  const std::string path = "parts/" + name;
  const std::uint64_t writers = file_.rows(path), width = file_.width(path);
  fail_if(width != values.size() || writers == 0, path, "has another number of sums");
  const std::vector<double> all = file_.read<double>(path, 0, writers);
  verify(path, sum_of(all.data(), 0, all.size()));
  const bool alike = writers == static_cast<std::uint64_t>(ranks());
  std::fill(values.begin(), values.end(), 0.0);
  for (std::uint64_t r = 0; r < writers; ++r)
    for (std::uint64_t k = 0; k < width; ++k)
      if (alike ? r == static_cast<std::uint64_t>(rank()) : is_root()) values[k] += all[r * width + k];
}

/// Collective.
const CheckpointReader::Kind& CheckpointReader::kind(const StateRows& rows) {
  if (const auto known = kinds_.find(rows.kind); known != kinds_.end()) return known->second;
  Kind& kind = kinds_[rows.kind];
  const std::string number = rows.kind + "/number", first = rows.kind + "/first";
  kind.total = file_.rows(number);
  const std::uint64_t count = rows.number.size();
  if (file_.rows(first) == static_cast<std::uint64_t>(ranks())) {
    kind.first = static_cast<std::uint64_t>(file_.read<std::int64_t>(first, rank(), 1)[0]);
    bool same = kind.first + count <= kind.total;
    const auto numbers = file_.read<std::int64_t>(number, same ? kind.first : 0, same ? count : 0);
    same = same && std::equal(numbers.begin(), numbers.end(), rows.number.begin(), rows.number.end());
    kind.alike = !any_of(!same) && sum(static_cast<long>(count)) == static_cast<long>(kind.total);
  }
  if (kind.alike) return kind;
  kind.numbers = file_.read<std::int64_t>(number, 0, kind.total);
  for (std::size_t row = 0; row < count; ++row) kind.place[rows.number[row]] = row;
  return kind;
}

void CheckpointReader::rows(const std::string& name, const StateRows& rows, int width, double* values) {
  ragged(name, rows, std::vector<int>(rows.number.size(), width), values);
}

void CheckpointReader::ragged(const std::string& name, const StateRows& rows, const std::vector<int>& sizes,
                              double* values) {
  const Kind& kind = this->kind(rows);
  const std::string path = rows.kind + "/" + name;
  fail_if(!file_.has(path), path, "is missing");
  std::vector<std::size_t> start(1, 0);
  for (const int size : sizes) start.push_back(start.back() + size);
  kind.alike ? read_own(path, start.back(), values) : pick(path, kind, start, values);
}

void CheckpointReader::read_own(const std::string& name, std::uint64_t count, double* values) {
  const Slab slab = Slab::of(count);
  fail_if(slab.total != file_.rows(name), name, "has another length");
  const std::vector<double> own = file_.read<double>(name, slab.first, slab.count);
  verify(name, over_ranks(sum_of(own.data(), slab.first, slab.count)));
  std::copy(own.begin(), own.end(), values);
}

/// Looks at the whole dataset, some of it at a time, and takes what belongs here.
void CheckpointReader::pick(const std::string& name, const Kind& kind, const std::vector<std::size_t>& start,
                            double* values) {
  std::vector<std::int64_t> lengths(kind.total, kind.total > 0 ? file_.rows(name) / kind.total : 0);
  if (file_.has(name + "_sizes")) lengths = file_.read<std::int64_t>(name + "_sizes", 0, kind.total);
  std::vector<char> found(start.size() - 1, 0);
  bool same_sizes = true;
  std::uint64_t sum = 0, before = 0;  // before: numbers in front of those that are looked at
  for (std::uint64_t row = 0; row < kind.total;) {
    std::uint64_t end = row, numbers = 0;
    while (end < kind.total && (end == row || numbers < numbers_at_once)) numbers += lengths[end++];
    const std::vector<double> some = file_.read<double>(name, before, numbers);
    sum += sum_of(some.data(), before, numbers);
    before += numbers;
    for (const double* at = some.data(); row < end; at += lengths[row++]) {
      const auto mine = kind.place.find(kind.numbers[row]);
      if (mine == kind.place.end()) continue;
      const std::size_t first = start[mine->second], size = start[mine->second + 1] - first;
      found[mine->second] = 1;
      same_sizes = same_sizes && size == static_cast<std::size_t>(lengths[row]);
      if (same_sizes) std::copy_n(at, size, values + first);
    }
  }
  verify(name, sum);
  fail_if(!same_sizes, name, "has rows of other sizes");
  fail_if(std::find(found.begin(), found.end(), 0) != found.end(), name, "lacks cells or nodes of this mesh");
}

}  // namespace titin
