#include "point/script.hpp"

#include <fmt/format.h>
#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cstdlib>
#include <filesystem>

#include "base/config.hpp"

namespace titin {

int run_script(const std::string& name, const std::vector<std::string>& arguments) {
  const char* given = std::getenv("TITIN_SCRIPTS");
  const std::string path = (std::filesystem::path(given ? given : TITIN_SCRIPTS) / name).string();
  if (access(path.c_str(), X_OK) != 0)
    throw InputError({fmt::format("{} is not there; set TITIN_SCRIPTS to the folder scripts/ of Titin", path)});
  std::vector<char*> argv{const_cast<char*>(path.c_str())};
  for (const std::string& argument : arguments) argv.push_back(const_cast<char*>(argument.c_str()));
  argv.push_back(nullptr);
  pid_t child = 0;
  int status = 0;
  if (posix_spawn(&child, path.c_str(), nullptr, nullptr, argv.data(), environ) != 0 || waitpid(child, &status, 0) < 0)
    throw InputError({fmt::format("{} cannot be started", path)});
  return WIFEXITED(status) ? WEXITSTATUS(status) : 4;
}

}  // namespace titin
