#include "scene/output.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <stdexcept>

#include "base/timers.hpp"
#include "io/history_hdf5.hpp"

namespace titin {
namespace {

constexpr double round_off = 1e-9;  // of an interval: a step that ends there reaches it

}  // namespace

void OutputConfig::bind(Section& s) {
  s.read("fields", fields, {.doc = "write fields for ParaView, or only history.csv"});
  s.choose(
      "format", files.format,
      {{"vtu", FieldFormat::vtu}, {"vtkhdf", FieldFormat::vtkhdf}, {"vtkhdf_transient", FieldFormat::vtkhdf_transient}},
      {.doc = "files of the fields: a VTU for each rank and time, one VTKHDF for each time, or one for the whole "
              "run (ParaView 5.12 or later)"});
  s.choose("precision", files.precision, {{"single", Digits::single}, {"double", Digits::twofold}},
           {.doc = "of the numbers in them"});
  s.choose(
      "jumps", files.jumps, {{"nodes", Jumps::nodes}, {"means", Jumps::means}, {"kept", Jumps::kept}},
      {.doc = "how fields that jump between cells are written: at nodes as means over the cells of a region around "
              "them; as means of cells; or as they are, with points that no two cells share (large files)"});
  const bool by_steps = s.has("every"), by_time = s.has("interval"), by_list = s.has("times");
  s.read("every", every, {.range = {.min = 1}, .doc = "steps between two writes of the fields"});
  s.read("interval", interval,
         {.unit = "s", .range = positive, .doc = "time between two writes of the fields, instead of every"});
  s.read("history_every", history_every,
         {.range = {.min = 1}, .doc = "steps between two rows of history.csv; explicit runs have many steps"});
  s.read("history_hdf5", history_hdf5,
         {.doc = "also write history.h5 when the run ends in any way: a dataset for each column, with its unit"});
  s.read("times", at,
         {.unit = "s", .range = positive, .doc = "times at which the fields are written, instead of every"});
  if (by_steps && by_time) s.error("interval", "excludes output.every", "keep one of them");
  if (by_list && (by_steps || by_time))
    s.error("times", fmt::format("excludes output.{}", by_steps ? "every" : "interval"), "keep one of them");
  if (std::adjacent_find(at.begin(), at.end(), std::greater_equal<>()) != at.end())
    s.error("times", "does not increase", "sort the times, and give each once");
}

std::vector<double> OutputConfig::times(double end) const {
  std::vector<double> times = at;
  for (long n = 1; interval > 0 && static_cast<double>(n) * interval < end; ++n)
    times.push_back(static_cast<double>(n) * interval);
  return times;
}

Output::Output(const OutputConfig& config, const RunFolder& folder, Model& model)
    : config_(config), folder_(folder), model_(model), quantities_(model.quantities()) {}

void Output::begin() {
  Timers::Scope timer("output");
  history_ = std::make_unique<TimeSeries>(folder_.file("history.csv"), columns());
  write_row(0, 0);
  open_fields({});
  write_fields(0, 0);
}

void Output::walk(StateWalk& walk) {
  long rows = history_ ? history_->rows() : 0;
  walk.number("output_rows", rows);
  walk.number("output_last_row", last_row_);
  walk.number("output_last_fields", last_fields_);
  walk.number("output_intervals_done", intervals_done_);
  walk.number("output_times_done", times_done_);
  std::vector<double> cycles, times;
  for (const ParaView::Entry& entry : paraview_ ? paraview_->entries() : std::vector<ParaView::Entry>{}) {
    cycles.push_back(entry.cycle);
    times.push_back(entry.time);
  }
  FieldFormat format = config_.files.format;
  walk.number("output_format", format);
  walk.common("output_field_cycles", cycles);
  walk.common("output_field_times", times);
  if (!walk.reading()) return;
  quantities_ = model_.quantities();
  history_ = std::make_unique<TimeSeries>(folder_.file("history.csv"), columns(), rows);
  std::vector<ParaView::Entry> entries;
  const bool same = format == config_.files.format;  // else a new index, beside the old one
  for (std::size_t k = 0; k < cycles.size() && same; ++k) entries.push_back({static_cast<int>(cycles[k]), times.at(k)});
  open_fields(std::move(entries));
}

std::vector<Column> Output::columns() const {
  std::vector<Column> columns = {{"time", "s"}};
  for (const Quantity& q : quantities_) columns.push_back({q.name, q.unit});
  return columns;
}

void Output::open_fields(std::vector<ParaView::Entry> earlier) {
  if (!config_.fields) return;
  model_.update_fields();
  paraview_ =
      std::make_unique<ParaView>(folder_.path(), model_.mesh(), model_.fields(), config_.files, std::move(earlier));
}

bool Output::write(const Clock& clock) {
  Timers::Scope timer("output");
  const bool row_is_due = clock.steps() % config_.history_every == 0 || clock.done();
  if (row_is_due) {
    quantities_ = model_.quantities();
    write_row(clock.steps(), clock.time());
  }
  if (fields_are_due(clock)) write_fields(clock.steps(), clock.time());
  return row_is_due;
}

void Output::finish(const Clock& clock) {
  Timers::Scope timer("output");
  if (last_row_ != clock.steps()) {
    quantities_ = model_.quantities();
    write_row(clock.steps(), clock.time());
  }
  if (last_fields_ != clock.steps()) write_fields(clock.steps(), clock.time());
  if (config_.history_hdf5)
    write_history_hdf5(folder_.file("history.csv"), columns(), history_->rows(), folder_.file("history.h5"));
}

const Quantity& Output::shown() const {
  const auto is_shown = [name = model_.shown_quantity()](const Quantity& q) { return q.name == name; };
  const auto it = std::find_if(quantities_.begin(), quantities_.end(), is_shown);
  if (it == quantities_.end()) throw std::logic_error("the model shows a quantity that it does not have");
  return *it;
}

bool Output::fields_are_due(const Clock& clock) {
  if (!config_.at.empty()) {
    const double now = clock.time() * (1 + round_off);
    const std::size_t before = times_done_;
    while (times_done_ < config_.at.size() && config_.at[times_done_] <= now) ++times_done_;
    return times_done_ > before;
  }
  if (config_.interval == 0) return clock.steps() % config_.every == 0;
  const long intervals = static_cast<long>(std::floor(clock.time() / config_.interval + round_off));
  const bool due = intervals > intervals_done_;
  intervals_done_ = intervals;
  return due;
}

void Output::write_row(int step, double time) {
  std::vector<double> row = {time};
  for (const Quantity& q : quantities_) row.push_back(q.value);
  history_->add(row);
  last_row_ = step;
}

void Output::write_fields(int step, double time) {
  if (!paraview_) return;
  if (step > 0) model_.update_fields();
  paraview_->write(step, time);
  last_fields_ = step;
}

}  // namespace titin
