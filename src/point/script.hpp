/// Drawing and fitting are Python's: the programs of scripts/, run from here.
#pragma once

#include <string>
#include <vector>

namespace titin {

/// Runs scripts/NAME with these arguments and waits; its exit code. Throws InputError when it cannot be started.
int run_script(const std::string& name, const std::vector<std::string>& arguments);

}  // namespace titin
