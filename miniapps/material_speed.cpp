/// Time of a stress, and of a stress with its tangent, for each law of the registry; beside them the same tangent by
/// forward differentiation of P(F) in nine directions, and a neo-Hookean loop written by hand. Google Benchmark:
///
///     material_speed --benchmark_filter=goh       names are "what/law": P, P+A, AD, hand
///
/// "per_point" is seconds a point on one core. scripts/speed_table.py makes the table of
/// docs/verification/materials.md.
#include <benchmark/benchmark.h>
#include <fmt/format.h>

#include <iostream>
#include <random>

#include "materials/material.hpp"
#include "materials/registry.hpp"

namespace titin {
namespace {

constexpr int points = 512;  // stresses and tangents stay in the cache of a core

const FibrePair<double> fibres{{0.8, 0.6, 0}, {-0.6, 0.8, 0}};

std::vector<Mat3> deformations() {
  std::mt19937 random(5);
  std::uniform_real_distribution<double> part(-0.08, 0.08);
  std::vector<Mat3> F(points, identity);
  for (Mat3& f : F)
    for (double& x : f) x += part(random);
  return F;
}

/// A law with its first published values, or those of the file of examples.
struct Case {
  std::string name;
  std::shared_ptr<const Material> material;
  std::shared_ptr<const Term> term;
};

std::vector<Case> cases(const std::string& file) {
  Config examples = Config::read_file(file);
  Section values = examples.root().section("examples");
  std::vector<Case> all;
  for (const LawEntry& law : law_entries()) {
    std::string parameters;
    values.read(law.info.name, parameters, {.doc = "made-up values"});
    if (!law.info.published.empty()) parameters = law.info.published.front().parameters;
    if (parameters.empty()) throw InputError({fmt::format("{}: add values for {}", file, law.info.name)});
    Config scene(fmt::format("[m]\ndensity = \"1000 kg/m^3\"\nfibre = [0.8, 0.6, 0]\nsecond_fibre = [-0.6, 0.8, 0]\n"
                             "volumetric.bulk_modulus = \"1 MPa\"\nterms.t = {{ law = \"{}\", {} }}\n",
                             law.info.name, parameters),
                 law.info.name);
    const auto material = Material::read(scene.root().section("m"));
    std::shared_ptr<const Term> term = law.read(scene.root().section("m").section("terms").section("t"), {});
    scene.finish();
    all.push_back({law.info.name, material, term});
  }
  return all;
}

// ---- tangents by differentiation of P(F) --------------------------------------------------------------------------

using Number = Dual<9, 1>;

/// Values above rest and gradients of the isochoric invariants, straight from their definitions, for any number.
template <class T>
struct Differentiable {
  PerInvariant<T> value{};
  PerInvariant<Tensor3<T>> gradient{};

  Differentiable(const Tensor3<T>& F, InvariantSet used) {
    const T J = determinant(F), y2 = pow(J, -2.0 / 3), y4 = y2 * y2;
    const Tensor3<T> cof = cofactor(F), C = multiply(transpose(F), F);
    const auto minus_mean = [&](Invariant a, const T& I, Tensor3<T> G, double degree) {
      value[index(a)] = I;
      add<T>(G, -degree * I / J, cof);
      gradient[index(a)] = G;
    };
    if (used.has(Invariant::I1)) {
      const T I = y2 * trace(C);
      minus_mean(Invariant::I1, I, scaled<T>(2.0 * y2, F), 2.0 / 3);
    }
    if (used.has(Invariant::I2)) {
      const T c = trace(C), I = 0.5 * y4 * (c * c - contract(C, C));
      Tensor3<T> G = scaled<T>(2.0 * y4 * c, F);
      add<T>(G, -2.0 * y4, multiply(F, C));
      minus_mean(Invariant::I2, I, G, 4.0 / 3);
    }
    value[index(Invariant::J)] = J, gradient[index(Invariant::J)] = cof;
    set_fibres(F, C, used, y2, minus_mean);
    for (const auto& [a, rest] : {std::pair{Invariant::I1, 3.0},
                                  {Invariant::I2, 3.0},
                                  {Invariant::J, 1.0},
                                  {Invariant::I4, 1.0},
                                  {Invariant::I5, 1.0},
                                  {Invariant::I6, 1.0}})
      value[index(a)] -= rest;
  }

