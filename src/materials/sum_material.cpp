#include "materials/sum_material.hpp"

#include <algorithm>

#include "materials/compressible.hpp"

namespace titin {
namespace {

constexpr int groups = block_size / lane_count;

InvariantSet used_by(std::span<const WeightedTerm> terms) {
  InvariantSet set;
  for (const WeightedTerm& t : terms) set.insert(t.term->uses());
  return set;
}

template <std::size_t size>
std::array<Lanes, size> gather_all(const std::array<double, size>* points, int first, int n) {
  std::array<Lanes, size> x;
  for (std::size_t c = 0; c < size; ++c) x[c] = gather(points, c, first, n);
  return x;
}

/// Directions of the points, or of the material where the caller gives none.
Vector3<Lanes> directions(const Vec3* given, const Vec3& own, int first, int n) {
  if (given) return gather_all(given, first, n);
  return {Lanes(own[0]), Lanes(own[1]), Lanes(own[2])};
}

Lanes load(const BlockValues& values, int group) {
  return Lanes(&values[group * lane_count], std::experimental::element_aligned);
}

/// Up to block_size points of an input, from their deformation to their stress.
class Block {
 public:
  Block(const PointInput& in, int first, InvariantSet used, const SumMaterial::Parts& parts, FibreMeasure measure)
      : first_(first), end_(in.n) {
    F_rate_old_ = in.F_rate_old ? in.F_rate_old : in.F_old;
    const double rate_dt = in.F_rate_old ? in.rate_dt : in.dt;
    FibreRate rate = F_rate_old_ && rate_dt > 0 && used.has_rate() ? in.rate : FibreRate::none;
    known_rate_ = {measure, in.F_rate ? rate : FibreRate::none, rate_dt};
    known_ = used;
    if (in.F_rate) rate = FibreRate::none;
    for (const FamilyInvariants& family : families)
      if (rate == FibreRate::none) used.erase(family.rate);
    used_ = used;
    options_ = {measure, rate, rate_dt};
    points.n = std::min(block_size, in.n - first);
    points.time = in.time;
    points.F = in.F + first;
    points.field_count = static_cast<int>(parts.fields.numbers.size());
    if (in.fields) points.fields = in.fields + first * points.field_count;
    for (const FamilyInvariants& family : families) points.excess[index(family.rate)].fill(0);
    for (int g = 0; g < active_groups(); ++g) set_group(in, parts.fibres, g);
  }

  /// Sums the terms' derivatives.
  void differentiate(std::span<const WeightedTerm> terms, bool want_second) {
    W_.want_second = want_second;
    for (int a = 0; a < invariant_count; ++a) {
      if (!used_.has(Invariant(a))) continue;
      W_.first[a].fill(0);
      if (want_second)
        for (int b = 0; b < invariant_count; ++b)
          if (used_.has(Invariant(b)) || b >= force_count) W_.second[a][b].fill(0);
    }
    for (const WeightedTerm& t : terms) t.term->add_derivatives(points, t.weight, W_);
  }

  void write(Mat3* P, Mat9* A) const {
    for (int g = 0; g < active_groups(); ++g) {
      EnergyDerivatives<Lanes> W;
      set_derivatives(g, W);
      std::array<Lanes, 81> tangent;
      const int first = first_ + g * lane_count;
      if (!A) {
        scatter(assemble_stress(kinematics_[g], used_, W), P, first, end_);
        continue;
      }
      scatter(assemble_tangent(kinematics_[g], used_, W, tangent), P, first, end_);
      scatter(tangent, A, first, end_);
    }
  }

