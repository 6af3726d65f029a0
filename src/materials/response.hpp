/// Stress with a memory: what a term becomes when something is wrapped around it (viscoelasticity, damage), or a law
/// that has a history of its own. Works on whole tensors, so it composes over any law.
///
/// The history of a point is a row of doubles that the response lays out itself; at t_n it is read, at t_n+1 written
/// anew by every evaluation, and whoever owns the points makes the new one old when a step is accepted.
#pragma once

#include <functional>
#include <memory>

#include "materials/material.hpp"
#include "materials/registry.hpp"

namespace titin {

/// Rows of history of a batch: point p has old[p * stride + ...] and now[p * stride + ...].
struct HistoryRows {
  const double* old = nullptr;
  double* now = nullptr;
  int stride = 0;
  HistoryRows shifted(int columns) const { return {old + columns, now + columns, stride}; }
};

class Response {
 public:
  virtual ~Response() = default;
  /// Doubles of history a point has, those of what is inside included.
  virtual int history_size() const = 0;
  /// The history of one point at rest.
  virtual void start(const PointInput& rest, double* row) const = 0;
  /// First Piola stress P [Pa], stored energy W [J/m^3] and, unless null, A = dP/dF of in.n points; writes the new
  /// history.
  virtual void evaluate(const PointInput& in, HistoryRows history, Mat3* P, Mat9* A, double* W) const = 0;
  /// Energy dissipated since the start [J/m^3], from a row.
  virtual double dissipated(const double* row) const = 0;
};

/// Wraps something around a response.
using Wrapper = std::function<std::shared_ptr<const Response>(std::shared_ptr<const Response>)>;

/// A material's stress (without its volumetric law) as a response without history.
class ElasticResponse final : public Response {
 public:
  explicit ElasticResponse(std::shared_ptr<const Material> material) : material_(std::move(material)) {}
  int history_size() const override { return 0; }
  void start(const PointInput&, double*) const override {}
  void evaluate(const PointInput& in, HistoryRows, Mat3* P, Mat9* A, double* W) const override;
  double dissipated(const double*) const override { return 0; }

 private:
  std::shared_ptr<const Material> material_;
};

/// Reads what a term's table says should be wrapped around it, inner first: `maxwell`, `prony`, `spectrum` or
/// `fractional`, then `damage`.
std::vector<Wrapper> read_wrappers(Section& term, const Term* law, TermOptions options);

}  // namespace titin
