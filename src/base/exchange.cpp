#include "base/exchange.hpp"

#include <algorithm>

#include "base/parallel.hpp"

namespace titin {

Exchange::Exchange(std::vector<Part> to, std::vector<Part> from, MPI_Comm comm)
    : to_(std::move(to)), from_(std::move(from)), comm_(comm) {}

Exchange::Exchange(std::vector<Part> to, MPI_Comm comm) : to_(std::move(to)), comm_(comm) {
  const int n = ranks(comm);
  if (n == 1) return;
  std::vector<unsigned long> mine(n, 0), theirs(n, 0);
  for (const Part& part : to_) mine[part.rank] += part.count;
  MPI_Alltoall(mine.data(), 1, MPI_UNSIGNED_LONG, theirs.data(), 1, MPI_UNSIGNED_LONG, comm);
  for (int r = 0; r < n; ++r)
    if (theirs[r] > 0) from_.push_back({r, theirs[r]});
  std::erase_if(to_, [](const Part& part) { return part.count == 0; });
}

Exchange Exchange::reversed() const { return {from_, to_, comm_}; }

std::size_t Exchange::count(const std::vector<Part>& parts) {
  std::size_t all = 0;
  for (const Part& part : parts) all += part.count;
  return all;
}

void Exchange::begin_bytes(const char* send, char* receive, std::size_t item) {
  constexpr int tag = 5;
  MPI_Datatype type;  // counts of items, not of bytes: those may pass 2^31
  MPI_Type_contiguous(static_cast<int>(item), MPI_BYTE, &type);
  MPI_Type_commit(&type);
  for (const Part& part : from_) {
    MPI_Irecv(receive, static_cast<int>(part.count), type, part.rank, tag, comm_, &requests_.emplace_back());
    receive += part.count * item;
  }
  for (const Part& part : to_) {
    MPI_Isend(send, static_cast<int>(part.count), type, part.rank, tag, comm_, &requests_.emplace_back());
    send += part.count * item;
  }
  MPI_Type_free(&type);  // lives on until the messages have arrived
}

void Exchange::end() {
  MPI_Waitall(static_cast<int>(requests_.size()), requests_.data(), MPI_STATUSES_IGNORE);
  requests_.clear();
}

}  // namespace titin
