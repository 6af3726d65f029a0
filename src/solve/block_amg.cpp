#include "solve/block_amg.hpp"

#include <utility>

#include "solve/petsc_options.hpp"

namespace titin {

void set_boomeramg(PC pc, const std::string& prefix) {
  check(PCSetType(pc, PCHYPRE));
  check(PCHYPRESetType(pc, "boomeramg"));
  // few entries in coarse rows of three-dimensional problems (De Sterck, Falgout, Nolting, Yang 2008)
  for (const auto& [name, value] : {std::pair{"coarsen_type", "HMIS"},
                                    {"interp_type", "ext+i"},
                                    {"P_max", "4"},
                                    {"agg_nl", "1"},
                                    {"relax_type_down", "SOR/Jacobi"},
                                    {"relax_type_up", "backward-SOR/Jacobi"},
                                    {"strong_threshold", "0.5"},
                                    {"relax_type_all", "symmetric-SOR/Jacobi"}})
    set_default_option(prefix + "pc_hypre_boomeramg_" + name, value);
}

}  // namespace titin
