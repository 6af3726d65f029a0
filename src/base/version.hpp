/// What this build is: written to run.json and printed by `titin --version`.
#pragma once

namespace titin {

const char* version();
const char* commit();

}  // namespace titin
