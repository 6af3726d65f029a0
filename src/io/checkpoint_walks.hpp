/// The two walks behind io/checkpoint.hpp.
#pragma once

#include <map>
#include <string>
#include <unordered_map>
#include <vector>

#include "io/parallel_hdf5.hpp"
#include "solve/state_walk.hpp"

namespace titin {

class CheckpointWriter : public StateWalk {
 public:
  /// `head`: bytes to keep free in front. Collective, as all that follows. Throws std::runtime_error.
  CheckpointWriter(const std::string& path, std::uint64_t head) : file_(path, ParallelHdf5::Mode::create, head) {}
  bool reading() const override { return false; }
  void common(const std::string& name, std::vector<double>& values) override;
  void parts(const std::string& name, std::vector<double>& values) override;
  void rows(const std::string& name, const StateRows& rows, int width, double* values) override;
  void ragged(const std::string& name, const StateRows& rows, const std::vector<int>& sizes, double* values) override;
  bool close() { return file_.close(); }

 private:
  void write(const std::string& name, const Slab& slab, int width, const double* values);
  void write_numbers(const StateRows& rows);

  ParallelHdf5 file_;
  std::map<std::string, Slab> kinds_;
};

class CheckpointReader : public StateWalk {
 public:
  explicit CheckpointReader(const std::string& path) : path_(path), file_(path, ParallelHdf5::Mode::read) {}
  bool reading() const override { return true; }
  void common(const std::string& name, std::vector<double>& values) override;
  void parts(const std::string& name, std::vector<double>& values) override;
  void rows(const std::string& name, const StateRows& rows, int width, double* values) override;
  void ragged(const std::string& name, const StateRows& rows, const std::vector<int>& sizes, double* values) override;

 private:
  /// Where this rank's rows are in the file.
  struct Kind {
    std::uint64_t first = 0, total = 0;                   // of all; first only if alike
    bool alike = false;                                   // the same ranks wrote the same rows: each reads its own back
    std::unordered_map<std::int64_t, std::size_t> place;  // otherwise: number -> row of this rank
    std::vector<std::int64_t> numbers;                    // otherwise: of all rows of the file
  };
  const Kind& kind(const StateRows& rows);
  void read_own(const std::string& name, std::uint64_t count, double* values);
  /// `start`: of each row of this rank among its values, and their end.
  void pick(const std::string& name, const Kind& kind, const std::vector<std::size_t>& start, double* values);
  void fail_if(bool wrong, const std::string& name, const std::string& problem) const;  ///< collective
  void verify(const std::string& name, std::uint64_t sum) const;

  std::string path_;
  ParallelHdf5 file_;
  std::map<std::string, Kind> kinds_;
};

}  // namespace titin
