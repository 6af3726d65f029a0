/// What the program knows, printed: `titin keys` and `titin materials`; and of a run, `titin inspect`.
#pragma once

#include <string>

namespace titin {

/// Keys whose path begins with `prefix`, as an aligned table or as JSON. Throws InputError when there are none.
void print_keys(const std::string& prefix, bool json);
/// All laws in one line each, or everything about one; or either as JSON. Throws InputError for an unknown name.
void print_materials(const std::string& name, bool json);
/// What is in the folder of a run. Throws InputError when no run has written it.
void print_run(const std::string& folder);

}  // namespace titin
