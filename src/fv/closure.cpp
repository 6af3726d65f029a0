#include "fv/closure.hpp"

#include <array>

#include "materials/compressible.hpp"
#include "materials/fastest_wave.hpp"

namespace titin {
namespace {

/// A speed is sought anew when C has changed by this part of itself: the speed, and with it the impedance, is then off
/// by no more than about as much, which changes dissipation of the scheme, not its order.
constexpr double same_deformation = 0.03;
/// Another cell's speed is taken at this distance: no more, or runs would depend on how cells are shared by ranks.
constexpr double alike = 1e-12;

class FluidClosure final : public Closure {
 public:
  explicit FluidClosure(std::shared_ptr<const Fluid> fluid) : Closure(Kind::fluid), fluid_(std::move(fluid)) {}
  void stress(const CellBatch& in, Sym3* T) const override {
    for (int i = 0; i < in.n; ++i) T[i] = pressing(fluid_->state(in.density[i], in.energy[i]).pressure);
  }
  void stress_and_speed(const CellBatch& in, WaveMemory*, Sym3* T, double* speed, double* psi) const override {
    if (psi) stored(in, psi);
    for (int i = 0; i < in.n; ++i) {
      const Fluid::State s = fluid_->state(in.density[i], in.energy[i]);
      T[i] = pressing(s.pressure);
      speed[i] = s.sound_speed;
    }
  }
  bool admissible(double density, double energy) const override { return fluid_->admissible(density, energy); }
  void stored(const CellBatch& in, double* psi) const override { std::fill_n(psi, in.n, 0.0); }
  double energy_at(double density, double pressure) const override { return fluid_->energy(density, pressure); }

 private:
  static Sym3 pressing(double p) { return {-p, -p, -p, 0, 0, 0}; }
  std::shared_ptr<const Fluid> fluid_;
};

Closure::Kind kind_of(const Material& solid) {
  const auto& terms = solid.terms();
  const auto works = [](const TermInfo& t) { return !t.stores_energy || t.has_curves; };
  return std::any_of(terms.begin(), terms.end(), works) ? Closure::Kind::active : Closure::Kind::solid;
}

class SolidClosure final : public Closure {
 public:
  explicit SolidClosure(std::shared_ptr<const Material> material)
      : Closure(kind_of(*material)), material_(std::move(material)) {}

  void stress(const CellBatch& in, Sym3* T) const override { material_->cauchy_stress(points_of(in), T, nullptr); }

  void stress_and_speed(const CellBatch& in, WaveMemory* memory, Sym3* T, double* speed, double* psi) const override {
    material_->cauchy_stress(points_of(in), T, psi);
    if (psi) per_mass(in.n, psi);
    WaveMemory last;  // bodies at rest are deformed alike everywhere
    for (int i = 0; i < in.n; ++i) {
      const Sym3 C = right_cauchy_green(in.F[i]);
      WaveMemory& known = memory[in.cell[i]];
      if (!near(C, known, same_deformation)) {
        if (!near(C, last, alike)) {
          PointInput point = points_of(in);
          point.n = 1;
          point.F += i;
          last.C = C;
          fastest_wave(*material_, point, &last.speed);
        }
        known = last;
      }
      speed[i] = known.speed;
    }
  }

  bool admissible(double density, double) const override { return density > 0; }

  Volumetric volumetric(double ratio) const override {
    const Material::Volumetric law = material_->volumetric(ratio);
    return {law.U, law.dU};
  }

  std::vector<double> kinks() const override { return material_->kinks(); }
  bool has_fibres() const override { return material_->has_fibres(); }
  void fibre_stretch(const CellBatch& in, double* stretch) const override {
    std::vector<double> rate(in.n), activation(in.n);
    material_->fibre_state(points_of(in), stretch, rate.data(), activation.data());
  }

  void stored(const CellBatch& in, double* psi) const override {
    whole_energy(*material_, points_of(in), psi);
    per_mass(in.n, psi);
  }

  double energy_at(double, double) const override {
    double psi = 0;
    CellBatch rest;
    rest.n = 1;
    rest.F = &identity;
    stored(rest, &psi);
    return psi;
  }

 private:
  void per_mass(int n, double* psi) const {
    for (int i = 0; i < n; ++i) psi[i] /= material_->density();
  }
  static PointInput points_of(const CellBatch& in) {
    PointInput points;
    points.n = in.n;
    points.F = in.F;
    points.time = in.time;
    return points;
  }
  static Sym3 right_cauchy_green(const Mat3& F) {
    Sym3 C;
    const int row[] = {0, 1, 2, 0, 1, 0}, column[] = {0, 1, 2, 1, 2, 2};
    for (int k = 0; k < 6; ++k)
      C[k] = F[row[k]] * F[column[k]] + F[3 + row[k]] * F[3 + column[k]] + F[6 + row[k]] * F[6 + column[k]];
    return C;
  }
  static bool near(const Sym3& C, const WaveMemory& memory, double part) {
    Sym3 change;
    for (int k = 0; k < 6; ++k) change[k] = C[k] - memory.C[k];
    return memory.speed > 0 && contract(change, change) <= part * part * contract(C, C);
  }

  std::shared_ptr<const Material> material_;
};

}  // namespace

std::unique_ptr<Closure> make_closure(std::shared_ptr<const Fluid> fluid) {
  return std::make_unique<FluidClosure>(std::move(fluid));
}
std::unique_ptr<Closure> make_closure(std::shared_ptr<const Material> solid) {
  return std::make_unique<SolidClosure>(std::move(solid));
}

}  // namespace titin
