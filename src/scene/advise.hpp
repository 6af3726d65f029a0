/// Model no more than a scene needs: what inertia, pressure, dimension, order, mesh and step contribute to a quantity,
/// from cheap runs, and the cheapest setting that keeps it within a tolerance.
///
/// All runs ("probes") are of the scene on its own mesh, halved until one has at most 3000 unknowns, or costs a second
/// or a twentieth of the scene. A simplification costs what it changes there: max |q - q0| / max |q0| over time. The
/// step's own error is by Richardson from steps of twice and four times the length, with the order that these show, at
/// most the scheme's; steps that are too long to show three quarters of it are halved first. The mesh's is from meshes
/// of half and a quarter of the cells along an edge, with the step that was chosen if that is the shorter one, and with
/// the rate that these show, between 1/2 and k + 1, or 1 if there is no third mesh; where it is no more than 1, cells
/// are halved first, as long as a probe costs no more than said above. A quarter of the tolerance is for
/// simplifications, a quarter for the step, half for the mesh; the parts are added, not their squares.
#pragma once

#include <functional>
#include <string>
#include <vector>

namespace titin {

struct AdviseOptions {
  std::string scene_file = "";
  std::vector<std::string> overrides = {};
  std::string quantity = "";  ///< column of history.csv without its unit; "": what the scene names, or a run shows
  double tolerance = 0;       ///< of the largest value of the quantity; 0: the scene's
  std::string apply = "";     ///< file for the scene with the proposal; "": none
};

/// A proposal.
struct Proposal {
  std::vector<std::string> proposal;  ///< overrides
  std::string quantity;
  double tolerance = 0, error = 0;  ///< asked for, estimated
  bool reached = true;              ///< is the tolerance, as far as probes can tell?
  std::vector<std::string> report;  ///< what was told, line by line
  std::string summary() const;      ///< in a line
  std::string problem() const;      ///< "" when reached
};

/// Tells the estimates as it finds them, if anybody listens. Collective. Throws InputError.
Proposal find_advice(const AdviseOptions& options, const std::function<void(const std::string&)>& listen = {});

/// Prints the estimates and the proposal, and writes the scene with it. Collective. Throws InputError.
void advise(const AdviseOptions& options);

}  // namespace titin
