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
std::string file_digest(const std::string& path);   ///< of what it holds, in words; collective
std::string file_problem(const std::string& path);  ///< "" when there is such a file; collective

/// Columns of numbers, parted by white space or commas. '#' starts a comment. A line may head them, "name" or "name
/// [unit]" for each, also as a comment. All up to a line "endheader" is left out: storage and motion files of OpenSim
/// (.sto, .mot) begin so. `problem` names the line.
struct NumberTable {
  struct Column {
    std::string name, unit;  ///< as written; "" when the file does not say
    std::vector<double> values;
  };
  std::vector<Column> columns;
  std::vector<int> lines;   ///< of each row in the file
  int head = 0;             ///< line of the names
  bool in_degrees = false;  ///< "inDegrees=yes" before "endheader"
  std::string problem;
};
NumberTable parse_numbers(const std::string& text);

/// Turns a column into SI when it names a unit: what is wrong with that, or "".
std::string convert_column(NumberTable& table, std::size_t column, const std::string& si);
/// What is wrong with a column of times [s], which must increase, or "".
std::string time_problem(const NumberTable& table, std::size_t column);

/// The column of this name, or -1.
int find_column(const NumberTable& table, std::string_view name);
/// "did you mean ...? it has: a, b, c": what to do when there is no column `name`.
std::string column_advice(const NumberTable& table, const std::string& name);

/// Two columns: time, strictly increasing, and value; in SI.
struct Columns {
  std::vector<double> time, value;
  std::string problem, advice;
};
/// `column` names the values where there are more than two columns; the times are in the column "time" or "t", else in
/// the first.
Columns parse_columns(const std::string& text, const std::string& value_unit, const std::string& column = "");

}  // namespace titin