 private:
  template <class Set>
  void set_fibres(const Tensor3<T>& F, const Tensor3<T>& C, InvariantSet used, const T& y2, Set set) {
    const auto as_numbers = [](const Vec3& a) { return Vector3<T>{T(a[0]), T(a[1]), T(a[2])}; };
    const Vector3<T> a = as_numbers(fibres.first), b = as_numbers(fibres.second);
    const Vector3<T> f = multiply(F, a), g = multiply(F, b), c = multiply(C, a);
    const auto quadratic = [&](Invariant i, const Vector3<T>& u0, const Vector3<T>& v0, const Vector3<T>& u,
                               const Vector3<T>& v) {
      if (!used.has(i)) return;
      Tensor3<T> G = scaled<T>(y2, dyad(u, v0));
      add<T>(G, y2, dyad(v, u0));
      set(i, y2 * dot(u, v), G, 2.0 / 3);
    };
    quadratic(Invariant::I4, a, a, f, f);
    quadratic(Invariant::I6, b, b, g, g);
    quadratic(Invariant::I8, a, b, f, g);
    if (!used.has(Invariant::I5)) return;
    const T y4 = y2 * y2;
    Tensor3<T> G = scaled<T>(2.0 * y4, dyad(f, c));
    add<T>(G, 2.0 * y4, dyad(multiply(F, c), a));
    set(Invariant::I5, y4 * dot(c, c), G, 4.0 / 3);
  }
};

/// The invariants of some points in every direction of F, and the law's own derivatives.
struct DifferentiableBlock {
  PointBlock points;
  std::vector<Differentiable<Number>> kinematics;
  DerivativeBlock W;

