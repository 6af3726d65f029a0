/// Scene files: TOML with units into typed structs, every key with its unit, default, range and sentence.
///
/// A struct says its keys once, in `bind`; reading a scene, printing `titin keys` and writing resolved.toml all walk
/// that same function:
///
///     struct TimeConfig {
///       double end = 0, step = 0;
///       void bind(Section& s) {
///         s.read("end", end, {.unit = "s", .range = positive, .required = true, .doc = "end of the simulated time"});
///         s.read("step", step, {.unit = "s", .range = positive, .required = true, .doc = "time step"});
///       }
///     };
///
/// The value a member has before `bind` is its default. All numbers are SI inside (base/units.hpp).
/// Errors are collected, with file, line and next action, and reported all together.
#pragma once

#include <array>
#include <functional>
#include <limits>
#include <memory>
#include <stdexcept>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "base/table.hpp"

namespace titin {

/// Closed interval of allowed values, or open where said.
struct Range {
  double min = -std::numeric_limits<double>::infinity(), max = std::numeric_limits<double>::infinity();
  bool open_min = false, open_max = false;
  bool contains(double x) const;
  std::string text() const;  ///< e.g. "> 0", "0 to 1", "" when anything finite goes
};
inline constexpr Range any{};
inline constexpr Range positive{.min = 0, .open_min = true};
inline constexpr Range non_negative{.min = 0};
inline constexpr Range fraction{.min = 0, .max = 1};

/// What a key is, besides its name and default.
struct Key {
  std::string_view unit = "";  ///< SI unit such as "Pa", "kg/m^3"; "" for a pure number
  Range range = any;
  bool required = false;
  std::string_view doc = "";
  int size = -1;  ///< lists: how many values, -1 for any number of them
};

/// One line of `titin keys`: what a scene may say.
struct KeyRecord {
  std::string path, type, unit, default_value, range, doc;
  bool required = false;
  std::vector<std::string> choices;
};

/// All that is wrong with an input: one message each, "file:line:column: what is wrong; what to do".
class InputError : public std::runtime_error {
 public:
  explicit InputError(std::vector<std::string> messages);
  const std::vector<std::string>& messages() const { return messages_; }

 private:
  std::vector<std::string> messages_;
};

class Config;
class Section;
struct SceneText;

/// Takes the numbers of a table that are tables themselves: curves in time, fields in space.
class VaryingNumbers {
 public:
  virtual ~VaryingNumbers() = default;
  /// Sets `value` to what it is at first, and keeps how it varies; reports what is wrong to the section.
  virtual void read(Section& section, std::string_view name, double& value, const Key& key) = 0;
};

/// A (sub)table of a scene while it is being walked. Cheap to copy.
class Section {
 public:
  // Each sets `value` from the key `name`, or leaves it and records nothing when the key is absent.
  void read(std::string_view name, double& value, Key key);               ///< "30 mm"; a bare number only if unit is ""
  void read(std::string_view name, std::vector<double>& value, Key key);  ///< "0, 10, 30 mm", or [0, 1] if unit is ""
  void read(std::string_view name, std::array<double, 3>& value, Key key);
  void read(std::string_view name, int& value, Key key);
  void read(std::string_view name, std::vector<int>& value, Key key);
  void read(std::string_view name, bool& value, Key key);
  void read(std::string_view name, std::string& value, Key key);
  void read(std::string_view name, std::vector<std::string>& value, Key key);  ///< a list, or one string
  /// Text, a number, true or false: as text, for whom it is handed on to.
  void read_plain(std::string_view name, std::string& value, Key key);
  /// A constant ("3 mm") or {time = "0, 0.1 s", value = "0, 3 mm"} or {file = "strain.csv"} (two columns: time in s,
  /// value in the key's SI unit, or headed by other units; of more columns the one that `column` names), the latter two
  /// with an optional `scale` quantity that multiplies pure-number values.
  void read(std::string_view name, Table& value, Key key);

  /// One of a few words, each with its enumerator.
  template <class Enum>
  void choose(std::string_view name, Enum& value, std::initializer_list<std::pair<const char*, Enum>> choices,
              Key key) {
    std::vector<std::string> words;
    int index = -1;
    for (const auto& [word, e] : choices) {
      if (e == value) index = static_cast<int>(words.size());
      words.emplace_back(word);
    }
    choose_word(name, index, words, key);
    if (index >= 0) value = (choices.begin() + index)->second;
  }
  /// The same with words only known at run time (names of laws, say).
  void choose_word(std::string_view name, int& index, const std::vector<std::string>& words, Key key);

  /// Sub-table; present or not, the keys in it are walked. `doc` heads it in `titin keys`.
  Section section(std::string_view name, std::string_view doc = "");
  /// Sub-tables whose names the user gives ([boundary.NAME]); `walk(name, section)` for each, in file order. When the
  /// keys are described, once with the name "<NAME>".
  void each(std::string_view name, std::string_view doc, const std::function<void(const std::string&, Section)>& walk);

  /// The same table, whose plain numbers may vary: those that do go to `varying`, which must outlive the section.
  Section accepting(VaryingNumbers& varying) const;

  /// Names of the keys in this table that the scene gives, in file order: for tables whose keys the user names.
  std::vector<std::string> names() const;
  /// A table that others read (the test runner, say): known here, its keys not judged.
  void leave(std::string_view name);

  bool has(std::string_view name) const;       ///< does the scene say it?
  bool is_table(std::string_view name) const;  ///< does it say it, and as a table?
  bool describing() const;                     ///< true when keys are being listed and no scene is there
  /// Reports something wrong with this key (or with this table for name ""), at its line; `advice` is the next action.
  void error(std::string_view name, const std::string& message, const std::string& advice = "");
  /// A file named in a scene, relative to the scene's own folder; reports one that is not there. "" when it is not.
  std::string existing_file(std::string_view name, const std::string& file);
  const std::string& path() const { return path_; }  ///< "materials.muscle"

 private:
  friend class Config;
  Section(std::shared_ptr<SceneText> scene, std::string path) : scene_(std::move(scene)), path_(std::move(path)) {}
  std::shared_ptr<SceneText> scene_;
  std::string path_;
  VaryingNumbers* varying_ = nullptr;
};

/// A scene's text with its overrides. Every rank holds the same text and walks it alike; files that it names are read
/// collectively (base/text_file.hpp).
class Config {
 public:
  /// Reads the scene file itself. Collective.
  static Config read_file(const std::string& file, const std::vector<std::string>& overrides = {});
  /// Parses `text` of the file called `file` and applies "key=value" `overrides`, whose right side is what the file
  /// would say; a bare word or quantity may drop its quotation marks. Throws InputError when it is no TOML.
  Config(const std::string& text, const std::string& file, const std::vector<std::string>& overrides = {});
  static Config describing();  ///< no scene: lists keys

  Section root();
  /// Call after everything was read: keys that nobody asked for become errors with "did you mean", and if there is any
  /// error at all, throws InputError with all of them.
  void finish();
  const std::vector<KeyRecord>& keys() const;
  /// The scene as it was understood, in SI units, defaults included: a scene file that runs the same.
  std::string resolved() const;
  /// The same as "path = value", in order; for a file a digest of what it holds. Two scenes with the same settings say
  /// the same. Collective.
  std::vector<std::string> settings() const;

 private:
  Config();
  std::shared_ptr<SceneText> scene_;
};

}  // namespace titin
