/// The kernel of CellMatrices for one order and number of points.
#pragma once

#include "fe/cell_matrices.hpp"
#include "fe/hexahedron_batch.hpp"

namespace titin {

/// n nodes and q points a direction.
template <int n, int q, bool symmetric>
class HexahedronMatrices : public CellMatrices {
 public:
  HexahedronMatrices(const mfem::ParFiniteElementSpace& space, const CellTables& tables);
  int cells_at_once() const override { return lanes; }
  void form(int first, int count, const TangentOfCell& at) override;
  double* matrix(int i) override { return &K_[std::size_t(i) * size * size]; }

 private:
  using Batch = HexahedronBatch<double, n, q, symmetric>;
  using V = typename Batch::V;
  static constexpr int lanes = Batch::lanes, nodes = Batch::nodes, points = Batch::points, modes = Batch::modes;
  static constexpr int size = 3 * nodes, face = q * q;
  /// Kinds of products of two polynomials of one direction, the first of a row, the second of a column: value or slope.
  static constexpr int kind(bool row_slope, bool column_slope) { return 2 * row_slope + column_slope; }

  void set_coupling();
  void form_block(int i, int k);
  void contract_z(int pair, V (&X)[9][face]) const;
  void contract_y(int pair, const V (&X)[9][face], V (&Y)[4][q]) const;
  void contract_x(const V (&Y)[4][q], V* block) const;
  void add_volume(int i, int k);
  void store(int i, int k);

