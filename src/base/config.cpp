#include "base/config.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>

#include "base/scene_text.hpp"
#include "base/text_file.hpp"
#include "base/words.hpp"

namespace titin {

bool Range::contains(double x) const {
  return (open_min ? x > min : x >= min) && (open_max ? x < max : x <= max) && std::isfinite(x);
}

std::string Range::text() const {
  const bool below = std::isfinite(min), above = std::isfinite(max);
  if (below && above && !open_min && !open_max) return fmt::format("{} to {}", min, max);
  std::vector<std::string> sides;
  if (below) sides.push_back(fmt::format("{} {}", open_min ? ">" : ">=", min));
  if (above) sides.push_back(fmt::format("{} {}", open_max ? "<" : "<=", max));
  return fmt::format("{}", fmt::join(sides, " and "));
}

InputError::InputError(std::vector<std::string> messages)
    : std::runtime_error(fmt::format("{}", fmt::join(messages, "\n"))), messages_(std::move(messages)) {}

Config::Config() : scene_(std::make_shared<SceneText>()) {}

Config::Config(const std::string& text, const std::string& file, const std::vector<std::string>& overrides) : Config() {
  scene_->file = file;
  scene_->parse(text, overrides);
}

Config Config::read_file(const std::string& file, const std::vector<std::string>& overrides) {
  const TextFile scene = read_text_file(file);
  if (!scene.problem.empty())
    throw InputError({fmt::format("{}: the scene file {}; give the path of a TOML scene", file, scene.problem)});
  return Config(scene.text, file, overrides);
}

Config Config::describing() {
  Config config;
  config.scene_->describing = true;
  config.scene_->walk("", nullptr);
  return config;
}

Section Config::root() { return {scene_, ""}; }

void Config::finish() {
  if (scene_->describing) return;
  scene_->find_unknown("");
  if (!scene_->complaints.empty()) throw InputError(scene_->messages());
}

const std::vector<KeyRecord>& Config::keys() const { return scene_->records; }

namespace {

/// Where a formulation asked whether a key is there, writing out its default would change the answer.
bool stays_away(const SceneText& scene, const ResolvedKey& key) {
  const std::string path = join_path(key.table, key.name);
  return !key.given && std::any_of(scene.absent.begin(), scene.absent.end(),
                                   [&](const std::string& asked) { return (path + ".").rfind(asked + ".", 0) == 0; });
}

}  // namespace

std::vector<std::string> Config::settings() const {
  std::vector<std::string> list;
  for (const ResolvedKey& key : scene_->resolved) {
    if (key.value.empty() || stays_away(*scene_, key)) continue;
    const std::string path = join_path(key.table, key.name);
    const std::string value = key.names_file ? file_digest(key.value.substr(1, key.value.size() - 2)) : key.value;
    list.push_back(fmt::format("{} = {}", path, value));
  }
  std::sort(list.begin(), list.end());
  return list;
}

std::string Config::resolved() const {
  const SceneText& scene = *scene_;
  std::string text;
  for (const std::string& table : scene.walked) {
    std::string lines;
    for (const ResolvedKey& key : scene.resolved)
      if (key.table == table && !key.value.empty() && !stays_away(scene, key))
        lines += fmt::format("{} = {}\n", join_path("", key.name), key.value);
    if (lines.empty() && !scene.tables.count(table)) continue;
    if (!table.empty()) text += fmt::format("{}[{}]\n", text.empty() ? "" : "\n", table);
    text += lines;
  }
  return text;
}

}  // namespace titin
