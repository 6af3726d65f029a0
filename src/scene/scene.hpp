/// A scene file becomes objects here: the only place where names in text meet formulations.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "base/config.hpp"
#include "scene/fidelity.hpp"
#include "scene/output.hpp"
#include "scene/reference.hpp"
#include "scene/saving.hpp"
#include "solve/clock.hpp"
#include "solve/model.hpp"
#include "solve/petsc_options.hpp"

namespace titin {

/// Everything a run needs.
struct Scene {
  std::string title;
  FidelityConfig fidelity;  ///< what it asks for: a scene itself is as written
  ClockConfig clock;
  OutputConfig output;
  std::unique_ptr<PetscOptionsInForce> petsc;  ///< outlives the model, whose solvers read them when they are made
  std::unique_ptr<Model> model;
  Reference reference;  ///< what run.json's errors are against; may be none
  SavingConfig saving;
  std::vector<std::string> settings;  ///< Config::settings
  std::uint64_t mesh_identity = 0;
  std::string resolved;  ///< the scene as it was understood: a scene file that runs the same

  /// Collective. Throws InputError with all that is wrong, before anything large is allocated.
  static Scene read(const std::string& file, const std::vector<std::string>& overrides);
  /// The same of text that says it came from `file`.
  static Scene of_text(const std::string& text, const std::string& file, const std::vector<std::string>& overrides);
};

/// All keys that a scene may hold.
std::vector<KeyRecord> scene_keys();

}  // namespace titin
