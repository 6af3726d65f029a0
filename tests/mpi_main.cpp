/// The main of test programs that use MPI: rank 0 prints, every rank's failures count and are shown.
#include <gtest/gtest.h>

#include <cstdio>
#include <mfem.hpp>

#include "base/parallel.hpp"

namespace {

/// Speaks only of what failed: for the ranks that are otherwise silent.
class FailurePrinter : public testing::EmptyTestEventListener {
  void OnTestPartResult(const testing::TestPartResult& result) override {
    if (!result.failed()) return;
    std::fprintf(stderr, "[rank %d] %s:%d: failure\n%s\n", titin::rank(), result.file_name() ? result.file_name() : "?",
                 result.line_number(), result.message());
  }
};

}  // namespace

int main(int argc, char** argv) {
  titin::MpiSession session(argc, argv);
  testing::InitGoogleTest(&argc, argv);
  mfem::Hypre::Init();
  mfem::MFEMInitializePetsc(nullptr, nullptr, nullptr, nullptr);
  if (!titin::is_root()) {
    auto& listeners = testing::UnitTest::GetInstance()->listeners();
    delete listeners.Release(listeners.default_result_printer());
    listeners.Append(new FailurePrinter);
  }
  // An exception on one rank would leave the others waiting for it.
  testing::GTEST_FLAG(catch_exceptions) = titin::ranks() == 1;
  const bool failed = titin::any_of(RUN_ALL_TESTS() != 0);
  mfem::MFEMFinalizePetsc();
  return failed ? 1 : 0;
}
