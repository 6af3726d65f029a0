#include "point/batch.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>

#include "base/config.hpp"
#include "base/units.hpp"
#include "base/words.hpp"
#include "materials/compressible.hpp"
#include "point/json_material.hpp"

namespace titin {
namespace {

using Json = nlohmann::json;
using OrderedJson = nlohmann::ordered_json;

[[noreturn]] void refuse(const std::string& message) { throw InputError({message}); }

template <int rows, int columns>
std::array<double, rows * columns> read_matrix(const Json& x, const char* name) {
  const auto bad = [&] { refuse(fmt::format("{}: not {} rows of {} numbers", name, rows, columns)); };
  std::array<double, rows * columns> matrix;
  if (!x.is_array() || x.size() != rows) bad();
  for (int r = 0; r < rows; ++r) {
    if (!x[r].is_array() || x[r].size() != columns) bad();
    for (int c = 0; c < columns; ++c) {
      if (!x[r][c].is_number()) bad();
      matrix[columns * r + c] = x[r][c];
    }
  }
  return matrix;
}

template <std::size_t size>
OrderedJson rows_of(const std::array<double, size>& matrix, int columns, double unit) {
  OrderedJson rows = OrderedJson::array();
  for (std::size_t r = 0; r < size / columns; ++r) {
    rows.push_back(OrderedJson::array());
    for (int c = 0; c < columns; ++c) rows[r].push_back(matrix[columns * r + c] / unit);
  }
  return rows;
}

/// A number of the entry, with its unit if it is text.
double read_number(const Json& entry, const char* name, const char* si) {
  if (!entry.contains(name)) return 0;
  const Json& x = entry[name];
  if (x.is_number()) return x;
  if (!x.is_string()) refuse(fmt::format("{}: no number", name));
  const units::Parsed parsed = units::parse(x.get<std::string>(), si);
  if (!parsed.ok()) refuse(fmt::format("{}: {}; {}", name, parsed.problem, parsed.advice));
  return parsed.values.front();
}

FibreRate read_rate(const Json& entry) {
  const std::string word = entry.value("fibre_rate", entry.contains("F_old") ? "stretch_difference" : "none");
  if (word == "none") return FibreRate::none;
  if (word == "stretch_difference") return FibreRate::stretch_difference;
  if (word == "velocity_gradient") return FibreRate::velocity_gradient;
  refuse(fmt::format("fibre_rate: {} is not known here; allowed: none, stretch_difference, velocity_gradient",
                     in_quotes(word)));
}

/// One entry of the list.
class Entry {
 public:
  Entry(const Json& entry, const JsonMaterials& materials) : entry_(entry), materials_(materials) {
    if (!entry.is_object()) refuse("no object; write { \"law\": ..., \"F\": ... }");
    stress_unit_ = entry.value("units", "Pa");
    const units::Parsed unit = units::parse("1 " + stress_unit_, "Pa");
    if (!unit.ok()) refuse(fmt::format("units: {}; {}", unit.problem, unit.advice));
    unit_ = unit.values.front();
    if (!entry.contains("F")) refuse("F: missing; give 3 rows of 3 numbers");
  }

  OrderedJson answer() {
    const auto material = read_material();
    const Mat3 F = read_matrix<3, 3>(entry_["F"], "F"), F_old = read_old(F);
    const double J = determinant(F);
    if (!(J > 0)) refuse(fmt::format("F: its determinant {:g} is not positive", J));
    if (entry_.contains("F_old") && !(determinant(F_old) > 0)) refuse("F_old: its determinant is not positive");
    PointInput in;
    in.n = 1, in.F = &F, in.F_old = &F_old;
    in.time = read_number(entry_, "time", "s"), in.dt = read_number(entry_, "dt", "s");
    in.rate = read_rate(entry_);
    if (in.rate != FibreRate::none && !(in.dt > 0)) refuse("dt: a rate needs a step above zero; give dt in s");
    Mat3 P;
    Mat9 A;
    double W = 0;
    whole_stress(*material, in, &P, &A);
    whole_energy(*material, in, &W);
    const auto finite = [](double x) { return std::isfinite(x); };
    if (!std::isfinite(W) || !std::all_of(P.begin(), P.end(), finite) || !std::all_of(A.begin(), A.end(), finite))
      refuse("the law gives no finite number at this F");
    return write(F, J, has_energy(*material) ? OrderedJson(W / unit_) : OrderedJson(), P, A);
  }

