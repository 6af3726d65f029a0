/// Reading small text files: scenes and tables of numbers. Rank 0 reads, all ranks get the text or the error.
#pragma once

#include <string>
#include <vector>

namespace titin {

/// The text of a file, or why there is none ("is not there", "is a folder", ...).
struct TextFile {
  std::string text, problem;
};
TextFile read_text_file(const std::string& path);   ///< collective
std::string file_problem(const std::string& path);  ///< "" when there is such a file; collective

/// Two columns of numbers, parted by white space or a comma: time [s], strictly increasing, and value. '#' starts a
/// comment; one line of names may head the columns. `problem` names the line.
struct Columns {
  std::vector<double> time, value;
  std::string problem;
};
Columns parse_columns(const std::string& text);

}  // namespace titin
