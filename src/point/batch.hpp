/// Energy, stress and tangent of a list of points, each with its own material: JSON in, JSON out.
/// The keys of an entry are told in docs/howto/material_point.md.
#pragma once

#include <string>

namespace titin {

/// The answer to the list in `text`, which came from `file`. Throws InputError with all that is wrong, entry by entry.
std::string run_batch(const std::string& text, const std::string& file);

}  // namespace titin
