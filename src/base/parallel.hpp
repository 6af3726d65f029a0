/// With base/exchange the only place that calls MPI directly. All functions are collective on `comm` unless they say
/// otherwise.
#pragma once

#include <mpi.h>

#include <string>
#include <vector>

namespace titin {

/// MPI for the life of the program; also makes BLAS single-threaded (one rank is one core).
class MpiSession {
 public:
  MpiSession(int& argc, char**& argv);
  ~MpiSession();
  MpiSession(const MpiSession&) = delete;

 private:
  bool owns_ = false;
};

int rank(MPI_Comm comm = MPI_COMM_WORLD);   // not collective
int ranks(MPI_Comm comm = MPI_COMM_WORLD);  // not collective
bool is_root();                             // rank 0 of the world; not collective
int ranks_on_node();                        ///< of the world, that share this one's memory

double sum(double x, MPI_Comm comm = MPI_COMM_WORLD);
double max(double x, MPI_Comm comm = MPI_COMM_WORLD);
double min(double x, MPI_Comm comm = MPI_COMM_WORLD);
long sum(long x, MPI_Comm comm = MPI_COMM_WORLD);
void sum(std::vector<double>& x, MPI_Comm comm = MPI_COMM_WORLD);  ///< in place, elementwise
bool any_of(bool x, MPI_Comm comm = MPI_COMM_WORLD);
std::string broadcast(std::string text, MPI_Comm comm = MPI_COMM_WORLD);  ///< rank 0's
std::string mpi_version();  ///< name and version of the library; not collective
/// Do all ranks get here within some seconds? Tells an error that all ranks met from one that only some did.
bool all_arrive(double seconds);
/// Ends all ranks at once, for an error that only some of them met. Not collective.
[[noreturn]] void abort_all(int exit_code);

}  // namespace titin
