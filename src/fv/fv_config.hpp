/// Keys of the finite-volume scheme itself.
#pragma once

#include "base/config.hpp"

namespace titin {

enum class Predictor { hancock, ader, rk2 };
enum class Limiter { mood, barth_jespersen, none };

struct FvConfig {
  int order = 2;  // in space and time
  Predictor predictor = Predictor::hancock;
  Limiter limiter = Limiter::mood;
  double cfl = 0.4;                   // part of the time that the fastest wave takes through a cell's inner ball
  double volume_change = 0.2;         // largest part of a cell's volume that a step may change
  double growth = 0.1;                // how much longer than the last a step may be
  double first_step = 0.1;            // part of the acoustic step that the first one takes
  double impedance = 1;               // factor of rho c in the nodal solver
  double principle_tolerance = 1e-4;  // of the maximum principle, relative to rho and to rho c^2
  double range_tolerance = 1e-3;      // the same, relative to the range among neighbours
  void bind(Section& s);
};

}  // namespace titin
