/// What is in the folder of a run, for people: status, costs, histories, fields, checkpoints, sizes.
#pragma once

#include <string>
#include <utility>
#include <vector>

#include "io/history_file.hpp"

namespace titin {

struct RunContents {
  std::vector<std::pair<std::string, std::string>> facts;  ///< what, and what there is to say of it
  HistoryFile history;
};

/// Reads the folder; throws InputError when no run has written it. One rank.
RunContents read_run_contents(const std::string& folder);

}  // namespace titin
