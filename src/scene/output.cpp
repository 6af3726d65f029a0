#include "scene/output.hpp"

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "base/timers.hpp"

namespace titin {
namespace {

constexpr double round_off = 1e-9;  // of an interval: a step that ends there reaches it

}  // namespace

void OutputConfig::bind(Section& s) {
  s.read("fields", fields, {.doc = "write fields for ParaView, or only history.csv"});
  const bool by_steps = s.has("every"), by_time = s.has("interval");
  s.read("every", every, {.range = {.min = 1}, .doc = "steps between two writes of the fields"});
  s.read("interval", interval,
         {.unit = "s", .range = positive, .doc = "time between two writes of the fields, instead of every"});
  s.read("history_every", history_every,
         {.range = {.min = 1}, .doc = "steps between two rows of history.csv; explicit runs have many steps"});
  if (by_steps && by_time) s.error("interval", "excludes output.every", "keep one of them");
}

std::vector<double> OutputConfig::times(double end) const {
  std::vector<double> times;
  for (long n = 1; interval > 0 && static_cast<double>(n) * interval < end; ++n)
    times.push_back(static_cast<double>(n) * interval);
  return times;
}

Output::Output(const OutputConfig& config, const RunFolder& folder, Model& model) : config_(config), model_(model) {
  Timers::Scope timer("output");
  quantities_ = model.quantities();
  std::vector<Column> columns = {{"time", "s"}};
  for (const Quantity& q : quantities_) columns.push_back({q.name, q.unit});
  history_ = std::make_unique<TimeSeries>(folder.file("history.csv"), columns);
  write_row(0, 0);
  if (!config.fields) return;
  ParaView::Fields fields;
  model.update_fields();
  for (const Field& field : model.fields()) fields.emplace_back(field.name, field.values);
  paraview_ = std::make_unique<ParaView>(folder.path(), "fields", model.mesh(), fields);
  write_fields(0, 0);
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
}

const Quantity& Output::shown() const {
  const auto is_shown = [name = model_.shown_quantity()](const Quantity& q) { return q.name == name; };
  const auto it = std::find_if(quantities_.begin(), quantities_.end(), is_shown);
  if (it == quantities_.end()) throw std::logic_error("the model shows a quantity that it does not have");
  return *it;
}

bool Output::fields_are_due(const Clock& clock) {
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
