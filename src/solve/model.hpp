/// What the run loop knows of a formulation.
#pragma once

#include <mfem.hpp>
#include <string>
#include <vector>

#include "solve/state_walk.hpp"

namespace titin {

/// The outcome of one attempted time step. Failure is a value.
struct Step {
  double time = 0, dt = 0;        ///< [s] at the end of the step
  int newton = 0;                 ///< iterations
  int krylov = 0;                 ///< linear iterations
  double residual = 0;            ///< last residual over its scale
  std::vector<double> residuals;  ///< the same of each iteration: shows the order of convergence
  double error = 0;               ///< estimate of the step's own error over the size of the solution
  int order = 1;                  ///< of the scheme: the error is of one order more in dt
  std::string failure;            ///< empty when it converged; else where and why, in words
  bool ok() const { return failure.empty(); }
};

/// One number that is followed in time: a column of history.csv, "name [unit]".
struct Quantity {
  std::string name, unit;
  double value = 0;
};

/// One field for ParaView; the grid function is the model's and is current after Model::update_fields.
struct Field {
  std::string name, unit;
  mfem::ParGridFunction* values = nullptr;
};

class Model {
 public:
  virtual ~Model() = default;

  /// As a scene names it.
  virtual std::string name() const = 0;
  /// Tries the step from the last accepted state to time() + dt. Collective.
  virtual Step advance(double dt) = 0;
  /// Makes the tried step the accepted state.
  virtual void accept() = 0;
  /// Forgets the tried step.
  virtual void rewind() = 0;
  virtual double time() const = 0;
  /// Largest step that the formulation can take from here [s] (explicit: stability); infinite for implicit ones.
  virtual double largest_dt() const = 0;

  /// Times at which what drives the model has a kink: adaptive steps end there.
  virtual std::vector<double> kinks() const { return {}; }

  /// Of the accepted state. Collective. The same names in the same order at every call.
  virtual std::vector<Quantity> quantities() = 0;
  /// What the formulation keeps: how far the run was off so far, relative to what it should have kept.
  virtual std::vector<Quantity> conservation() { return {}; }
  /// Relative norms of the accepted state's error, where the exact solution is known. Collective.
  virtual std::vector<Quantity> errors() { return {}; }
  /// Bytes that an explicit step has to move between memory and cores, all ranks: what bounds its speed. Collective.
  virtual double bytes_per_step() const { return 0; }
  /// Name of the quantity that the line of a step shows.
  virtual std::string shown_quantity() const = 0;
  virtual void update_fields() = 0;
  virtual const std::vector<Field>& fields() const = 0;
  virtual mfem::ParMesh& mesh() = 0;
  virtual long unknowns() const = 0;

  /// Walks the accepted state: all that the steps to come, the quantities and the fields depend on. Reading it into a
  /// model of the same scene makes that model go on where the other was. Collective.
  virtual void walk_state(StateWalk& walk) = 0;
  /// Forgets what earlier steps left to save time (factorisations, say): what comes next depends on the state alone.
  virtual void forget() {}
};

}  // namespace titin