  HexahedronFiller<double, n, q, symmetric> filler_;
  LineTables<double, n, q> line_;
  double product_[4][q][n * n];  // of two polynomials at the points
  int lexicographic_[nodes];     // place of MFEM's node in lexicographic order
  std::unique_ptr<Batch> batch_ = std::make_unique<Batch>();
  std::vector<V> coupling_, stiff_coupling_;  // B, S B: [mode][component][node]
  V moduli_[9][points];                       // A_iM,kN of one (i, k) at [3 M + N]
  V mass_[points];                            // in the block at hand: inertia, or zero
  V block_[nodes * nodes];
  std::vector<double> K_;
};

template <int n, int q, bool symmetric>
HexahedronMatrices<n, q, symmetric>::HexahedronMatrices(const mfem::ParFiniteElementSpace& space,
                                                        const CellTables& tables)
    : filler_(tables),
      line_(line_tables<double, n, q>(*space.GetFE(0), tables.rule(0))),
      coupling_(modes * size),
      stiff_coupling_(modes * size),
      K_(std::size_t(lanes) * size * size) {
  const auto& order = dynamic_cast<const mfem::NodalFiniteElement&>(*space.GetFE(0)).GetLexicographicOrdering();
  for (int a = 0; a < nodes; ++a) lexicographic_[order[a]] = a;
  for (int p = 0; p < q; ++p)
    for (int a = 0; a < n; ++a)
      for (int b = 0; b < n; ++b)
        for (int row = 0; row < 2; ++row)
          for (int column = 0; column < 2; ++column)
            product_[kind(row, column)][p][a * n + b] =
                (row ? line_.node_slope : line_.value)[p][a] * (column ? line_.node_slope : line_.value)[p][b];
}

template <int n, int q, bool symmetric>
void HexahedronMatrices<n, q, symmetric>::form(int first, int count, const TangentOfCell& at) {
  int cells[lanes];
  for (int lane = 0; lane < lanes; ++lane) cells[lane] = lane < count ? first + lane : -1;
  filler_.fill(cells, at, *batch_);
  set_coupling();
  for (int i = 0; i < 3; ++i)
    for (int k = symmetric ? i : 0; k < 3; ++k) {
      form_block(i, k);
      add_volume(i, k);
      store(i, k);
    }
}

/// B_l,ia = sum over points of psi_l c_iM d_M N_a, and S B.
template <int n, int q, bool symmetric>
void HexahedronMatrices<n, q, symmetric>::set_coupling() {
  V c[3][points], values[points];
  for (int l = 0; l < modes; ++l)
    for (int i = 0; i < 3; ++i) {
      for (int p = 0; p < points; ++p) {
        const auto& point = batch_->point[p];
        for (int M = 0; M < 3; ++M) c[M][p] = point.psi[l] * point.c[3 * i + M];
        values[p] = 0;
      }
      add_slopes_transposed<q>(line_, c[0], c[1], c[2], values);
      from_points<n, q>(line_, values, &coupling_[(l * 3 + i) * nodes]);
    }
  for (int l = 0; l < modes; ++l)
    for (int c = 0; c < size; ++c) {
      V sum = 0;
      for (int m = 0; m < modes; ++m) sum += batch_->S[l * modes + m] * coupling_[m * size + c];
      stiff_coupling_[l * size + c] = sum;
    }
}

template <int n, int q, bool symmetric>
void HexahedronMatrices<n, q, symmetric>::form_block(int i, int k) {
  for (int p = 0; p < points; ++p) {
    const auto& point = batch_->point[p];
    for (int M = 0; M < 3; ++M)
      for (int N = 0; N < 3; ++N) moduli_[3 * M + N][p] = point.A[Batch::entry(3 * i + M, 3 * k + N)];
    mass_[p] = i == k ? point.inertia : V(0);
  }
  V X[9][face], Y[4][q];
  const bool half = symmetric && i == k;  // the rest is mirrored
  for (int za = 0; za < n; ++za)
    for (int zb = half ? za : 0; zb < n; ++zb) {
      contract_z(za * n + zb, X);
      for (int ya = 0; ya < n; ++ya)
        for (int yb = half && za == zb ? ya : 0; yb < n; ++yb) {
          contract_y(ya * n + yb, X, Y);
          contract_x(Y, &block_[((za * n + ya) * nodes + zb * n + yb) * n]);
        }
    }
  for (int a = 0; a < nodes && half; ++a)
    for (int b = 0; b < a; ++b)
      if (a / n != b / n) block_[a * nodes + b] = block_[b * nodes + a];
}

/// X_MN(y, x): directions are numbered x, y, z as M and N are.
template <int n, int q, bool symmetric>
inline void HexahedronMatrices<n, q, symmetric>::contract_z(int pair, V (&X)[9][face]) const {
#pragma GCC unroll 9
  for (int MN = 0; MN < 9; ++MN) {
    const auto& product = product_[kind(MN / 3 == 2, MN % 3 == 2)];
    for (int yx = 0; yx < face; ++yx) {
      V sum = product[0][pair] * moduli_[MN][yx];
      for (int z = 1; z < q; ++z) sum += product[z][pair] * moduli_[MN][z * face + yx];
      if (MN == 8)  // the mass has values along x and y too
        for (int z = 0; z < q; ++z) sum += product_[0][z][pair] * mass_[z * face + yx];
      X[MN][yx] = sum;
    }
  }
}

/// Y(x) by the kind of product that is left along x.
template <int n, int q, bool symmetric>
inline void HexahedronMatrices<n, q, symmetric>::contract_y(int pair, const V (&X)[9][face], V (&Y)[4][q]) const {
#pragma GCC unroll 4
  for (int along_x = 0; along_x < 4; ++along_x)
#pragma GCC unroll 5
    for (int x = 0; x < q; ++x) {
      V sum = 0;
#pragma GCC unroll 9
      for (int MN = 0; MN < 9; ++MN) {
        if (kind(MN / 3 == 0, MN % 3 == 0) != along_x) continue;
#pragma GCC unroll 5
        for (int y = 0; y < q; ++y) sum += product_[kind(MN / 3 == 1, MN % 3 == 1)][y][pair] * X[MN][y * q + x];
      }
      Y[along_x][x] = sum;
    }
}

/// The n x n entries of one pair of lines of nodes along x.
template <int n, int q, bool symmetric>
inline void HexahedronMatrices<n, q, symmetric>::contract_x(const V (&Y)[4][q], V* block) const {
  for (int a = 0; a < n; ++a)
    for (int b = 0; b < n; ++b) {
      V sum = product_[0][0][a * n + b] * Y[0][0];
#pragma GCC unroll 4
      for (int along_x = 0; along_x < 4; ++along_x)
#pragma GCC unroll 5
        for (int x = along_x == 0; x < q; ++x) sum += product_[along_x][x][a * n + b] * Y[along_x][x];
      block[a * nodes + b] = sum;
    }
}

template <int n, int q, bool symmetric>
void HexahedronMatrices<n, q, symmetric>::add_volume(int i, int k) {
  for (int a = 0; a < nodes; ++a) {
    V SB[modes];
    for (int l = 0; l < modes; ++l) SB[l] = stiff_coupling_[(l * 3 + i) * nodes + a];
    for (int b = 0; b < nodes; ++b)
      for (int l = 0; l < modes; ++l) block_[a * nodes + b] += SB[l] * coupling_[(l * 3 + k) * nodes + b];
  }
}

/// The block, and its transpose on the other side of the diagonal; a row of each lane's matrix at a time.
template <int n, int q, bool symmetric>
void HexahedronMatrices<n, q, symmetric>::store(int i, int k) {
  const auto store_block = [this](int i, int k, int row_step, int column_step) {
    for (int a = 0; a < nodes; ++a) {
      double* row = &K_[(std::size_t(i) * nodes + a) * size + k * nodes];
      const V* entries = &block_[lexicographic_[a] * row_step];
      for (int b = 0; b < nodes; ++b) {
        const V entry = entries[lexicographic_[b] * column_step];
        for (int lane = 0; lane < lanes; ++lane) row[std::size_t(lane) * size * size + b] = entry[lane];
      }
    }
  };
  store_block(i, k, nodes, 1);
  if (symmetric && i != k) store_block(k, i, 1, nodes);
}

}  // namespace titin
