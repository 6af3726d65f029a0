/// A CSV file of numbers that grows by one row at a time: readable while the run goes on, and complete when it ends
/// early.
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
  TimeSeries(const std::string& path, const std::vector<Column>& columns);
  /// Numbers are written so that they read back exactly.
  void add(const std::vector<double>& row);

 private:
  std::string path_;
  std::size_t columns_;
  std::ofstream out_;
};

}  // namespace titin
