#include "solve/linear_choice.hpp"

#include <cmath>

#include "base/config.hpp"
#include "base/log.hpp"
#include "base/memory.hpp"

namespace titin {
namespace {

/// Where factors cost more than the block solver although they are used again; in the plane they fill in less.
constexpr double largest_direct = 40000, largest_direct_plane = 250000;
/// Of the memory that is left: the rest is for what a run makes besides, and for what the estimate is off by.
constexpr double largest_part = 0.5;

std::string gigabytes(double bytes) { return fmt::format("{:.2g} GB", bytes / 1e9); }

}  // namespace

double memory_of_factors(double unknowns, int components) {
  return components == 2 ? 31 * unknowns * std::log2(unknowns) : 1200 * std::pow(unknowns, 1.2);
}

LinearChoice automatic_choice(double unknowns, int components, bool can_block, double memory_left) {
  const double needed = memory_of_factors(unknowns, components);
  const double largest = components == 2 ? largest_direct_plane : largest_direct;
  LinearChoice choice;
  choice.fits = needed <= largest_part * memory_left;
  choice.why = "factors need about " + gigabytes(needed);
  if (std::isfinite(memory_left)) choice.why += fmt::format(" of {} that are free", gigabytes(memory_left));
  if (!can_block) {
    choice.why += "; no block solver for these elements or this scheme";
  } else if (!choice.fits) {
    choice.method = LinearMethod::block;
  } else if (unknowns > largest) {
    choice.method = LinearMethod::block;
    choice.why = fmt::format("more than {}", largest);
  }
  return choice;
}

LinearMethod chosen_method(LinearMethod asked, Mat K, bool can_block) {
  if (!can_block && (asked == LinearMethod::block || asked == LinearMethod::condensed))
    throw InputError(
        {"solver.linear: this needs cells of one kind with pressure and dilatation, and a scheme other than "
         "energy_momentum; take \"direct\""});
  if (asked != LinearMethod::automatic) return asked;
  PetscInt size, components;
  check(MatGetSize(K, &size, nullptr));
  check(MatGetBlockSize(K, &components));
  const LinearChoice choice = automatic_choice(size, static_cast<int>(components), can_block, available_memory());
  logging::info("linear solver: {} for {} unknowns ({})", choice.method == LinearMethod::direct ? "direct" : "block",
                size, choice.why);
  if (!choice.fits && !can_block)
    logging::warning(
        "factors of the tangent may not fit into the memory that is free: take cells of one kind with "
        "pressure and dilatation, for which there is multigrid, fewer cells, or more machines");
  return choice.method;
}

}  // namespace titin
