#include "solve/block_amg.hpp"

#include <utility>

namespace titin {

void set_boomeramg(PC pc, const std::string& prefix) {
  check(PCSetType(pc, PCHYPRE));
  check(PCHYPRESetType(pc, "boomeramg"));
  // few entries in coarse rows of three-dimensional problems (De Sterck, Falgout, Nolting, Yang 2008)
  for (const auto& [name, value] : {std::pair{"coarsen_type", "HMIS"},
                                    {"interp_type", "ext+i"},
                                    {"P_max", "4"},
                                    {"strong_threshold", "0.5"},
                                    {"relax_type_all", "symmetric-SOR/Jacobi"}}) {
    const std::string option = "-" + prefix + "pc_hypre_boomeramg_" + name;
    PetscBool given;
    check(PetscOptionsHasName(nullptr, nullptr, option.c_str(), &given));
    if (!given) check(PetscOptionsSetValue(nullptr, option.c_str(), value));
  }
}

}  // namespace titin
