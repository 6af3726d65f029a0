#include "scene/followed.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>

#include "base/words.hpp"

namespace titin {

std::optional<std::size_t> place_of(const std::string& name, const std::vector<Quantity>& followed) {
  const auto found = std::find_if(followed.begin(), followed.end(), [&](const Quantity& q) { return q.name == name; });
  if (found == followed.end()) return std::nullopt;
  return found - followed.begin();
}

std::string meant_instead(const std::string& name, const std::vector<Quantity>& followed) {
  std::vector<std::string> names;
  for (const Quantity& q : followed) names.push_back(q.name);
  const std::string meant = nearest(name, names);
  return meant.empty() ? fmt::format("it follows: {}", fmt::join(names, ", "))
                       : fmt::format("did you mean {}?", in_quotes(meant));
}

}  // namespace titin
