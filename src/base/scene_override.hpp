/// What the command line changes of a scene: `time.step="10 ms"` sets a key, `~time.scheme` takes a key or a table out.
/// Private to base.
#pragma once

#include <toml++/toml.h>
#include <string>
#include <string_view>

namespace titin {

/// Applies it to the scene; the path that it has set, "" when it took something out. Throws InputError with what is
/// wrong with it, and has changed nothing then but for tables that it would have been in.
std::string override_with(toml::table& scene, const std::string& text);

inline constexpr int deepest_key =
    32;  ///< dots in one key: a scene has five; thousands would overflow the parser's stack
/// Line with a key of too many dots, or 0. Strings and comments may hold any number of dots.
int line_of_deep_key(std::string_view text);

}  // namespace titin
