// A head that is accepted writes itself again. The digest keeps a fuzzer out of the JSON behind it, so that is also
// tried with the digest it should have.
#include <algorithm>
#include <cstdlib>

#include "fuzz/targets.hpp"
#include "io/checkpoint_head.hpp"

namespace titin {
namespace {

constexpr std::uint64_t largest_head = 64u << 20;  // [bytes] with which a damaged number must not be believed

void try_head(const std::string& bytes, std::uint64_t size) {
  const ParsedHead parsed = parse_head(bytes, size);
  if (!parsed.problem.empty()) return;
  const std::string again = to_bytes(parsed.head, size);
  if (!parse_head(again, size).problem.empty()) std::abort();
}

}  // namespace

void fuzz_checkpoint(const std::string& bytes) {
  if (wanted_bytes(bytes) > largest_head + first_line) std::abort();
  try_head(bytes, bytes.size());
  const std::string json = bytes.substr(std::min<std::size_t>(bytes.size(), first_line));
  try_head(to_bytes(json, bytes.size()), bytes.size());
}

}  // namespace titin
