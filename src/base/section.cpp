// Section: how keys are read. Each read asks for its key (so that it is known), checks it and keeps what was
// understood.
#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <filesystem>

#include "base/asked_key.hpp"
#include "base/text_file.hpp"
#include "base/units.hpp"
#include "base/words.hpp"

namespace titin {

void Section::read(std::string_view name, double& value, Key key) {
  const AskedKey asked = ask(*scene_, path_, name, key, "number", units::text(value, key.unit));
  if (asked.node && asked.node->is_table() && varying_) return varying_->read(*this, name, value, key);
  if (asked.node)
    if (const Numbers x = numbers(asked, 1)) value = x->front();
  asked.keep_numbers({value}, false);
}

void Section::read(std::string_view name, std::vector<double>& value, Key key) {
  const std::string type = key.size < 0 ? "numbers" : fmt::format("{} numbers", key.size);
  const AskedKey asked = ask(*scene_, path_, name, key, type, units::text(value, value.empty() ? "" : key.unit));
  if (asked.node)
    if (Numbers x = numbers(asked, key.size)) value = std::move(*x);
  asked.keep_numbers(value, true);
}

void Section::read(std::string_view name, std::array<double, 3>& value, Key key) {
  std::vector<double> list(value.begin(), value.end());
  key.size = 3;
  read(name, list, key);
  std::copy_n(list.begin(), 3, value.begin());
}

void Section::read(std::string_view name, int& value, Key key) {
  const AskedKey asked = ask(*scene_, path_, name, key, "whole number", fmt::format("{}", value));
  if (asked.node)
    if (const auto x = whole_numbers(asked, 1); !x.empty()) value = x.front();
  asked.keep_numbers({static_cast<double>(value)}, false);
}

void Section::read(std::string_view name, std::vector<int>& value, Key key) {
  const std::string type = key.size < 0 ? "whole numbers" : fmt::format("{} whole numbers", key.size);
  const AskedKey asked = ask(*scene_, path_, name, key, type, fmt::format("{}", fmt::join(value, ", ")));
  if (asked.node)
    if (auto x = whole_numbers(asked, key.size); !x.empty()) value = std::move(x);
  asked.keep_numbers({value.begin(), value.end()}, true);
}

void Section::read(std::string_view name, bool& value, Key key) {
  const AskedKey asked = ask(*scene_, path_, name, key, "true or false", value ? "true" : "false");
  if (asked.node && asked.node->is_boolean())
    value = asked.node->as_boolean()->get();
  else if (asked.node)
    asked.complain(fmt::format("{} is neither true nor false", shown(*asked.node)), "write true or false");
  asked.keep(value ? "true" : "false");
}

void Section::read(std::string_view name, std::string& value, Key key) {
  const AskedKey asked = ask(*scene_, path_, name, key, "text", value);
  if (asked.node && asked.node->is_string())
    value = asked.node->as_string()->get();
  else if (asked.node)
    asked.complain(fmt::format("{} is no text", shown(*asked.node)), "put it in quotation marks");
  asked.keep(asked.node || !value.empty() ? toml_string(value) : "");
}

void Section::read(std::string_view name, std::vector<std::string>& value, Key key) {
  const AskedKey asked = ask(*scene_, path_, name, key, "list of text", fmt::format("{}", fmt::join(value, ", ")));
  if (asked.node) {
    std::vector<std::string> words;
    const auto* list = asked.node->as_array();
    if (const auto* one = asked.node->as_string()) words.push_back(one->get());
    if (list)
      for (const toml::node& entry : *list)
        if (const auto* word = entry.as_string()) words.push_back(word->get());
    if (words.size() != (list ? list->size() : 1))
      asked.complain("is no list of text", "write for example [\"a\", \"b\"]");
    else if (key.size >= 0 && static_cast<int>(words.size()) != key.size)
      asked.complain(fmt::format("has {} entries", words.size()), fmt::format("give {}", key.size));
    else
      value = std::move(words);
  }
  std::vector<std::string> written;
  for (const std::string& word : value) written.push_back(toml_string(word));
  asked.keep(asked.node || !value.empty() ? fmt::format("[{}]", fmt::join(written, ", ")) : "");
}

void Section::read_plain(std::string_view name, std::string& value, Key key) {
  const AskedKey asked = ask(*scene_, path_, name, key, "text or number", value);
  if (asked.node && asked.node->is_string())
    value = asked.node->as_string()->get();
  else if (asked.node && (asked.node->is_number() || asked.node->is_boolean()))
    value = shown(*asked.node);
  else if (asked.node)
    asked.complain(fmt::format("{} is neither text nor a number", shown(*asked.node)), "put it in quotation marks");
  asked.keep(asked.node || !value.empty() ? toml_string(value) : "");
}

void Section::choose_word(std::string_view name, int& index, const std::vector<std::string>& words, Key key) {
  const AskedKey asked = ask(*scene_, path_, name, key, "word", index < 0 ? "" : words[index], words);
  if (asked.node) {
    const std::string word = asked.node->value<std::string>().value_or("");
    const auto it = std::find(words.begin(), words.end(), word);
    if (it != words.end()) {
      index = static_cast<int>(it - words.begin());
    } else {
      const std::string meant = nearest(word, words);
      asked.complain(fmt::format("{} is not known here", shown(*asked.node)),
                     fmt::format("{}{}allowed: {}", meant.empty() ? "" : fmt::format("did you mean \"{}\"?", meant),
                                 meant.empty() ? "" : " ", fmt::join(words, ", ")));
      scene_->undecided.insert(path_);
    }
  }
  asked.keep(index < 0 ? "" : toml_string(words[index]));
}

Section Section::accepting(VaryingNumbers& varying) const {
  Section same = *this;
  same.varying_ = &varying;
  return same;
}

Section Section::section(std::string_view name, std::string_view doc) {
  scene_->ask(path_, name);
  const std::string path = join_path(path_, name);
  const toml::node* node = scene_->find(path_, name);
  scene_->walk(path, node ? node->as_table() : nullptr);
  if (!doc.empty()) scene_->record({path, "table", "", "", "", std::string(doc), false, {}});
  if (node && !node->is_table() && scene_->not_tables.insert(path).second)
    error(name, fmt::format("{} is no table", shown(*node)), fmt::format("write [{}] and its keys below", path));
  return {scene_, path};
}

void Section::each(std::string_view name, std::string_view doc,
                   const std::function<void(const std::string&, Section)>& walk) {
  Section all = section(name, doc);
  for (const std::string& given : all.names()) walk(given, all.section(given));
}

std::vector<std::string> Section::names() const {
  if (describing()) return {"<NAME>"};
  const auto it = scene_->tables.find(path_);
  if (it == scene_->tables.end()) return {};
  std::vector<std::pair<unsigned, std::string>> by_line;  // those of the command line (line 0) last
  for (const auto& [key, node] : *it->second) {
    const unsigned line = node.source().begin.line - 1;  // wraps around for 0
    by_line.emplace_back(line, std::string(key.str()));
  }
  std::stable_sort(by_line.begin(), by_line.end(), [](const auto& a, const auto& b) { return a.first < b.first; });
  std::vector<std::string> names;
  for (const auto& [line, name] : by_line) names.push_back(name);
  return names;
}

void Section::leave(std::string_view name) { scene_->ask(path_, name); }

bool Section::has(std::string_view name) const {
  const bool there = scene_->find(path_, name) != nullptr;
  if (!there) scene_->absent.insert(join_path(path_, name));
  return there;
}

bool Section::is_table(std::string_view name) const {
  const toml::node* node = scene_->find(path_, name);
  return node && node->is_table();
}

bool Section::describing() const { return scene_->describing; }

void Section::error(std::string_view name, const std::string& message, const std::string& advice) {
  scene_->complain(path_, name, message, advice);
}

std::string Section::existing_file(std::string_view name, const std::string& file) {
  namespace fs = std::filesystem;
  if (file.empty() || scene_->describing) return "";
  const bool typed = scene_->from_command_line(join_path(path_, name));
  const fs::path path = (typed ? fs::path() : fs::path(scene_->file).parent_path()) / file;
  const std::string problem = file_problem(path.string());
  if (!problem.empty()) {
    error(name, fmt::format("file {} {}", in_quotes(file), problem),
          fmt::format("give its path from {} (looked for {})", typed ? "where you are" : "the scene's own folder",
                      in_quotes(path.string())));
    return "";
  }
  const std::string absolute = fs::absolute(path).lexically_normal().string();
  scene_->keep({path_, std::string(name), toml_string(absolute), true, true});
  return absolute;
}

}  // namespace titin
