/// What a checkpoint says of itself in front of its HDF5 part: readable without HDF5, and written last, so that a file
/// with a head is whole.
///
///   TITIN CHECKPOINT <schema> <bytes of the JSON below> <bytes of the file> <digest of both and the JSON>\n
///   { "version": ..., "model": ..., "ranks": ..., "step": ..., "time": ..., "mesh": ..., "settings": [...], "scene":
///   ... }
#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

namespace titin {

struct CheckpointHead {
  static constexpr int schema = 1;     ///< of the files that this program writes
  std::string version, commit, model;  ///< of the program; of the scene
  int ranks = 1;                       ///< that wrote it
  long step = 0;                       ///< accepted so far
  double time = 0;                     ///< [s]
  std::uint64_t mesh = 0;              ///< its identity
  std::vector<std::string> settings;   ///< Config::settings
  std::string scene_file, scene;       ///< as the run was called with; Config::resolved
  std::vector<std::string> choice;     ///< overrides that a scene with fidelity = "auto" was given; else none
};

/// The head as bytes, for a file of `file_size` bytes.
std::string to_bytes(const CheckpointHead& head, std::uint64_t file_size);
std::string to_bytes(std::string_view json, std::uint64_t file_size);
/// Bytes that `to_bytes` takes at most, whatever the size of the file.
std::uint64_t size_of(const CheckpointHead& head);

struct ParsedHead {
  CheckpointHead head;
  std::string problem;  ///< "" or why this is no checkpoint to restart from: "is ...", "was ..."
};
/// `start`: the first bytes of a file of `file_size` bytes, `wanted_bytes(start)` of them if it has as many.
ParsedHead parse_head(std::string_view start, std::uint64_t file_size);
/// How many bytes of the file parse_head needs, judged by the first `first_line` of them; 0: they are no checkpoint's.
std::uint64_t wanted_bytes(std::string_view start);
inline constexpr std::uint64_t first_line = 73;

}  // namespace titin
