/// Units at the border of the program: text such as "0, 10, 30 mm" becomes SI numbers, and only those are used inside.
/// UDUNITS-2 knows the units.
#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace titin::units {

/// Numbers in SI, or what is wrong with the text and what to write instead.
struct Parsed {
  std::vector<double> values;
  std::string problem, advice;
  bool ok() const { return problem.empty(); }
};

/// Reads "30 mm", "30, 10, 10 mm" or "30 mm, 1 cm" in the unit `si`; for `si` = "" also "0.3" and "30 %".
/// A number without its unit, a unit that nobody knows and a unit of another dimension are three different problems.
Parsed parse(std::string_view text, const std::string& si);

/// Turns values in `unit` into SI. Returns what is wrong with the unit, or "".
std::string convert(std::vector<double>& values, std::string_view unit, const std::string& si);

/// What a quantity with this SI unit is called, "a time", and how one is written, "25 ms".
std::string noun(std::string_view si);
std::string example(std::string_view si);

/// A value as a message or a scene says it: "0.025 s", shortest text that reads back to the same number.
std::string text(double value, std::string_view si);
std::string text(const std::vector<double>& values, std::string_view si);

}  // namespace titin::units
