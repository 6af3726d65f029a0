/// A CSV file of numbers that grows by one row at a time: readable while the run goes on, and complete when it ends
/// early. A run that is restarted goes on with it.
#pragma once

#include <fstream>
#include <string>
#include <vector>

namespace titin {

/// One column, headed "name [unit]", or "name" for a pure number.
struct Column {
  std::string name, unit;
};

/// Written by rank 0; the other ranks may call and do nothing.
class TimeSeries {
 public:
  /// A new file, or one that goes on: `rows` of what is there stay, and the rest goes. Collective; throws
  /// std::runtime_error if it has other columns or fewer rows.
  TimeSeries(const std::string& path, const std::vector<Column>& columns);
  TimeSeries(const std::string& path, const std::vector<Column>& columns, long rows);
  /// Numbers are written so that they read back exactly.
  void add(const std::vector<double>& row);
  long rows() const { return rows_; }
  void sync() const;  ///< waits until the rows are on disk

 private:
  std::string path_;
  std::size_t columns_;
  long rows_ = 0;
  std::ofstream out_;
};

}  // namespace titin
