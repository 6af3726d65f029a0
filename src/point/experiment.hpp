/// An experiment on one material point: from rest through the steps of a loading, one row of numbers for each.
#pragma once

#include <string>
#include <vector>

#include "materials/material.hpp"
#include "point/loading.hpp"

namespace titin {

/// Rows of numbers under heads such as "P_xx [Pa]". `problem` says why the last rows are missing, "" if none are.
struct CurveTable {
  std::vector<std::string> columns;
  std::vector<std::vector<double>> rows;
  std::string problem;

  std::string csv() const;  ///< numbers are written so that they read back exactly
};

/// Runs it; triaxial shear has its six planes one below the other, numbered in a first column "plane".
CurveTable run_experiment(const Material& material, const LoadingConfig& loading);

}  // namespace titin
