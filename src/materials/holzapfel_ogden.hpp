/// Holzapfel-Ogden myocardium: W = a/(2 b) (exp(b (I1 - 3)) - 1) + sum over f, s of a_i/(2 b_i) (exp(b_i <I_i - 1>^2) -
/// 1)
/// + afs/(2 bfs) (exp(bfs I8^2) - 1) [J/m^3], I_f = I4 along the fibres, I_s = I6 along the sheets.
/// Holzapfel & Ogden (2009), Phil. Trans. R. Soc. A 367, 3445, eq. 5.38. I8 is taken as its excess over rest, so that
/// directions that are not quite orthogonal leave no stress at rest.
#pragma once

#include "materials/overflow.hpp"
#include "materials/registry.hpp"

namespace titin {

struct HolzapfelOgden {
  static constexpr auto name = "holzapfel_ogden";
  static constexpr auto formula =
      "W = a/(2 b) (exp(b (I1 - 3)) - 1) + sum_f,s a_i/(2 b_i) (exp(b_i <I_i - 1>^2) - 1) + afs/(2 bfs) (exp(bfs I8^2) "
      "- 1)";
  static constexpr auto source = "Holzapfel & Ogden 2009, Phil. Trans. R. Soc. A 367:3445, eq. 5.38";
  static constexpr std::array uses{Invariant::I1, Invariant::I4, Invariant::I6, Invariant::I8};
  inline static const std::array published{ParameterSet{
      "myocardium of the left ventricle, simple shear",
      R"(a = "0.059 kPa", b = 8.023, af = "18.472 kPa", bf = 16.026, as = "2.481 kPa", bs = 11.120, afs = "0.216 kPa", bfs = 11.436)",
      "Holzapfel & Ogden 2009, table 1, second row"}};

  double a = 0, b = 0, af = 0, bf = 0, as = 0, bs = 0, afs = 0, bfs = 0;

  void bind(Section& s) {
    const auto stiffness = [&](const char* key, double& value, const char* doc) {
      s.read(key, value, {.unit = "Pa", .range = non_negative, .required = true, .doc = doc});
    };
    const auto exponent = [&](const char* key, double& value, const char* doc) {
      s.read(key, value, {.range = positive, .required = true, .doc = doc});
    };
    stiffness("a", a, "stiffness of the matrix");
    exponent("b", b, "how fast the matrix stiffens");
    stiffness("af", af, "stiffness along the fibres");
    exponent("bf", bf, "how fast fibres stiffen");
    stiffness("as", as, "stiffness along the sheets (second_fibre)");
    exponent("bs", bs, "how fast sheets stiffen");
    stiffness("afs", afs, "stiffness of the coupling of fibres and sheets");
    exponent("bfs", bfs, "how fast the coupling stiffens");
  }
  std::vector<Advice> advice() const {
    std::vector<Advice> list;
    for (const auto& [key, exponent] : {std::pair{"bf", bf}, {"bs", bs}, {"bfs", bfs}})
      for (const Advice& a : advice_of_exponent(key, exponent, strain_of_tissue)) list.push_back(a);
    return list;
  }
  template <class T>
  T energy(const Invariants<T>& x) const {
    using std::expm1;
    T W = 0.5 * a / b * expm1(b * x.e1()) + squared_exponential(afs, bfs, x.e8());
    if (x.e4() > 0.0) W += squared_exponential(af, bf, x.e4());
    if (x.e6() > 0.0) W += squared_exponential(as, bs, x.e6());
    return W;
  }

 private:
  template <class T>
  static T squared_exponential(double stiffness, double exponent, const T& e) {
    using std::expm1;
    return 0.5 * stiffness / exponent * expm1(exponent * e * e);
  }
};
TITIN_LAW(HolzapfelOgden)

}  // namespace titin
