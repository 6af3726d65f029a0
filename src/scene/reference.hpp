/// Another history that a run is held against: an exact solution, a finer run, another code, an experiment.
///
/// A column r(t) of the reference and the run's own q(t), linear between its steps, are compared at the reference's
/// times t_k up to where the run got, with trapezoidal weights w_k:
///
///   <name>_l2  = sqrt(sum w_k (q - r)^2 / sum w_k r^2),      <name>_max = max |q - r| / max |r|.
///
/// Where r vanishes, the largest value of the reference in the same unit takes its place (1 in SI if there is none).
#pragma once

#include <map>
#include <string>
#include <vector>

#include "base/config.hpp"
#include "base/text_file.hpp"
#include "solve/model.hpp"

namespace titin {

class Reference {
 public:
  /// Reads [reference] and its file; reports what is wrong with them. Collective.
  void bind(Section& s);
  /// Finds its columns among what the run follows, and turns them into SI; reports those that are not there.
  void match(const std::vector<Quantity>& followed, Section s);

  /// The start, and then every accepted state, with the quantities of `match` in their order.
  void add(double time, const std::vector<Quantity>& quantities);
  /// What was added so far.
  void walk(StateWalk& walk);
  /// Norms by name; empty without a reference.
  std::map<std::string, double> errors() const;

 private:
  struct Column {
    std::string name, unit;
    std::size_t quantity;                // its place among what the run follows
    std::vector<double> wanted, values;  // at times_; at run_times_
  };
  void keep_wanted(Section& s);
  struct Norms {
    double l2, max;
  };
  Norms compare(const Column& column, std::size_t rows) const;
  double largest(const std::string& unit, std::size_t rows) const;

  std::string file_;
  std::vector<std::string> wanted_;  // names of columns; empty: all
  NumberTable table_;
  std::vector<Column> columns_;
  std::vector<double> times_, run_times_;  // [s]
};

}  // namespace titin
