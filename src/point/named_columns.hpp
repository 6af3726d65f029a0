/// Columns of numbers with names, as in measured curves: a CSV file whose first row is "time [s],F_xx,P_xx [kPa],...".
#pragma once

#include <string>
#include <vector>

namespace titin {

struct NamedColumn {
  std::string name, unit;      ///< unit as written, "" for a pure number
  std::vector<double> values;  ///< as written
};

struct NamedColumns {
  std::vector<NamedColumn> columns;
  std::string problem;  ///< "" when the text was such a table
  const NamedColumn* find(const std::string& name) const;
};

/// '#' starts a comment.
NamedColumns parse_named_columns(const std::string& text);
/// The values in SI; what is wrong with the unit goes to `problem`.
std::vector<double> in_si(const NamedColumn& column, const std::string& si, std::string& problem);

}  // namespace titin