  /// Cauchy stress, and with `laws` that of the volumetric laws and their energy.
  void write_cauchy(std::span<const WeightedVolumetric> laws, Sym3* T, double* energy) const {
    alignas(Lanes) BlockValues J, U{}, dU{};
    for (int g = 0; g < active_groups(); ++g)
      kinematics_[g].J.copy_to(&J[g * lane_count], std::experimental::element_aligned);
    for (const WeightedVolumetric& v : laws) v.law->add(points.n, J.data(), v.weight, U.data(), dU.data());
    if (energy)
      for (int p = 0; p < points.n; ++p) energy[p] += U[p];
    for (int g = 0; g < active_groups(); ++g) {
      EnergyDerivatives<Lanes> W;
      set_derivatives(g, W);
      const Kinematics<Lanes>& k = kinematics_[g];
      const Tensor3<Lanes> P = assemble_stress(k, used_, W);
      const Lanes over_J = 1.0 / k.J, slope = load(dU, g);
      const auto row = [&](int i, int j) {
        return over_J * (P[3 * i] * k.F[3 * j] + P[3 * i + 1] * k.F[3 * j + 1] + P[3 * i + 2] * k.F[3 * j + 2]);
      };
      const std::array<Lanes, 6> stress{row(0, 0) + slope, row(1, 1) + slope, row(2, 2) + slope,
                                        row(0, 1),         row(1, 2),         row(0, 2)};
      scatter(stress, T, first_ + g * lane_count, end_);
    }
  }

  PointBlock points;

 private:
  int active_groups() const { return (points.n + lane_count - 1) / lane_count; }

  void set_group(const PointInput& in, const FibrePair<double>& own, int g) {
    const int p = first_ + g * lane_count;
    Tensor3<Lanes> F_old;
    FibrePair<Lanes> fibres;
    if (used_.has_rate()) F_old = gather_all(F_rate_old_, p, end_);
    if (used_.has_any({Invariant::I4, Invariant::I5, Invariant::I8}))
      fibres.first = directions(in.fibre, own.first, p, end_);
    if (used_.has_any({Invariant::I6, Invariant::I8})) fibres.second = directions(in.second_fibre, own.second, p, end_);
    deform(gather_all(in.F, p, end_), F_old, fibres, used_, options_, kinematics_[g]);
    const auto v = values(kinematics_[g], used_);
    for (int a = 0; a < invariant_count; ++a)
      if (used_.has(Invariant(a))) v[a].copy_to(&points.excess[a][g * lane_count], std::experimental::element_aligned);
    if (known_rate_.rate != FibreRate::none) set_known_rate(in, fibres, g);
  }

  /// Rates that are numbers to this step: no gradients go with them.
  void set_known_rate(const PointInput& in, const FibrePair<Lanes>& fibres, int g) {
    const int p = first_ + g * lane_count;
    Kinematics<Lanes> known;
    deform(gather_all(in.F_rate, p, end_), gather_all(F_rate_old_, p, end_), fibres, known_, known_rate_, known);
    for (std::size_t f = 0; f < families.size(); ++f)
      if (known_.has(families[f].rate))
        known.rate[f].copy_to(&points.excess[index(families[f].rate)][g * lane_count],
                              std::experimental::element_aligned);
  }

  void set_derivatives(int g, EnergyDerivatives<Lanes>& W) const {
    for (int a = 0; a < invariant_count; ++a) {
      if (!used_.has(Invariant(a))) continue;
      W.first[a] = load(W_.first[a], g);
      if (!W_.want_second) continue;
      for (int b = 0; b < invariant_count; ++b)
        if (used_.has(Invariant(b))) W.second[a][b] = load(W_.second[a][b], g);
    }
    if (W_.want_second && used_.has_rate()) chain_rate(kinematics_[g], used_, W);
  }

