/// Repeated exchange of equal pieces between ranks: the sums on shared nodes, the rows that another rank owns.
///
/// Who sends how much to whom is agreed on once; after that every exchange is one message to each neighbour, which
/// travels while the caller works between begin() and end(). What arrives is ordered by the rank it came from, so that
/// sums made of it do not depend on who was faster.
#pragma once

#include <mpi.h>

#include <cstddef>
#include <vector>

namespace titin {

class Exchange {
 public:
  /// `count` consecutive items of a buffer for, or from, another rank.
  struct Part {
    int rank;
    std::size_t count;
  };
  /// `to`: what this rank sends each time, in the order of its buffer, one part a rank at most. Collective.
  explicit Exchange(std::vector<Part> to, MPI_Comm comm = MPI_COMM_WORLD);
  /// The same neighbours the other way round: what was received is sent back.
  Exchange reversed() const;

  std::size_t sent() const { return count(to_); }        ///< items in the buffer to send
  std::size_t received() const { return count(from_); }  ///< items in the buffer that fills
  std::size_t neighbours() const { return to_.size() + from_.size(); }

  /// Starts to send; both buffers are left alone until end(). An item is `block` numbers. Not collective by itself:
  /// the neighbours must do the same.
  template <class T>
  void begin(const T* send, T* receive, int block = 1) {
    begin_bytes(reinterpret_cast<const char*>(send), reinterpret_cast<char*>(receive), block * sizeof(T));
  }
  void end();

 private:
  Exchange(std::vector<Part> to, std::vector<Part> from, MPI_Comm comm);
  static std::size_t count(const std::vector<Part>& parts);
  void begin_bytes(const char* send, char* receive, std::size_t item);

  std::vector<Part> to_, from_;
  MPI_Comm comm_;
  std::vector<MPI_Request> requests_;
};

}  // namespace titin
