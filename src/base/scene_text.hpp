/// Behind Config and Section: the parsed text, what has been asked of it, and what is wrong with it. Private to base.
#pragma once

#include <toml++/toml.h>
#include <map>
#include <set>
#include <string>
#include <string_view>
#include <vector>

#include "base/config.hpp"

namespace titin {

/// `table`.`name` as TOML writes it: names that are no bare keys are quoted.
std::string join_path(const std::string& table, std::string_view name);

/// Where something stands: in the file, or on the command line.
struct Place {
  bool command_line = false;
  unsigned line = 0, column = 0;  // 0: the file as a whole
};

struct Complaint {
  enum class Of { key, table, missing_key };
  Place place;
  std::string path, text;
  Of what = Of::key;
};

/// A line of resolved.toml.
struct ResolvedKey {
  std::string table, name, value;
  bool given = false, names_file = false;
};

struct SceneText {
  toml::table root;
  bool describing = false;
  std::string file;
  std::set<std::string> overridden;                       // paths that the command line set
  std::map<std::string, const toml::table*> tables;       // walked tables that the scene has
  std::vector<std::string> walked;                        // walked tables, there or not, in order
  std::map<std::string, std::vector<std::string>> known;  // by table: the names asked for, in order
  std::set<std::string> undecided;   // tables with an unknown choice: their other keys are not judged
  std::set<std::string> not_tables;  // what should be a table and is not: its keys are not missed
  std::set<std::string> absent;      // has() said no: a default must not be written out
  std::vector<KeyRecord> records;
  std::vector<ResolvedKey> resolved;
  std::vector<Complaint> complaints;

  /// Throws InputError when text or overrides are no TOML.
  void parse(const std::string& text, const std::vector<std::string>& overrides);

  const toml::node* find(const std::string& table, std::string_view name) const;
  bool from_command_line(const std::string& path) const;
  Place place(const std::string& table, std::string_view name) const;
  /// "place: path: problem; advice" at the key, or at the table for the name "".
  void complain(const std::string& table, std::string_view name, const std::string& problem, const std::string& advice);
  void complain_missing(const std::string& table, std::string_view name, const std::string& text);
  void walk(const std::string& table, const toml::table* node);
  void ask(const std::string& table, std::string_view name);
  void record(KeyRecord record);
  void keep(ResolvedKey key);
  void forget(const std::string& table);        ///< a table that is the value of one key is no table of resolved.toml
  void find_unknown(const std::string& table);  ///< in this table and the walked ones below
  std::vector<std::string> messages() const;    ///< in order of place, each once

 private:
  void unknown(const std::string& table, const toml::key& key);
};

}  // namespace titin
