#include "base/parallel.hpp"

#include <dlfcn.h>

#include <chrono>
#include <cstdlib>
#include <thread>

namespace titin {
namespace {

/// Without MPI (tests, titin_core) everything is one rank.
bool running() {
  int initialized = 0, finalized = 0;
  MPI_Initialized(&initialized);
  MPI_Finalized(&finalized);
  return initialized && !finalized;
}

template <class T>
T reduce(T x, MPI_Datatype type, MPI_Op op, MPI_Comm comm) {
  if (running()) MPI_Allreduce(MPI_IN_PLACE, &x, 1, type, op, comm);
  return x;
}

void make_blas_single_threaded() {
  setenv("OPENBLAS_NUM_THREADS", "1", 1);
  setenv("OMP_NUM_THREADS", "1", 0);  // a user may want threads elsewhere
  // OpenBLAS read the environment when it was loaded, before main.
  using SetThreads = void (*)(int);
  if (auto set = reinterpret_cast<SetThreads>(dlsym(RTLD_DEFAULT, "openblas_set_num_threads"))) set(1);
}

}  // namespace

MpiSession::MpiSession(int& argc, char**& argv) {
  make_blas_single_threaded();
  int initialized = 0;
  MPI_Initialized(&initialized);
  if (!initialized) MPI_Init(&argc, &argv);
  owns_ = !initialized;
}

MpiSession::~MpiSession() {
  if (owns_ && running()) MPI_Finalize();
}

int rank(MPI_Comm comm) {
  int r = 0;
  if (running()) MPI_Comm_rank(comm, &r);
  return r;
}

int ranks(MPI_Comm comm) {
  int n = 1;
  if (running()) MPI_Comm_size(comm, &n);
  return n;
}

bool is_root() { return rank() == 0; }

int ranks_on_node() {
  if (!running()) return 1;
  MPI_Comm node;
  MPI_Comm_split_type(MPI_COMM_WORLD, MPI_COMM_TYPE_SHARED, 0, MPI_INFO_NULL, &node);
  const int count = ranks(node);
  MPI_Comm_free(&node);
  return count;
}

double sum(double x, MPI_Comm comm) { return reduce(x, MPI_DOUBLE, MPI_SUM, comm); }
double max(double x, MPI_Comm comm) { return reduce(x, MPI_DOUBLE, MPI_MAX, comm); }
double min(double x, MPI_Comm comm) { return reduce(x, MPI_DOUBLE, MPI_MIN, comm); }
long sum(long x, MPI_Comm comm) { return reduce(x, MPI_LONG, MPI_SUM, comm); }
bool any_of(bool x, MPI_Comm comm) { return reduce(x ? 1 : 0, MPI_INT, MPI_MAX, comm) != 0; }

void sum(std::vector<double>& x, MPI_Comm comm) {
  if (running()) MPI_Allreduce(MPI_IN_PLACE, x.data(), static_cast<int>(x.size()), MPI_DOUBLE, MPI_SUM, comm);
}

std::string broadcast(std::string text, MPI_Comm comm) {
  if (!running()) return text;
  unsigned long size = text.size();
  MPI_Bcast(&size, 1, MPI_UNSIGNED_LONG, 0, comm);
  text.resize(size);
  MPI_Bcast(text.data(), static_cast<int>(size), MPI_CHAR, 0, comm);
  return text;
}

std::string mpi_version() {
  char text[MPI_MAX_LIBRARY_VERSION_STRING] = "";
  int length = 0;
  if (running()) MPI_Get_library_version(text, &length);
  const std::string all(text, length);
  return all.substr(0, all.find_first_of(",\n"));
}

bool all_arrive(double seconds) {
  if (!running()) return true;
  MPI_Request request;
  MPI_Ibarrier(MPI_COMM_WORLD, &request);
  for (const double end = MPI_Wtime() + seconds; MPI_Wtime() < end;) {
    int arrived = 0;
    MPI_Test(&request, &arrived, MPI_STATUS_IGNORE);
    if (arrived) return true;
    std::this_thread::sleep_for(std::chrono::milliseconds(5));
  }
  return false;
}

void abort_all(int exit_code) {
  if (running()) MPI_Abort(MPI_COMM_WORLD, exit_code);
  std::_Exit(exit_code);
}

}  // namespace titin
