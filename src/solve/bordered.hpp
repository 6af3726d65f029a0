/// A matrix with a few unknowns beside it that couple to many dofs: rigid plates, links between boundaries.
///
///   [K  C] [x]   [b]
///   [R  D] [q] = [c],   W = K^-1 C,   (D - R W) q = c - R K^-1 b,   x = K^-1 b - W q
///
/// (block elimination; Golub, Van Loan 2013, Matrix Computations, 3.2.7). K^-1 is any solver of the matrix alone, which
/// keeps its pattern and its preconditioner. The whole is refined until its own residual is small.
#pragma once

#include <mfem.hpp>
#include <vector>

#include "solve/petsc.hpp"

namespace titin {

struct Border {
  struct Unknown {
    std::vector<int> dofs;  ///< this rank's true dofs that take its value; in K they have unit rows and columns
    int carrier = -1;       ///< the one of them, on one rank, whose residual is that of its equation; or none: 0
  };
  std::vector<Unknown> unknowns;
  std::vector<mfem::Vector> columns, rows;  ///< [unknown] true dofs; zero where K has unit rows
  mfem::DenseMatrix corner;                 ///< the same on all ranks
  int size() const { return static_cast<int>(unknowns.size()); }
};

class BorderedSolver {
 public:
  /// The system that `solver` is set up for, with a border whose numbers change with its matrix. Collective.
  BorderedSolver(KSP solver, const Border& border);
  ~BorderedSolver();
  BorderedSolver(const BorderedSolver&) = delete;

  void matrix_changed() { columns_known_ = false; }
  /// x of the whole, q at the dofs that take them, from the right side with c at carriers. Collective. False where
  /// `solver` failed, or the whole is singular.
  bool solve(Vec right, Vec x, double tolerance);
  int iterations() const { return iterations_; }  ///< most that a solve with K took in the last one
  bool singular() const { return singular_; }

 private:
  bool inner(Vec b, Vec x, double tolerance);
  bool solve_columns(double tolerance);
  std::vector<double> take_carried(Vec b) const;
  bool eliminate(const std::vector<double>& c, Vec z, mfem::Vector& q);
  void spread(const mfem::Vector& q, Vec x) const;

  KSP solver_;  // not owned
  const Border& border_;
  std::vector<Vec> columns_, rows_, W_;
  Vec b_ = nullptr, residual_ = nullptr, z_ = nullptr;
  mfem::DenseMatrix schur_;
  bool columns_known_ = false, singular_ = false;
  int iterations_ = 0;
};

}  // namespace titin