 private:
  Mat3 read_old(const Mat3& F) const {
    return entry_.contains("F_old") ? read_matrix<3, 3>(entry_["F_old"], "F_old") : F;
  }

  /// The entry's keys of a material, one law made a term and the activation given to those that have one.
  Json material_keys() const {
    Json keys = entry_;
    for (const char* other :
         {"name", "units", "F", "F_old", "dt", "time", "fibre_rate", "activation", "law", "parameters"})
      keys.erase(other);
    if (entry_.contains("law") == entry_.contains("terms"))
      refuse("give either \"law\" with \"parameters\", or \"terms\"");
    if (entry_.contains("law")) {
      Json term = entry_.value("parameters", Json::object());
      if (!term.is_object()) refuse("parameters: no object; write { \"mu\": ... }");
      term["law"] = entry_["law"];
      keys["terms"] = {{"law", term}};
    }
    if (!keys.contains("density")) keys["density"] = 1000;  // of no account here
    if (entry_.contains("activation") && !activate(keys)) refuse("activation: no term has one; drop it");
    return keys;
  }
  bool activate(Json& keys) const {
    bool any = false;
    for (auto& [name, term] : keys["terms"].items())
      if (term.is_object() && materials_.is_active(term.value("law", ""))) {
        any = true;
        if (!term.contains("activation")) term["activation"] = entry_["activation"];
      }
    return any;
  }

  std::shared_ptr<const Material> read_material() {
    Config config(materials_.toml(material_keys(), "material", stress_unit_), "");
    auto material = Material::read(config.root().section("material"));
    config.finish();
    return material;
  }

  bool has_energy(const Material& material) const {
    return std::all_of(material.terms().begin(), material.terms().end(),
                       [&](const TermInfo& term) { return materials_.has_potential(term.law); });
  }

  OrderedJson write(const Mat3& F, double J, const OrderedJson& energy, const Mat3& P, const Mat9& A) const {
    OrderedJson out;
    if (entry_.contains("name")) out["name"] = entry_["name"];
    out["units"] = stress_unit_;
    out["F"] = rows_of(F, 3, 1);
    out["J"] = J;
    out["energy"] = energy;
    Mat3 sigma = multiply(P, transpose(F));
    for (double& x : sigma) x /= J;
    out["P"] = rows_of(P, 3, unit_);
    out["sigma"] = rows_of(sigma, 3, unit_);
    out["dPdF"] = rows_of(A, 9, unit_);
    return out;
  }

  const Json& entry_;
  const JsonMaterials& materials_;
  std::string stress_unit_;
  double unit_ = 1;
};

/// What Config says, without the place in the text that was made of the entry.
std::string without_place(const std::string& message) {
  const auto end = message.find(": ");
  return message.starts_with(":") && end != std::string::npos ? message.substr(end + 2) : message;
}

}  // namespace

std::string run_batch(const std::string& text, const std::string& file) {
  Json list = Json::parse(text, nullptr, false);
  if (list.is_discarded()) throw InputError({fmt::format("{}: is no JSON; see docs/howto/material_point.md", file)});
  if (list.is_object() && list.contains("entries")) list = list["entries"];
  if (!list.is_array()) throw InputError({fmt::format("{}: is no list of entries; write [ {{ ... }}, ... ]", file)});
  const JsonMaterials materials;
  std::vector<std::string> wrong;
  OrderedJson answers = OrderedJson::array();
  for (std::size_t k = 0; k < list.size(); ++k) {
    const bool named = list[k].is_object() && list[k].contains("name");
    const std::string which = fmt::format("{}: entry {}{}", file, k + 1, named ? " " + list[k]["name"].dump() : "");
    try {
      answers.push_back(Entry(list[k], materials).answer());
    } catch (const InputError& error) {
      for (const std::string& m : error.messages()) wrong.push_back(fmt::format("{}: {}", which, without_place(m)));
    } catch (const Json::exception& error) {
      wrong.push_back(fmt::format("{}: a value is of the wrong kind ({})", which, error.what()));
    }
  }
  if (!wrong.empty()) throw InputError(wrong);
  return OrderedJson{{"entries", answers}}.dump(1) + "\n";
}

}  // namespace titin
