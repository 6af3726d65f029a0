/// The nodes that this rank's cells see, for kernels that run over cells: its own first, in the order of true dofs,
/// then those of other ranks, in the order of (rank, number). Values are [node][component].
#pragma once

#include <memory>
#include <mfem.hpp>
#include <vector>

#include "base/exchange.hpp"

namespace titin {

class NodeHalo {
 public:
  /// `space` byVDIM, conforming. Collective.
  explicit NodeHalo(const mfem::ParFiniteElementSpace& space);

  int components() const { return components_; }
  int owned() const { return owned_; }
  int nodes() const { return static_cast<int>(number_.size()); }    ///< owned ones and others
  int number(int local_node) const { return number_[local_node]; }  ///< place of MFEM's local node here
  bool is_other(int place) const { return place >= owned_; }
  std::size_t bytes_sent() const { return exchange_->sent() * components_ * sizeof(double); }  ///< of one exchange

  /// Fetches the values of other ranks' nodes; `values` is left alone until end_fetch.
  template <class Real>
  void begin_fetch(Real* values) {
    auto& buffer = this->buffer<Real>();
    const std::size_t block = components_;
    for (std::size_t i = 0; i < lent_.size(); ++i) std::copy_n(values + block * lent_[i], block, &buffer[block * i]);
    back_->begin(buffer.data(), values + block * owned_, components_);
  }
  void end_fetch() { back_->end(); }

  /// Adds the values at other ranks' nodes to those of their owners.
  template <class Real>
  void begin_sum(const Real* values) {
    exchange_->begin(values + std::size_t(components_) * owned_, this->buffer<Real>().data(), components_);
  }
  template <class Real>
  void end_sum(Real* values) {
    exchange_->end();
    const std::size_t block = components_;
    const auto& buffer = this->buffer<Real>();
    for (std::size_t i = 0; i < lent_.size(); ++i)
      for (std::size_t c = 0; c < block; ++c) values[block * lent_[i] + c] += buffer[block * i + c];
  }

 private:
  template <class Real>
  std::vector<Real>& buffer() {
    if constexpr (sizeof(Real) == sizeof(double))
      return doubles_;
    else
      return floats_;
  }
  int components_, owned_;
  std::vector<int> number_;                    // [local node of MFEM]
  std::vector<int> lent_;                      // own nodes that other ranks see, in the order they ask for them
  std::unique_ptr<Exchange> exchange_, back_;  // to the owners; from them
  std::vector<double> doubles_;
  std::vector<float> floats_;
};

}  // namespace titin
