/// What a whole material should make its user think of, beyond what each law says (registry.hpp, Advice).
#pragma once

#include "materials/material.hpp"

namespace titin {

/// Prints warnings about the material that the section describes.
void advise(const Section& section, const Material& material);

}  // namespace titin
