/// Stress, energy and tangent against independent numbers (tests/data/materials/*.json say where they come from).
#include <fmt/format.h>

#include <functional>
#include <map>

#include "materials_for_tests.hpp"

namespace titin::testing {
namespace {

using Json = nlohmann::json;

// Sixteen digits lose four to six in differences of nearly equal numbers near the identity.
constexpr double stress_tolerance = 1e-10, energy_tolerance = 1e-10, tangent_tolerance = 1e-8;

std::string quantity(double x, const Json& entry) {
  static const std::map<std::string, double> scale{{"Pa", 1}, {"kPa", 1e3}, {"MPa", 1e6}};
  return fmt::format("\"{:.17g} Pa\"", x * scale.at(entry["units"]));
}

std::string yeoh(double scale, const Json& p) {
  return fmt::format("base = {{ law = \"yeoh\", c1 = \"{:.17g} Pa\", c2 = \"{:.17g} Pa\", c3 = \"{:.17g} Pa\" }}\n",
                     scale * p["c1"].get<double>(), scale * p["c2"].get<double>(), scale * p["c3"].get<double>());
}

std::string muscle(const Json& p) {
  const double act = p["act"], rate = p.value("e0", 5.0);
  return yeoh(p["sigma0b"], p) + fmt::format(
                                     "passive = {{ law = \"hill_passive\", peak_stress = \"{0} Pa\" }}\n"
                                     "active = {{ law = \"hill_active\", peak_stress = \"{0} Pa\", max_strain_rate = "
                                     "\"{1} 1/s\", activation = {2} }}\n",
                                     p["sigma0"].get<double>(), rate, act);
}

/// A term with keys that are taken from the entry: stresses in its unit ("mu = mu"), numbers as they are ("#c2 = c2").
std::string term(const char* name, const char* law, const Json& entry,
                 std::initializer_list<std::pair<const char*, const char*>> keys) {
  std::string text = fmt::format("{} = {{ law = \"{}\"", name, law);
  for (const auto& [key, parameter] : keys) {
    const bool number = key[0] == '#';
    const Json& value = entry["params"][parameter];
    text += fmt::format(", {} = {}", key + number, number ? value.dump() : quantity(value, entry));
  }
  return text + " }\n";
}

/// Several weights of the entry with its unit: "0.5, 0.2 kPa".
std::string moduli(const Json& entry, std::initializer_list<double> values) {
  std::string list;
  for (double x : values) list += fmt::format("{}{:.17g}", list.empty() ? "" : ", ", x);
  return fmt::format("\"{} {}\"", list, entry["units"].get<std::string>());
}

std::string cann(const Json& e) {
  const auto w = [&](const char* key, int i) { return e["params"][key][i].get<double>(); };
  std::string text = "m = { law = \"cann\"";
  for (const auto& [which, key] : {std::pair{1, "wI1"}, {2, "wI2"}})
    text += fmt::format(", moduli_{0} = {1}, exponents_{0} = [{2}, {3}]", which,
                        moduli(e, {w(key, 0), w(key, 1), w(key, 3), w(key, 4)}), w(key, 2), w(key, 5));
  return text + fmt::format(" }}\nf = {{ law = \"cann_fibre\", w1 = {}, w2 = {}, b = {} }}\n", moduli(e, {w("wI4", 0)}),
                            moduli(e, {w("wI4", 1)}), w("wI4", 2));
}

std::string icnn(const Json& e) {
  const Json &p = e["params"], &a = p["a"], &W = p["W"];
  Json weight[2];
  for (const Json& neuron : W)
    for (int k = 0; k < 2; ++k) weight[k].push_back(neuron[k]);
  return fmt::format("m = {{ law = \"icnn\", amplitude = {}, weight_1 = {}, weight_2 = {}, bias = {} }}\n",
                     moduli(e, {a[0], a[1], a[2], a[3]}), weight[0].dump(), weight[1].dump(), p["b"].dump());
}

std::string growth(const Json& p) {
  const std::string kind = p["kind"], law = kind == "iso" ? "isotropic" : kind;
  const std::string axis = kind == "iso" ? "" : (kind == "area" ? ", normal = " : ", direction = ") + p["dir"].dump();
  return fmt::format("growth = {{ law = \"{}\", stretch = {}, per = {}{} }}\n", law, p["theta"].dump(), p["per"].dump(),
                     axis);
}

using Terms = std::function<std::string(const Json& entry)>;

/// The terms of an entry in the language of scenes, by what the name of its model begins with.
const std::map<std::string, Terms>& models() {
  static const std::map<std::string, Terms> all{
      {"yeoh", [](const Json& e) { return yeoh(e["params"]["s"], e["params"]); }},
      {"neo_hookean_iso",
       [](const Json& e) {
         return term("m", "neo_hookean", e, {{"mu", "mu"}});
       }},
      {"mooney_rivlin_iso",
       [](const Json& e) {
         return term("m", "mooney_rivlin", e, {{"c1", "C1"}, {"c2", "C2"}});
       }},
      {"flexodeal_muscle", [](const Json& e) { return muscle(e["params"]); }},
      {"flexodeal_tendon",
       [](const Json& e) {
         return yeoh(e["params"]["sigma0b"], e["params"]) +
                term("f", "collagen_table", e, {{"stress_scale", "sigma0"}});
       }},
      {"svk",
       [](const Json& e) {
         return term("m", "st_venant_kirchhoff", e, {{"mu", "mu"}, {"lambda", "lambda"}});
       }},
      {"neo_hookean_compressible",
       [](const Json& e) {
         return term("m", "compressible_neo_hookean", e, {{"mu", "mu"}, {"lambda", "lambda"}});
       }},
      {"veronda_westmann",
       [](const Json& e) {
         return term("m", "veronda_westmann", e, {{"c1", "c1"}, {"#c2", "c2"}});
       }},
      {"holmes_mow",
       [](const Json& e) {
         return term("m", "holmes_mow", e, {{"mu", "mu"}, {"lambda", "lambda"}, {"#beta", "beta"}});
       }},
      {"transiso_neo_linear_fibre",
       [](const Json& e) {
         return term("m", "neo_hookean", e, {{"mu", "mu"}}) + term("f", "linear_fibre", e, {{"stiffness", "kf"}});
       }},
      {"weiss_ti",
       [](const Json& e) {
         return term("m", "mooney_rivlin", e, {{"c1", "C1"}, {"c2", "C2"}}) +
                term("f", "weiss_fibre", e, {{"c3", "C3"}, {"#c4", "C4"}, {"c5", "C5"}, {"#lambda_straight", "lam_m"}});
       }},
      {"goh2",
       [](const Json& e) {
         const std::string fibres =
             term("f", "goh", e, {{"k1", "k1"}, {"#k2", "k2"}, {"#kappa", "kappa"}, {"#switch", "switch"}});
         const std::string keys = fibres.substr(fibres.find("law"), fibres.rfind(" }") - fibres.find("law"));
         const std::string second = fmt::format("s = {{ family = \"second\", {} }}\n", keys);
         return fmt::format("m = {{ law = \"neo_hookean\", mu = {} }}\n",
                            quantity(2 * e["params"]["C10"].get<double>(), e)) +
                fibres + second;
       }},
      {"holzapfel_ogden",
       [](const Json& e) {
         return term("m", "holzapfel_ogden", e,
                     {{"a", "a"},
                      {"#b", "b"},
                      {"af", "af"},
                      {"#bf", "bf"},
                      {"as", "as"},
                      {"#bs", "bs"},
                      {"afs", "afs"},
                      {"#bfs", "bfs"}});
       }},
      {"guccione",
       [](const Json& e) {
         return term("m", "guccione", e, {{"c", "C"}, {"#bf", "bf"}, {"#bt", "bt"}, {"#bfs", "bfs"}});
       }},
      {"blemker_muscle",
       [](const Json& e) {
         return term("m", "blemker_shear", e, {{"g1", "G1"}, {"g2", "G2"}}) +
                term("p", "blemker_passive", e,
                     {{"peak_stress", "smax"},
                      {"#optimal_stretch", "Lofl"},
                      {"#p1", "P1"},
                      {"#p2", "P2"},
                      {"#lambda_straight", "lam_star"}}) +
                term("a", "blemker_active", e,
                     {{"peak_stress", "smax"}, {"#optimal_stretch", "Lofl"}, {"#activation", "act"}});
       }},
      {"blemker_tendon",
       [](const Json& e) {
         return term("m", "blemker_shear", e, {{"g1", "G1"}, {"g2", "G2"}}) +
                term("f", "weiss_fibre", e, {{"c3", "L1"}, {"#c4", "L2"}, {"#lambda_straight", "lam_star"}});
       }},
      {"cann", cann},
      {"icnn", icnn},
      {"growth",
       [](const Json& e) {
         return term("m", "neo_hookean", e, {{"mu", "mu"}});
       }},
      {"active",
       [](const Json& e) {
         return fmt::format("a = {{ law = \"active_stress\", activation = 1, peak_stress = {}, measure = {} }}\n",
                            quantity(e["params"]["ta"], e), e["params"]["mode"].dump());
       }},
      {"ogden",
       [](const Json& e) {
         std::string moduli;
         for (double mu : e["params"]["mu"]) moduli += fmt::format("{}{:.17g}", moduli.empty() ? "" : ", ", mu);
         return fmt::format("m = {{ law = \"ogden\", mu = \"{} {}\", alpha = {} }}\n", moduli,
                            e["units"].get<std::string>(), e["params"]["alpha"].dump());
       }},
  };
  return all;
}

std::string terms(const Json& entry) {
  const std::string model = entry["model"];
  for (const auto& [begin, make] : models())
    if (model.starts_with(begin)) return make(entry);
  ADD_FAILURE() << "no terms for " << model;
  return "";
}

MaterialPointer material_of(const Json& entry) {
  const Json& p = entry["params"];
  std::string text = "density = \"1000 kg/m^3\"\n";
  if (p.contains("K"))
    text += fmt::format("volumetric = {{ law = \"{}\", bulk_modulus = {} }}\n", p.value("vol", "simo"),
                        quantity(p["K"], entry));
  if (p.contains("theta")) text += growth(p);
  for (const char* key : {"a0", "f0"})
    if (p.contains(key)) text += "fibre = " + p[key].dump() + "\n";
  if (p.contains("s0")) text += "second_fibre = " + p["s0"].dump() + "\n";
  if (p.contains("fibres"))
    text += "fibre = " + p["fibres"][0].dump() + "\nsecond_fibre = " + p["fibres"][1].dump() + "\n";
  if (p.value("aniso", "iso") == "full") text += "fibre_invariants = \"full\"\n";
  return material(text + "[materials.m.terms]\n" + terms(entry));
}

Point point_of(const Json& entry, const Material& m) {
  Point point{.F = mat3(entry["F"]), .fibre = m.fibre()};
  if (!entry["params"].contains("Fn")) return point;
  point.F_old = mat3(entry["params"]["Fn"]);
  point.dt = entry["params"]["dt"];
  point.rate = FibreRate::velocity_gradient;
  return point;
}

void expect_entry(const Json& entry) {
  const double unit = entry["units"] == "Pa" ? 1 : entry["units"] == "kPa" ? 1e3 : 1e6;
  const MaterialPointer m = material_of(entry);
  const Point point = point_of(entry, *m);
  Mat3 P, expected_P = mat3(entry["P"]);
  Mat9 A, expected_A;
  whole_stress(*m, point.input(), &P, &A);
  for (double& x : P) x /= unit;
  for (double& x : A) x /= unit;
  for (int r = 0; r < 9; ++r)
    for (int c = 0; c < 9; ++c) expected_A[9 * r + c] = entry["dPdF"][r][c];
  // Stress is relative to its own size, but not below what rounding F in its last digit changes: eps |A|.
  const double round_off = 4 * std::numeric_limits<double>::epsilon() * size_of(expected_A);
  EXPECT_LT(distance(P, expected_P), stress_tolerance * size_of(expected_P) + round_off);
  if (!entry.value("tangent_at_kink", false)) {
    EXPECT_LT(distance(A, expected_A), tangent_tolerance * size_of(expected_A));
  }
  if (entry["energy"].is_null()) return;
  double W = 0;
  whole_energy(*m, point.input(), &W);
  EXPECT_NEAR(W / unit, entry["energy"], energy_tolerance * std::abs(entry["energy"].get<double>()) + round_off * 1e-6);
}

TEST(Reference, EveryEntryIsMet) {
  const Json data = read_json("hyperelastic.json");
  for (const Json& entry : data["entries"]) {
    SCOPED_TRACE(entry["model"].get<std::string>() + " at " + entry["F_name"].get<std::string>());
    expect_entry(entry);
  }
}

}  // namespace
}  // namespace titin::testing
