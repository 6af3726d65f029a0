/// What a run writes when: rows of history.csv, fields for ParaView now and then.
#pragma once

#include <memory>
#include <vector>

#include "base/config.hpp"
#include "io/paraview.hpp"
#include "io/run_folder.hpp"
#include "io/time_series.hpp"
#include "solve/clock.hpp"
#include "solve/model.hpp"

namespace titin {

struct OutputConfig {
  bool fields = true;
  FieldFiles files;
  int every = 1;          // steps
  int history_every = 1;  // steps
  bool history_hdf5 = false;
  double interval = 0;     // [s]; 0: by steps
  std::vector<double> at;  // [s]; besides the first and the last; none: by steps or interval
  void bind(Section& s);
  std::vector<double> times(double end) const;  ///< when fields are due, if by time
};

/// All functions are collective.
class Output {
 public:
  /// begin() or walk() comes first.
  Output(const OutputConfig& config, const RunFolder& folder, Model& model);
  /// Writes the initial state.
  void begin();
  /// How far the files are; reading it opens those that are there and cuts off what was written later.
  void walk(StateWalk& walk);
  void sync() const { history_->sync(); }  ///< waits until the history is on disk
  /// Of the state that was just accepted. Returns false when nothing of it goes into the history.
  bool write(const Clock& clock);
  /// The last state is always in the history and among the fields; writes history.h5 if it is asked for.
  void finish(const Clock& clock);

  const std::vector<Quantity>& quantities() const { return quantities_; }  ///< as last written
  const Quantity& shown() const;                                           ///< the one for the line of a step

 private:
  bool fields_are_due(const Clock& clock);
  std::vector<Column> columns() const;
  void open_fields(std::vector<ParaView::Entry> earlier);
  void write_row(int step, double time);
  void write_fields(int step, double time);

  OutputConfig config_;
  const RunFolder& folder_;
  Model& model_;
  std::vector<Quantity> quantities_;
  std::unique_ptr<TimeSeries> history_;
  std::unique_ptr<ParaView> paraview_;
  int last_fields_ = -1, last_row_ = -1;  // steps
  long intervals_done_ = 0;
  std::size_t times_done_ = 0;  // of config_.at
};

}  // namespace titin
