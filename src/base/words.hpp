/// Words as users write and read them: trimming, splitting, quoting, and "did you mean".
#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace titin {

inline bool is_digit(char c) { return c >= '0' && c <= '9'; }
std::string_view trim(std::string_view text);  ///< without white space at both ends
std::vector<std::string_view> split(std::string_view text, char separator);

/// Safe and short enough to print: control characters become '?', long text is cut.
std::string printable(std::string_view text);
std::string in_quotes(std::string_view text);        ///< printable, in quotation marks
std::string count(double n, std::string_view what);  ///< "1 rank", "2 ranks"
/// The text as a TOML basic string.
std::string toml_string(std::string_view text);

/// The candidate that `word` was probably meant to be (Damerau-Levenshtein distance, at most a third of the word), or
/// "".
std::string nearest(std::string_view word, const std::vector<std::string>& candidates);

}  // namespace titin
