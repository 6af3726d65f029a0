// The first byte says which file of a run's folder the others are; a run.json that is whole is there in any case.
#include <array>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <random>

#include "base/config.hpp"
#include "fuzz/targets.hpp"
#include "io/run_contents.hpp"

namespace titin {
namespace {

namespace fs = std::filesystem;

constexpr std::array names = {"run.json", "history.csv", "fields/fields.pvd", "fields/fields.vtkhdf.series"};

struct Folder {
  fs::path path = fs::temp_directory_path() / ("titin_fuzz_" + std::to_string(std::random_device()()));
  Folder() { fs::create_directories(path / "fields"); }
  ~Folder() { fs::remove_all(path); }
  void write(const char* name, const std::string& text) const {
    if (!(std::ofstream(path / name, std::ios::binary) << text << std::flush)) std::abort();
  }
};

}  // namespace

void fuzz_inspect(const std::string& bytes) {
  static const Folder folder;
  const std::size_t which = bytes.empty() ? 0 : static_cast<unsigned char>(bytes[0]) % names.size();
  folder.write("run.json", R"({"status": "finished"})");
  folder.write(names[which], bytes.substr(bytes.empty() ? 0 : 1));
  try {
    const RunContents contents = read_run_contents(folder.path.string());
    for (const auto& [what, text] : contents.facts)
      for (const char c : what + text)
        if (c == '\x1b') std::abort();  // a terminal would obey it
  } catch (const InputError&) {
    if (which != 0) std::abort();  // all else may be damaged, and is said to be
  }
  if (which != 0) fs::remove(folder.path / names[which]);
}

}  // namespace titin
