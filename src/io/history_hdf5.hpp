/// history.csv once more as HDF5, for programs that would rather not parse text.
///
/// One dataset of doubles for each column, named like it, with the attributes `unit` (empty for a pure number) and
/// `column` (its place, from 0). What HDF5 takes for a path is written %2F for /, and %25 for %.
#pragma once

#include <string>
#include <vector>

#include "io/time_series.hpp"

namespace titin {

/// The first `rows` rows of `csv`, which has these columns, into `path`: a reader sees the old file or the new one,
/// never half of it. Collective. Throws std::runtime_error, OutputError.
void write_history_hdf5(const std::string& csv, const std::vector<Column>& columns, long rows, const std::string& path);

}  // namespace titin
