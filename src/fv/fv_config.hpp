/// Keys of the finite-volume scheme itself.
#pragma once

#include "base/config.hpp"

namespace titin {

enum class Predictor { hancock, ader, rk2 };
enum class Limiter { mood, barth_jespersen, none };
/// What a cell of MOOD falls to first: limited slopes, and only then none; or none at once.
enum class Cascade { limited, constant };

struct FvConfig {
  int order = 2;  // in space and time
  Predictor predictor = Predictor::hancock;
  Limiter limiter = Limiter::mood;
  Cascade cascade = Cascade::limited;
  double cfl = 0.4;                   // part of the time that the fastest wave takes through a cell's inner ball
  double volume_change = 0.2;         // largest part of a cell's volume that a step may change
  double growth = 0.1;                // how much longer than the last a step may be
  double first_step = 0.1;            // part of the acoustic step that the first one takes
  bool patch_pressure = false;        // of solids, averaged about nodes: against volumetric locking
  double impedance = 1;               // factor of rho c in the nodal solver
  double shock_impedance = 1.33;      // s of rho (c + s |dv|), dv the jump of the velocity at a node
  double principle_tolerance = 1e-4;  // of the maximum principle, relative to rho, rho c^2, c
  double range_tolerance = 1e-3;      // the same, relative to the range among neighbours
  // A flow is smooth in a cell whose nodes differ from its linear velocity by less than this part of their differences
  // from its mean, or of the wave speed: the heat of such jumps is of their cube. Measured: with less, Kidder's
  // implosion on four layers loses slopes as it starts; with twice as much, noise stays behind Sod's shock.
  double smooth_jump = 0.2, small_jump = 0.01;
  // A fluid is shocked in a cell that shrinks while its nodes differ from its mean velocity by more than this part of
  // the wave speed. Measured: Kidder's implosion on four layers reaches 0.07; with 0.2 Noh's plateau is noisier.
  double shock_jump = 0.1;
  // Crossings of a wave for which a fluid's cell that has lost its slopes in a shock faster than sound stays without
  // them: what the mesh leaves behind a shock has no other damping. Measured: with 20 Sedov's blast bulges along
  // diagonals of a fine mesh; with 80 densities and pressures are no worse than with constant cells everywhere.
  double rest = 80;
  // A run whose steps have shrunk to this part of the longest one stands still. Measured: by 1e-2 in a piston's gas
  // after four echoes of its shock, by 1e-5 and on without end where a cell is squeezed between its neighbours.
  double collapse = 1e-5;
  // A solid's heat falls below minus this part of what its cell stores and of the motion within it: such a step takes
  // motion out of nothing.
  double heat_tolerance = 0.1;
  void bind(Section& s);
};

}  // namespace titin
