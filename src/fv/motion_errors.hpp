/// How far a solid is from an exact motion: norms over the body at rest.
#pragma once

#include "fv/scheme.hpp"
#include "mesh/exact_motion.hpp"
#include "solve/model.hpp"

namespace titin {

/// Of displacement and velocity of the centres of cells, of the pressure, and of the components along the solution's
/// direction of B - I, of the stress and of its deviator: integral of the size (L1), root of the integral of the square
/// (L2), largest (Linf). Collective.
template <int D>
std::vector<Quantity> motion_errors(const FlowScheme<D>& scheme, const ExactMotion& exact, double time);

extern template std::vector<Quantity> motion_errors<2>(const FlowScheme<2>&, const ExactMotion&, double);
extern template std::vector<Quantity> motion_errors<3>(const FlowScheme<3>&, const ExactMotion&, double);

}  // namespace titin
