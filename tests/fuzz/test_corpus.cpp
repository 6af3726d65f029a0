// Hands each file of corpus/ to the target of its folder once: what a fuzzer has found stays found.
//
//   titin_test_fuzz CORPUS
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <string>

#include "base/parallel.hpp"
#include "fuzz/targets.hpp"

namespace {

using Target = void (*)(const std::string&);

struct Corpus {
  const char* folder;
  Target target;
};
const Corpus corpora[] = {
    {"scene", titin::fuzz_scene},     {"table", titin::fuzz_table},           {"mesh", titin::fuzz_gmsh},
#ifdef TITIN_FUZZ_MESH
    {"mesh", titin::fuzz_mesh},
#endif
    {"inspect", titin::fuzz_inspect}, {"checkpoint", titin::fuzz_checkpoint},
};

int replay(const std::filesystem::path& folder, Target target) {
  int files = 0;
  for (const auto& entry : std::filesystem::directory_iterator(folder)) {
    std::ifstream in(entry.path(), std::ios::binary);
    const std::string bytes((std::istreambuf_iterator<char>(in)), {});
    std::fprintf(stderr, "%s\n", entry.path().c_str());  // the last one is to blame
    target(bytes);
    ++files;
  }
  return files;
}

}  // namespace

int main(int argc, char** argv) {
  const titin::MpiSession mpi(argc, argv);
  if (argc != 2) return 2;
  for (const auto& [folder, target] : corpora) {
    const int files = replay(std::filesystem::path(argv[1]) / folder, target);
    std::printf("%s: %d files\n", folder, files);
    if (files == 0) return 1;
  }
  return 0;
}
