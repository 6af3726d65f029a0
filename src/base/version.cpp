#include "base/version.hpp"

namespace titin {

const char* version() { return TITIN_VERSION; }
const char* commit() { return TITIN_COMMIT; }

}  // namespace titin