  DifferentiableBlock(const Term& term, const Mat3* F, int n) {
    points.n = n;
    points.excess[index(Invariant::rate)].fill(0);
    for (int p = 0; p < n; ++p) {
      Tensor3<Number> f;
      for (int q = 0; q < 9; ++q) f[q] = Number::variable(F[p][q], q);
      kinematics.emplace_back(f, term.uses());
      for (int a = 0; a < index(Invariant::rate); ++a) points.excess[a][p] = kinematics[p].value[a].value;
    }
    W.want_second = true;
    for (auto& x : W.first) x.fill(0);
    for (auto& row : W.second)
      for (auto& x : row) x.fill(0);
    term.add_derivatives(points, 1, W);
  }
  /// P = sum W_a G_a, each W_a with the derivatives that its invariants give it.
  Tensor3<Number> stress(int p, InvariantSet used) const {
    Tensor3<Number> P{};
    for (int a = 0; a < index(Invariant::rate); ++a) {
      if (!used.has(Invariant(a))) continue;
      Number force = W.first[a][p];
      for (int b = 0; b < index(Invariant::rate); ++b)
        if (used.has(Invariant(b)))
          for (int q = 0; q < 9; ++q) force.gradient[q] += W.second[a][b][p] * kinematics[p].value[b].gradient[q];
      add(P, force, kinematics[p].gradient[a]);
    }
    return P;
  }
};

/// P and A of one term: what a law would cost without closed forms of its tangent.
void differentiate(const Term& term, const std::vector<Mat3>& F, Mat3* P, Mat9* A) {
  const int n = static_cast<int>(F.size());
  for (int first = 0; first < n; first += block_size) {
    const DifferentiableBlock block(term, &F[first], std::min(block_size, n - first));
    for (int p = 0; p < block.points.n; ++p) {
      const Tensor3<Number> stress = block.stress(p, term.uses());
      for (int r = 0; r < 9; ++r) {
        P[first + p][r] = stress[r].value;
        std::copy(stress[r].gradient.begin(), stress[r].gradient.end(), &A[first + p][9 * r]);
      }
    }
  }
}

// ---- a loop by hand -----------------------------------------------------------------------------------------------

/// Isochoric neo-Hookean P and A as one would write them for this law alone.
void neo_hookean_by_hand(double mu, const std::vector<Mat3>& F, Mat3* P, Mat9* A) {
  for (std::size_t p = 0; p < F.size(); ++p) {
    const Mat3& f = F[p];
    const double J = determinant(f), s = mu * std::pow(J, -2.0 / 3);
    Mat3 ft = cofactor(f);
    for (double& x : ft) x /= J;
    const double third = contract(f, f) / 3;
    for (int q = 0; q < 9; ++q) P[p][q] = s * (f[q] - third * ft[q]);
    for (int i = 0; i < 3; ++i)
      for (int j = 0; j < 3; ++j)
        for (int k = 0; k < 3; ++k)
          for (int l = 0; l < 3; ++l) {
            const int r = 3 * i + j, c = 3 * k + l;
            A[p][9 * r + c] = s * ((r == c) - 2.0 / 3 * (ft[c] * f[r] + f[c] * ft[r]) +
                                   2.0 / 3 * third * ft[r] * ft[c] + third * ft[3 * i + l] * ft[3 * k + j]);
          }
  }
}

// ---- measurements -------------------------------------------------------------------------------------------------

struct Arrays {
  std::vector<Mat3> F = deformations(), P = std::vector<Mat3>(points);
  std::vector<Mat9> A = std::vector<Mat9>(points);
  PointInput input() const {
    PointInput in;
    in.n = points, in.F = F.data();
    return in;
  }
};

template <class Work>
void measure(benchmark::State& state, Arrays& arrays, Work work) {
  for (auto _ : state) {
    work();
    benchmark::DoNotOptimize(arrays.P.data());
    benchmark::DoNotOptimize(arrays.A.data());
    benchmark::ClobberMemory();
  }
  state.counters["per_point"] =
      benchmark::Counter(points, benchmark::Counter::kIsIterationInvariantRate | benchmark::Counter::kInvert);
}

/// Largest difference of two tangents over the largest entry.
double difference(const std::vector<Mat9>& A, const std::vector<Mat9>& B) {
  double largest = 0, size = 0;
  for (std::size_t p = 0; p < A.size(); ++p)
    for (int k = 0; k < 81; ++k) {
      largest = std::max(largest, std::abs(A[p][k] - B[p][k]));
      size = std::max(size, std::abs(A[p][k]));
    }
  return largest == 0 ? 0 : largest / size;  // a slack fibre has no stiffness at all
}

void register_case(const Case& c) {
  const bool in_invariants = c.term->uses().has_any(
      {Invariant::I1, Invariant::I2, Invariant::J, Invariant::I4, Invariant::I5, Invariant::I6, Invariant::I8});
  benchmark::RegisterBenchmark(("P/" + c.name).c_str(), [c](benchmark::State& state) {
    Arrays a;
    measure(state, a, [&] { c.material->stress(a.input(), a.P.data(), nullptr); });
  });
  benchmark::RegisterBenchmark(("P+A/" + c.name).c_str(), [c](benchmark::State& state) {
    Arrays a;
    measure(state, a, [&] { c.material->stress(a.input(), a.P.data(), a.A.data()); });
  });
  if (!in_invariants) return;  // principal stretches: there is no P(F) in closed form to differentiate
  benchmark::RegisterBenchmark(("AD/" + c.name).c_str(), [c](benchmark::State& state) {
    Arrays a, closed;
    c.material->stress(closed.input(), closed.P.data(), closed.A.data());
    measure(state, a, [&] { differentiate(*c.term, a.F, a.P.data(), a.A.data()); });
    if (!(difference(closed.A, a.A) < 1e-10)) state.SkipWithError("differs from the closed form");
  });
}

void register_hand() {
  benchmark::RegisterBenchmark("hand/neo_hookean", [](benchmark::State& state) {
    Arrays a;
    measure(state, a, [&] { neo_hookean_by_hand(1e4, a.F, a.P.data(), a.A.data()); });
  });
}

}  // namespace
}  // namespace titin

int main(int argc, char** argv) {
  benchmark::Initialize(&argc, argv);
  try {
    for (const titin::Case& c : titin::cases(TITIN_EXAMPLES)) titin::register_case(c);
  } catch (const titin::InputError& error) {
    std::cerr << "error: " << error.what() << '\n';
    return 1;
  }
  titin::register_hand();
  benchmark::RunSpecifiedBenchmarks();
}
