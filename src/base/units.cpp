#include "base/units.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <udunits2.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <memory>
#include <stdexcept>

#include "base/words.hpp"

namespace titin::units {
namespace {

struct Kind {
  const char *si, *noun, *example;
};
constexpr Kind kinds[] = {
    {"", "a pure number", "0.3"},
    {"s", "a time", "25 ms"},
    {"m", "a length", "30 mm"},
    {"m/s", "a velocity", "2 m/s"},
    {"m/s^2", "an acceleration", "9.81 m/s^2"},
    {"rad", "an angle", "30 degree"},
    {"rad/s", "an angular velocity", "90 degree/s"},
    {"1/s", "a rate", "5 1/s"},
    {"kg", "a mass", "20 g"},
    {"kg/m^3", "a density", "1060 kg/m^3"},
    {"N", "a force", "10 N"},
    {"N/m", "a stiffness", "2 N/mm"},
    {"N/m^3", "a force per volume", "1 kN/m^3"},
    {"Pa", "a pressure or stress", "200 kPa"},
    {"Pa s", "a viscosity", "10 Pa s"},
    {"J", "an energy", "5 mJ"},
    {"J/kg", "an energy per mass", "1 kJ/kg"},
    {"m^2", "an area", "1 cm^2"},
    {"m^3", "a volume", "3 cm^3"},
    {"K", "a temperature", "310 K"},
};

const Kind* find(std::string_view si) {
  const auto* it = std::find_if(std::begin(kinds), std::end(kinds), [&](const Kind& k) { return si == k.si; });
  return it == std::end(kinds) ? nullptr : it;
}

ut_system* unit_system() {
  static ut_system* const system = [] {
    ut_set_error_message_handler(ut_ignore);
    ut_system* s = ut_read_xml(nullptr);
    if (!s)
      throw std::runtime_error(
          "UDUNITS-2 finds no table of units; install libudunits2-data, or point UDUNITS2_XML_PATH at udunits2.xml");
    return s;
  }();
  return system;
}

using Unit = std::unique_ptr<ut_unit, decltype(&ut_free)>;
using Converter = std::unique_ptr<cv_converter, decltype(&cv_free)>;

/// UDUNITS would take "10 30 mm" for the unit 300 mm: digits are for exponents, and for the 1 of "1/s".
bool has_stray_number(std::string_view unit) {
  for (std::size_t i = 0; i < unit.size(); ++i) {
    if (!is_digit(unit[i]) || (i > 0 && is_digit(unit[i - 1]))) continue;
    const bool starts = i == 0 || std::string_view(" \t*./(").find(unit[i - 1]) != std::string_view::npos;
    if (!starts) continue;
    const auto next = unit.find_first_not_of(" \t", i + 1);
    const bool is_one_over = unit[i] == '1' && i == 0 && next != std::string_view::npos && unit[next] == '/';
    if (!is_one_over) return true;
  }
  return false;
}

Unit known_unit(std::string_view text) {
  if (has_stray_number(text)) return {nullptr, ut_free};
  const std::string s(text);
  return {ut_parse(unit_system(), s.c_str(), UT_UTF8), ut_free};
}

struct Entry {
  double number = 0;
  std::string_view unit;
};

struct Failure {
  std::string problem, advice;
};

Entry parse_entry(std::string_view piece, std::string_view whole, std::string_view si) {
  const std::string such = fmt::format("write {}, such as \"{}\"", noun(si), example(si));
  if (piece.empty()) throw Failure{fmt::format("{} has an empty entry", in_quotes(whole)), "remove the comma too many"};
  Entry entry;
  const auto start = piece.front() == '+' ? piece.substr(1) : piece;
  const auto [end, status] = std::from_chars(start.data(), start.data() + start.size(), entry.number);
  if (status == std::errc::result_out_of_range)
    throw Failure{fmt::format("{} is too large or too small for a number", in_quotes(piece)), such};
  if (status != std::errc()) throw Failure{fmt::format("{} does not start with a number", in_quotes(piece)), such};
  if (!std::isfinite(entry.number)) throw Failure{fmt::format("{} is not a finite number", in_quotes(piece)), such};
  entry.unit = trim(start.substr(end - start.data()));
  return entry;
}

/// "0, 10, 30 mm": a unit after the last number holds for all of them.
void share_unit(std::vector<Entry>& entries, std::string_view whole, std::string_view si) {
  const auto without = std::count_if(entries.begin(), entries.end(), [](const Entry& e) { return e.unit.empty(); });
  if (without == 0) return;
  const std::string_view last = entries.back().unit;
  if (without == static_cast<long>(entries.size())) {
    if (si.empty()) return;
    throw Failure{fmt::format("{} has no unit", in_quotes(whole)),
                  fmt::format("write {} with its unit, such as \"{}\"", noun(si), example(si))};
  }
  if (last.empty() || without + 1 != static_cast<long>(entries.size()))
    throw Failure{fmt::format("{} gives a unit to some numbers only", in_quotes(whole)),
                  "write one unit after the last number, or one after each"};
  for (Entry& e : entries) e.unit = last;
}

struct UnknownUnit {};
struct WrongDimension {};

Converter converter(std::string_view unit, const std::string& si) {
  const Unit from = known_unit(unit);
  const Unit to = si.empty() ? Unit(ut_get_dimensionless_unit_one(unit_system()), ut_free) : known_unit(si);
  if (!from) throw UnknownUnit();
  if (!to) throw std::logic_error(fmt::format("the key's own unit \"{}\" is unknown", si));
  if (!ut_are_convertible(from.get(), to.get())) throw WrongDimension();
  return {ut_get_converter(from.get(), to.get()), cv_free};
}

double to_si(const Entry& entry, std::string_view whole, const std::string& si) {
  if (entry.unit.empty()) return entry.number;
  const std::string such = fmt::format("write {}, such as \"{}\"", noun(si), example(si));
  try {
    const double value = cv_convert_double(converter(entry.unit, si).get(), entry.number);
    if (std::isfinite(value)) return value;
  } catch (UnknownUnit) {
    throw Failure{fmt::format("{} has an unknown unit \"{}\"", in_quotes(whole), printable(entry.unit)), such};
  } catch (WrongDimension) {
    throw Failure{fmt::format("{} is not {}: \"{}\" cannot be converted to {}", in_quotes(whole), noun(si),
                              printable(entry.unit), si.empty() ? "a number" : si),
                  such};
  }
  throw Failure{fmt::format("{} is too large for a number in {}", in_quotes(whole), si), such};
}

}  // namespace

std::string noun(std::string_view si) {
  const Kind* k = find(si);
  return k ? k->noun : fmt::format("a quantity in {}", si);
}

std::string example(std::string_view si) {
  const Kind* k = find(si);
  return k ? k->example : fmt::format("1 {}", si);
}

Parsed parse(std::string_view text, const std::string& si) {
  Parsed result;
  try {
    std::vector<Entry> entries;
    for (std::string_view piece : split(text, ',')) entries.push_back(parse_entry(trim(piece), text, si));
    share_unit(entries, text, si);
    for (const Entry& e : entries) result.values.push_back(to_si(e, text, si));
  } catch (Failure& failure) {
    result.problem = failure.problem;
    result.advice = failure.advice;
  }
  return result;
}

std::string convert(std::vector<double>& values, std::string_view unit, const std::string& si) try {
  const Converter convert = converter(unit, si);
  for (double& value : values) value = cv_convert_double(convert.get(), value);
  const bool finite = std::all_of(values.begin(), values.end(), [](double x) { return std::isfinite(x); });
  return finite ? "" : fmt::format("a value in {} is too large for a number in {}", in_quotes(unit), si);
} catch (UnknownUnit) {
  return fmt::format("{} is an unknown unit", in_quotes(unit));
} catch (WrongDimension) {
  return fmt::format("{} is not the unit of {}", in_quotes(unit), noun(si));
}

std::string text(double value, std::string_view si) { return fmt::format("{}{}{}", value, si.empty() ? "" : " ", si); }

std::string text(const std::vector<double>& values, std::string_view si) {
  return fmt::format("{}{}{}", fmt::join(values, ", "), si.empty() ? "" : " ", si);
}

}  // namespace titin::units
