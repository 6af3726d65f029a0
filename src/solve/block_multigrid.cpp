#include "solve/block_multigrid.hpp"

#include <algorithm>
#include <cmath>

#include "base/parallel.hpp"
#include "base/timers.hpp"

namespace titin {

namespace {

constexpr int steps = 8;
constexpr double margin = 1.05;  // of the largest eigenvalue over what a few steps of the power method find of it
constexpr int first_power_steps = 12, power_steps = 3;  // the vector of the last time is a good start

/// A bulk modulus in the matrices themselves, a thousand times what else is there, leaves rounded ones too little.
BlockMatrices::Entries entries(const CellBlocks& blocks) {
  return blocks.has_pressure() ? BlockMatrices::Entries::rounded : BlockMatrices::Entries::floats;
}

std::vector<PetscInt> touched(const CellHalo& halo) {
  std::vector<PetscInt> all;
  for (int cell = 0; cell < halo.cells(); ++cell)
    all.insert(all.end(), halo.dofs(cell), halo.dofs(cell) + halo.layout().size());
  return all;
}

}  // namespace

Multigrid::Multigrid(const CellBlocks& blocks)
    : blocks_(blocks),
      halo_(blocks),
      dofs_(blocks.layout().owned_dofs, touched(halo_)),
      cells_(entries(blocks)),
      patches_(halo_, dofs_, entries(blocks)),
      coarse_(blocks, dofs_),
      index_(std::size_t(blocks.batches()) * blocks.layout().size() * float_lanes, dofs_.zero()),
      fixed_(dofs_.owned(), 1) {
  const CellLayout& layout = blocks.layout();
  const int n = layout.size();
  for (int cell = 0; cell < layout.cells; ++cell)
    for (int c = 0; c < n; ++c) {
      const int dof = dofs_.local(layout.dofs[std::size_t(cell) * n + c]);
      index_[(std::size_t(cell / float_lanes) * n + c) * float_lanes + cell % float_lanes] = dof;
      if (dof < dofs_.owned()) fixed_[dof] = 0;
    }
  for (int batch = 0; batch < blocks.batches(); ++batch) cells_.add(n);
  for (Vector* v : {&x_, &r_, &z_, &d_, &product_}) v->assign(dofs_.size(), 0.0f);
}

void Multigrid::update() {
  {
    Timers::Scope timer("patches");
    halo_.update();
    patches_.update();
    for (int batch = 0; batch < blocks_.batches(); ++batch) cells_.set(batch, blocks_.matrices(batch));
  }
  coarse_.update();
  estimate_spectrum();
}

/// z = sum of the patches' solutions. Ghosts of r are fetched.
void Multigrid::precondition(Vector& r, Vector& z) const {
  std::fill(z.begin(), z.end(), 0.0f);
  dofs_.fetch(r.data());
  patches_.apply(r.data(), z.data());
  dofs_.add(z.data());
}

/// y += A_g x, over this rank's cells.
void Multigrid::add_product(const Vector& x, Vector& y) const {
  const int n = blocks_.layout().size();
  std::vector<FloatLanes> in(n), out(n);
  for (int batch = 0; batch < blocks_.batches(); ++batch) {
    const int* dofs = &index_[std::size_t(batch) * n * float_lanes];
    float* values = reinterpret_cast<float*>(in.data());
    for (int c = 0; c < n * float_lanes; ++c) values[c] = x[dofs[c]];
    cells_.multiply(batch, in.data(), out.data());
    values = reinterpret_cast<float*>(out.data());
    for (int c = 0; c < n * float_lanes; ++c) y[dofs[c]] += values[c];
  }
}

/// r -= A_g x. Ghosts of x are fetched.
void Multigrid::subtract_product(Vector& x, Vector& r) {
  std::fill(product_.begin(), product_.end(), 0.0f);
  dofs_.fetch(x.data());
  add_product(x, product_);
  dofs_.add(product_.data());
  for (int i = 0; i < dofs_.owned(); ++i) r[i] -= product_[i];
}

/// Power method on the smoother times A_g.
void Multigrid::estimate_spectrum() {
  int count = power_steps;
  if (eigenvector_.empty()) {
    count = first_power_steps;
    eigenvector_.assign(dofs_.size(), 0.0f);
    for (int i = 0; i < dofs_.owned(); ++i)  // all frequencies, the same on any number of ranks
      if (!fixed_[i]) eigenvector_[i] = std::sin(1.0e3f * static_cast<float>((dofs_.first() + i) % 8191 + 1));
  }
  const auto norm = [&](const Vector& v) {
    double square = 0;
    for (int i = 0; i < dofs_.owned(); ++i) square += double(v[i]) * v[i];
    return std::sqrt(sum(square));
  };
  double before = norm(eigenvector_);
  for (int k = 0; k < count && before > 0; ++k) {
    for (float& v : eigenvector_) v = static_cast<float>(v / before);
    std::fill(r_.begin(), r_.end(), 0.0f);
    subtract_product(eigenvector_, r_);
    precondition(r_, z_);
    for (int i = 0; i < dofs_.owned(); ++i) eigenvector_[i] = -z_[i];
    before = norm(eigenvector_);
    largest_ = before;
  }
}

/// x += steps of Chebyshev's iteration of the fourth kind on A_g d = r (Lottes 2023, algorithm 1): the polynomial that
/// is best after an exact coarse correction, with no lower end of the spectrum to guess. r is used up.
void Multigrid::smooth(Vector& x, Vector& r) {
  const double upper = margin * largest_;
  for (int k = 0; k < steps; ++k) {
    if (k > 0) subtract_product(d_, r);
    precondition(r, z_);
    const auto keep = static_cast<float>(k > 0 ? (2.0 * k - 1) / (2 * k + 3) : 0);
    const auto take = static_cast<float>((8.0 * k + 4) / ((2 * k + 3) * upper));
    for (int i = 0; i < dofs_.owned(); ++i) {
      d_[i] = keep * d_[i] + take * z_[i];
      x[i] += d_[i];
    }
  }
}

bool Multigrid::apply(const double* r, double* z) {
  const int n = dofs_.owned();
  // float's range is small: everything is relative to the largest entry
  double scale = 0;
  for (int i = 0; i < n; ++i) scale = std::max(scale, std::abs(r[i]));
  scale = max(scale);
  if (!(scale > 0)) {
    std::copy_n(r, n, z);
    return true;
  }
  for (int i = 0; i < n; ++i) r_[i] = fixed_[i] ? 0.0f : static_cast<float>(r[i] / scale);
  std::fill(x_.begin(), x_.end(), 0.0f);
  const bool solved = coarse_.correct(r_.data(), x_.data());
  {
    Timers::Scope timer("smoother");
    subtract_product(x_, r_);
    smooth(x_, r_);
  }
  for (int i = 0; i < n; ++i) z[i] = fixed_[i] ? r[i] : scale * x_[i];
  return solved;
}

std::size_t Multigrid::bytes() const {
  const std::size_t vectors =
      (x_.capacity() + r_.capacity() + z_.capacity() + d_.capacity() + product_.capacity() + eigenvector_.capacity()) *
      sizeof(float);
  return halo_.bytes() + cells_.bytes() + patches_.bytes() + vectors + index_.capacity() * sizeof(int) +
         fixed_.capacity();
}

}  // namespace titin
