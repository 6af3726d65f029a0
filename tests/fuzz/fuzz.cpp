// Makes a fuzzer of the target TITIN_FUZZ_TARGET. Reading files is collective: MPI is started once, and not ended, so
// that what it keeps can be told from a leak (tests/sanitize/leaks.txt).
#include "base/parallel.hpp"
#include "fuzz/targets.hpp"

extern "C" int LLVMFuzzerInitialize(int* argc, char*** argv) {
  static const auto* const mpi = new titin::MpiSession(*argc, *argv);
  (void)mpi;
  return 0;
}

extern "C" int LLVMFuzzerTestOneInput(const unsigned char* data, std::size_t size) {
  titin::TITIN_FUZZ_TARGET(std::string(reinterpret_cast<const char*>(data), size));
  return 0;
}
