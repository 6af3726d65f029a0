/// Model no more than a scene needs: what inertia, pressure, dimension, order, mesh and step contribute to a quantity,
/// from cheap runs, and the cheapest setting that keeps it within a tolerance.
///
/// All runs ("probes") are of the scene on a coarse mesh, of at most `probe_unknowns` unknowns. A simplification costs
/// what it changes there: max |q - q0| / max |q0| over time. The step's own error is by Richardson from a step of twice
/// the length, with the order of the scheme; the mesh's from meshes of half and a quarter of the cells along an edge
/// with the rate that these show, between 1 and k + 1, or 1 if there is no third mesh. A quarter of the tolerance is
/// for simplifications, a quarter for the step, half for the mesh; the parts are added, not their squares.
#pragma once

#include <string>
#include <vector>

namespace titin {

struct AdviseOptions {
  std::string scene_file = "";
  std::vector<std::string> overrides = {};
  std::string quantity = "";  ///< column of history.csv without its unit; "": the one that a run shows
  double tolerance = 0.02;    ///< of the largest value of the quantity
  std::string apply = "";     ///< file for the scene with the proposal; "": none
};

/// Prints the estimates and the proposal. Collective. Throws InputError.
void advise(const AdviseOptions& options);

}  // namespace titin
