#include "solve/petsc_options.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cctype>

namespace titin {

namespace {

/// Names; PETSc's own list is global too, and takes a question whether it holds an option for a use of it.
std::vector<std::string> in_force;

bool is_option_name(const std::string& name) {
  const auto fits = [](unsigned char c) { return std::islower(c) || std::isdigit(c) || c == '_'; };
  return std::all_of(name.begin(), name.end(), fits) && !name.empty() &&
         std::isalpha(static_cast<unsigned char>(name[0]));
}

}  // namespace

void PetscOptionsConfig::bind(Section& s) {
  for (const std::string& name : s.names()) {
    std::string value;
    s.read_plain(name, value,
                 {.doc = "an option of PETSc or hypre, with the prefix of the solver it is for and without the leading "
                         "\"-\""});
    if (!s.describing() && !is_option_name(name))
      s.error(name, "not the name of an option of PETSc",
              "leave out the leading \"-\" and write it as PETSc does, such as petsc.ksp_rtol");
    values.emplace_back(name, value);
  }
}

PetscOptionsInForce::PetscOptionsInForce(PetscOptionsConfig config) : config_(std::move(config)) {
  for (const auto& [name, value] : config_.values) {
    check(PetscOptionsSetValue(nullptr, ("-" + name).c_str(), value.c_str()));
    in_force.push_back(name);
  }
}

PetscOptionsInForce::~PetscOptionsInForce() {
  for (const auto& [name, value] : config_.values) {
    PetscOptionsClearValue(nullptr, ("-" + name).c_str());
    std::erase(in_force, name);
  }
}

std::vector<std::string> PetscOptionsInForce::unused() const {
  std::vector<std::string> names;
  for (const auto& [name, value] : config_.values) {
    PetscBool used;
    check(PetscOptionsUsed(nullptr, name.c_str(), &used));
    if (!used) names.push_back("petsc." + name);
  }
  std::sort(names.begin(), names.end());
  return names;
}

void set_default_option(const std::string& name, const char* value) {
  if (std::find(in_force.begin(), in_force.end(), name) == in_force.end())
    check(PetscOptionsSetValue(nullptr, ("-" + name).c_str(), value));
}

void check_options(PetscErrorCode code) {
  if (code == 0 || in_force.empty()) return check(code);
  const char* text = nullptr;
  PetscErrorMessage(code, &text, nullptr);
  const std::string reason = text ? text : "no reason given";
  throw InputError({fmt::format("petsc: PETSc refuses an option ({}); look at {}", reason.substr(0, reason.find('.')),
                                "petsc." + fmt::format("{}", fmt::join(in_force, ", petsc.")))});
}

}  // namespace titin
