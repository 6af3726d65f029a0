/// Reads a history.csv that a run has written, row by row: what its columns hold, without keeping them.
#pragma once

#include <string>
#include <vector>

namespace titin {

struct HistoryColumn {
  std::string name;  ///< as its head says it, with the unit
  double first = 0, last = 0, least = 0, largest = 0;
};

struct HistoryFile {
  long rows = 0;
  std::vector<HistoryColumn> columns;
  std::string problem;  ///< "" or what is wrong, with the line
};

HistoryFile read_history_file(const std::string& path);

}  // namespace titin
