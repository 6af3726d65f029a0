#include "scene/probe.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "base/config.hpp"
#include "base/log.hpp"
#include "base/parallel.hpp"
#include "base/timers.hpp"
#include "base/words.hpp"
#include "scene/followed.hpp"
#include "scene/scene.hpp"

namespace titin {
namespace {

std::size_t followed_place(const std::string& quantity, const std::vector<Quantity>& followed) {
  if (const auto place = place_of(quantity, followed)) return *place;
  throw InputError({fmt::format("this run follows no {}; {}", in_quotes(quantity), meant_instead(quantity, followed))});
}

/// One attempt; what ends the run, or "".
std::string try_step(Model& model, Clock& clock, Probe& seen) {
  const Step step = model.advance(clock.dt());
  seen.newton += step.newton;
  if (!step.ok()) {
    model.rewind();
    return clock.cut(step) ? "" : step.failure;
  }
  if (clock.reject(step)) {
    model.rewind();
    return "";
  }
  model.accept();
  clock.accept(step, model.largest_dt());
  seen.order = step.order;
  return "";
}

double at(const Probe& p, double time) {
  const auto after = std::lower_bound(p.times.begin(), p.times.end(), time);
  if (after == p.times.end()) return p.values.back();
  const std::size_t k = after - p.times.begin();
  if (k == 0) return p.values.front();
  const double part = (time - p.times[k - 1]) / (p.times[k] - p.times[k - 1]);
  return p.values[k - 1] + part * (p.values[k] - p.values[k - 1]);
}

/// What solvers say of themselves would be said once for each probe.
class Silence {
 public:
  Silence() : level_(logging::level()) {
    if (level_ == logging::Level::normal) logging::set_level(logging::Level::quiet);
  }
  ~Silence() { logging::set_level(level_); }
  Silence(const Silence&) = delete;
  Silence& operator=(const Silence&) = delete;

 private:
  logging::Level level_;
};

}  // namespace

Probe probe(const std::string& file, const std::vector<std::string>& overrides, const std::string& quantity) {
  const Silence silence;
  const double start = cpu_seconds();
  const Scene scene = Scene::read(file, overrides);
  Model& model = *scene.model;
  Clock clock(scene.clock, model.largest_dt());
  clock.land_on(model.kinks());
  const std::size_t place = followed_place(quantity, model.quantities());
  Probe seen;
  seen.cells = static_cast<long>(model.mesh().GetGlobalNE());
  seen.unknowns = model.unknowns();
  const auto keep = [&] {
    const std::vector<Quantity> all = model.quantities();
    seen.times.push_back(clock.time());
    seen.values.push_back(all[place].value);
    seen.largest = std::max(seen.largest, std::abs(all[place].value));
    for (const Quantity& q : all)
      if (q.unit == all[place].unit) seen.largest_of_unit = std::max(seen.largest_of_unit, std::abs(q.value));
  };
  keep();
  while (seen.ok() && !clock.done()) {
    const int before = clock.steps();
    seen.failure = try_step(model, clock, seen);
    if (clock.steps() > before) keep();
  }
  seen.steps = clock.steps();
  seen.cpu_seconds = sum(cpu_seconds() - start);
  return seen;
}

double difference(const Probe& a, const Probe& b) {
  const Probe &coarse = a.times.size() < b.times.size() ? a : b, &fine = &coarse == &a ? b : a;
  double apart = 0;
  for (std::size_t k = 0; k < coarse.times.size(); ++k)
    apart = std::max(apart, std::abs(at(fine, coarse.times[k]) - coarse.values[k]));
  return b.largest > 0 ? apart / b.largest : apart;
}

int lines_that_follow(const Probe& probe, double error) {
  const auto missed = [&](int lines) {
    const double length = (probe.times.back() - probe.times.front()) / lines;
    double most = 0;
    for (std::size_t k = 0; k < probe.times.size(); ++k) {
      const double line = std::floor((probe.times[k] - probe.times.front()) / length);
      const double from = probe.times.front() + line * length, part = (probe.times[k] - from) / length;
      most = std::max(most, std::abs((1 - part) * at(probe, from) + part * at(probe, from + length) - probe.values[k]));
    }
    return most;
  };
  int lines = 1;
  while (lines < probe.steps && missed(lines) > error * probe.largest) lines *= 2;
  return lines;
}

}  // namespace titin
