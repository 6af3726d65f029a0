/// The state of a run, walked: whoever keeps some of it names it here once, and the same walk writes it and reads it
/// back (io/checkpoint.hpp).
///
/// Numbers of the mesh go by the number of their cell or node in the whole mesh, so that another number of ranks finds
/// them too.
#pragma once

#include <mfem.hpp>
#include <string>
#include <vector>

namespace titin {

/// Cells or nodes of this rank, by numbers that do not depend on how the mesh is shared out (mesh/mesh_numbers.hpp).
/// Ranks that share a node all have it, with the same values.
struct StateRows {
  std::string kind;  ///< "cells": rows of one kind have the same numbers in a whole walk
  std::vector<long> number;
};

/// All functions are collective. A name is used once in a walk.
class StateWalk {
 public:
  virtual ~StateWalk() = default;
  virtual bool reading() const = 0;

  /// The same on all ranks; as long as it was when it was written.
  virtual void common(const std::string& name, std::vector<double>& values) = 0;
  /// This rank's parts of sums over ranks. On another number of ranks the first gets the sums and the others nothing.
  virtual void parts(const std::string& name, std::vector<double>& values) = 0;
  /// One row after the other, `width` numbers each.
  virtual void rows(const std::string& name, const StateRows& rows, int width, double* values) = 0;
  /// The same with a size for each row.
  virtual void ragged(const std::string& name, const StateRows& rows, const std::vector<int>& sizes,
                      double* values) = 0;

  template <class Number>
  void number(const std::string& name, Number& value) {
    std::vector<double> one = {static_cast<double>(value)};
    common(name, one);
    value = static_cast<Number>(one.at(0));
  }
  void vector(const std::string& name, const StateRows& dofs, mfem::Vector& values) {
    values.SetSize(static_cast<int>(dofs.number.size()));
    rows(name, dofs, 1, values.GetData());
  }
  /// Numbers that lie about: list(row, take) calls take(x) for each of the row's `width` numbers, in the same order.
  template <class List>
  void records(const std::string& name, const StateRows& of, int width, List list) {
    std::vector<double> values(of.number.size() * width);
    double* at = values.data();
    for (std::size_t row = 0; row < of.number.size(); ++row) list(row, [&](double& x) { *at++ = x; });
    rows(name, of, width, values.data());
    if (!reading()) return;
    at = values.data();
    for (std::size_t row = 0; row < of.number.size(); ++row) list(row, [&](double& x) { x = *at++; });
  }
};

}  // namespace titin