  int first_, end_;
  InvariantSet used_, known_;  // those with gradients; all, for a rate that is known
  FibreOptions options_, known_rate_;
  const Mat3* F_rate_old_;
  std::array<Kinematics<Lanes>, groups> kinematics_;
  DerivativeBlock W_;
};

}  // namespace

SumMaterial::SumMaterial(Parts parts) : parts_(std::move(parts)), used_(used_by(parts_.terms)) {
  for (const WeightedTerm& t : parts_.terms) {
    infos_.push_back(t.info);
    (t.info.stores_energy ? stored_ : rest_).push_back(t);
  }
}

std::span<const WeightedTerm> SumMaterial::terms(PointInput::Part part) const {
  using Part = PointInput::Part;
  return part == Part::all ? parts_.terms : part == Part::stored ? stored_ : rest_;
}

std::vector<double> SumMaterial::kinks() const {
  std::vector<double> all;
  for (const WeightedTerm& t : parts_.terms) {
    const std::vector<double> own = t.term->kinks();
    all.insert(all.end(), own.begin(), own.end());
  }
  return all;
}

bool SumMaterial::symmetric_tangent(FibreRate rate) const {
  const auto symmetric = [](const WeightedTerm& t) { return t.term->symmetric(); };
  if (!std::all_of(parts_.terms.begin(), parts_.terms.end(), symmetric)) return false;
  return !has_own_gradient(rate) || !used_.has_rate();
}

void SumMaterial::evaluate(const PointInput& in, std::span<const WeightedTerm> terms, Mat3* P, Mat9* A) const {
  const InvariantSet used = used_by(terms);
  for (int first = 0; first < in.n; first += block_size) {
    Block block(in, first, used, parts_, parts_.measure);
    block.differentiate(terms, A != nullptr);
    block.write(P, A);
    for (const WeightedTerm& t : terms) t.term->add_stress(block.points, t.weight, P + first, A ? A + first : nullptr);
  }
}

void SumMaterial::stress(const PointInput& in, Mat3* P, Mat9* A) const { evaluate(in, terms(in.part), P, A); }

void SumMaterial::cauchy_stress(const PointInput& in, Sym3* T, double* W) const {
  const auto parts = terms(in.part);
  const InvariantSet used = used_by(parts);
  if (W) std::fill_n(W, in.n, 0.0);
  for (int first = 0; first < in.n; first += block_size) {
    Block block(in, first, used, parts_, parts_.measure);
    block.differentiate(parts, false);
    block.write_cauchy(parts_.volumetric, T, W ? W + first : nullptr);
    for (const WeightedTerm& t : parts) {
      if (W) t.term->add_potential(block.points, t.weight, W + first);
      if (!t.term->uses().empty()) continue;
      std::array<Mat3, block_size> P{};  // written in no invariants
      t.term->add_stress(block.points, t.weight, P.data(), nullptr);
      for (int p = 0; p < block.points.n; ++p) {
        const Sym3 own = cauchy(P[p], in.F[first + p]);
        for (int k = 0; k < 6; ++k) T[first + p][k] += own[k];
      }
    }
  }
}

void SumMaterial::term_stress(int term, const PointInput& in, Mat3* P) const {
  evaluate(in, {&parts_.terms[term], 1}, P, nullptr);
}

void SumMaterial::term_energy(int term, const PointInput& in, double* W) const {
  const WeightedTerm& t = parts_.terms[term];
  std::fill_n(W, in.n, 0.0);
  if (!t.term->stores_energy()) return;
  for (int first = 0; first < in.n; first += block_size) {
    const Block block(in, first, t.term->uses(), parts_, parts_.measure);
    t.term->add_energy(block.points, t.weight, W + first);
  }
}

void SumMaterial::potential(const PointInput& in, double* W) const {
  std::fill_n(W, in.n, 0.0);
  for (int first = 0; first < in.n; first += block_size) {
    const Block block(in, first, used_, parts_, parts_.measure);
    for (const WeightedTerm& t : terms(in.part)) t.term->add_potential(block.points, t.weight, W + first);
  }
}

void SumMaterial::fibre_state(const PointInput& in, double* stretch, double* rate, double* activation) const {
  double active = 0;
  for (const WeightedTerm& t : parts_.terms) active = std::max(active, t.term->activation(in.time));
  std::fill_n(activation, in.n, active);
  if (!has_fibres()) {
    std::fill_n(stretch, in.n, 0.0);
    std::fill_n(rate, in.n, 0.0);
    return;
  }
  InvariantSet used;
  used.insert(Invariant::I4);
  used.insert(Invariant::rate);
  for (int first = 0; first < in.n; first += block_size) {
    const Block block(in, first, used, parts_, FibreMeasure::full);
    for (int p = 0; p < block.points.n; ++p) {
      stretch[first + p] = std::sqrt(1 + block.points.excess[index(Invariant::I4)][p]);
      rate[first + p] = block.points.excess[index(Invariant::rate)][p];
    }
  }
}

Material::Volumetric SumMaterial::volumetric(double ratio) const {
  Volumetric sum{};
  for (const WeightedVolumetric& v : parts_.volumetric) {
    const VolumetricLaw::Value value = v.law->evaluate(ratio);
    sum.U += v.weight * value.U;
    sum.dU += v.weight * value.dU;
    sum.d2U += v.weight * value.d2U;
  }
  return sum;
}

}  // namespace titin
