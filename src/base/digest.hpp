/// A 64-bit digest of numbers and text in their order, to tell whether two are the same: FNV-1a over words (Fowler,
/// Noll, Vo 1991), each mixed by the finaliser of SplitMix64 (Steele, Lea, Flood 2014). No protection against those
/// who seek a collision.
#pragma once

#include <bit>
#include <cstdint>
#include <cstring>
#include <string_view>

namespace titin {

class Digest {
 public:
  void add(std::uint64_t word) { state_ = (state_ ^ mixed(word)) * 0x100000001b3u; }
  void add(int word) { add(static_cast<std::uint64_t>(word)); }
  void add(double x) { add(std::bit_cast<std::uint64_t>(x)); }
  void add(std::string_view text) {
    for (; text.size() >= 8; text.remove_prefix(8)) {
      std::uint64_t word;
      std::memcpy(&word, text.data(), 8);
      add(word);
    }
    for (const char c : text) add(static_cast<std::uint64_t>(static_cast<unsigned char>(c)));
    add(static_cast<std::uint64_t>(text.size()));
  }
  std::uint64_t value() const { return mixed(state_); }

  static std::uint64_t mixed(std::uint64_t z) {
    z = (z ^ (z >> 30)) * 0xbf58476d1ce4e5b9u;
    z = (z ^ (z >> 27)) * 0x94d049bb133111ebu;
    return z ^ (z >> 31);
  }

 private:
  std::uint64_t state_ = 0xcbf29ce484222325u;
};

}  // namespace titin
