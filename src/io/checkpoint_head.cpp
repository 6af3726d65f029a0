#include "io/checkpoint_head.hpp"

#include <fmt/format.h>

#include <charconv>
#include <nlohmann/json.hpp>
#include <stdexcept>
#include <utility>

#include "base/digest.hpp"
#include "base/version.hpp"
#include "base/words.hpp"

namespace titin {
namespace {

using Json = nlohmann::json;

constexpr std::string_view magic = "TITIN CHECKPOINT ";
constexpr std::uint64_t largest_head = 64u << 20;  // bytes: scenes are smaller

std::uint64_t digest_of(std::string_view json, std::uint64_t file_size) {
  Digest digest;
  digest.add(json);
  digest.add(file_size);
  return digest.value();
}

struct FirstLine {
  std::uint64_t schema = 0, json = 0, file = 0, digest = 0;
  bool good = false;
};

FirstLine parse_first_line(std::string_view start) {
  FirstLine line;
  if (start.size() < first_line || !start.starts_with(magic) || start[first_line - 1] != '\n') return line;
  const auto words = split(start.substr(magic.size(), first_line - magic.size() - 1), ' ');
  if (words.size() != 4) return line;
  const auto read = [](std::string_view word, std::uint64_t& value, int base) {
    const auto [end, error] = std::from_chars(word.data(), word.data() + word.size(), value, base);
    return error == std::errc() && end == word.data() + word.size();
  };
  line.good = read(words[0], line.schema, 10) && read(words[1], line.json, 10) && read(words[2], line.file, 10) &&
              read(words[3], line.digest, 16) && line.json <= largest_head;
  return line;
}

std::string json_of(const CheckpointHead& head) {
  Json json = {{"version", head.version}, {"commit", head.commit},     {"model", head.model},
               {"ranks", head.ranks},     {"step", head.step},         {"time", head.time},
               {"mesh", head.mesh},       {"settings", head.settings}, {"scene_file", head.scene_file},
               {"scene", head.scene}};
  if (!head.choice.empty()) json["choice"] = head.choice;
  return json.dump(1, ' ', false, Json::error_handler_t::replace) + "\n";
}

/// The library would cast 1e300 to an integer, which C++ does not define.
template <class Number>
void read_whole(const Json& json, const char* key, Number& number) {
  const Json& value = json.at(key);
  const bool fits = value.is_number_unsigned()
                        ? std::in_range<Number>(value.get<std::uint64_t>())
                        : value.is_number_integer() && std::in_range<Number>(value.get<std::int64_t>());
  if (!fits) throw std::out_of_range(key);
  value.get_to(number);
}

CheckpointHead from_json(const Json& json) {
  CheckpointHead head;
  json.at("version").get_to(head.version);
  json.at("commit").get_to(head.commit);
  json.at("model").get_to(head.model);
  read_whole(json, "ranks", head.ranks);
  read_whole(json, "step", head.step);
  json.at("time").get_to(head.time);
  read_whole(json, "mesh", head.mesh);
  json.at("settings").get_to(head.settings);
  json.at("scene_file").get_to(head.scene_file);
  json.at("scene").get_to(head.scene);
  if (json.contains("choice")) json.at("choice").get_to(head.choice);
  return head;
}

}  // namespace

std::string to_bytes(const CheckpointHead& head, std::uint64_t file_size) { return to_bytes(json_of(head), file_size); }

std::string to_bytes(std::string_view json, std::uint64_t file_size) {
  return fmt::format("{}{:04} {:012} {:020} {:016x}\n{}", magic, CheckpointHead::schema, json.size(), file_size,
                     digest_of(json, file_size), json);
}

std::uint64_t size_of(const CheckpointHead& head) { return first_line + json_of(head).size(); }

std::uint64_t wanted_bytes(std::string_view start) {
  const FirstLine line = parse_first_line(start);
  return line.good ? first_line + line.json : 0;
}

ParsedHead parse_head(std::string_view start, std::uint64_t file_size) {
  const FirstLine line = parse_first_line(start);
  ParsedHead parsed;
  if (!line.good)
    parsed.problem = "is no checkpoint of Titin, or was not written to its end";
  else if (line.schema > CheckpointHead::schema)
    parsed.problem = fmt::format("was written by a newer Titin (schema {}; this one, {}, reads up to {})", line.schema,
                                 version(), CheckpointHead::schema);
  else if (start.size() < first_line + line.json || file_size < line.file)
    parsed.problem = fmt::format("is cut off: {} of {} bytes are there", file_size, line.file);
  else if (file_size != line.file || digest_of(start.substr(first_line, line.json), line.file) != line.digest)
    parsed.problem = "was changed after it was written";
  if (!parsed.problem.empty()) return parsed;
  try {
    parsed.head = from_json(Json::parse(start.substr(first_line, line.json)));
  } catch (const std::exception&) {
    parsed.problem = "has a head that this Titin does not understand";
  }
  return parsed;
}

}  // namespace titin
