#include "fe/tangent_action.hpp"

#include "fe/cell_tables.hpp"
#include "fe/hexahedron_action.hpp"
#include "fe/hexahedron_kernels.hpp"

namespace titin {

namespace {

PetscErrorCode shell_multiply(Mat shell, Vec x, Vec y) {
  TangentAction* action;
  const PetscScalar* from;
  PetscScalar* to;
  check(MatShellGetContext(shell, &action));
  check(VecGetArrayRead(x, &from));
  check(VecGetArrayWrite(y, &to));
  action->multiply(from, to);
  check(VecRestoreArrayRead(x, &from));
  check(VecRestoreArrayWrite(y, &to));
  return 0;
}

}  // namespace

std::unique_ptr<TangentAction> TangentAction::create(const mfem::ParFiniteElementSpace& space, const CellTables& tables,
                                                     const std::vector<char>& constrained, bool symmetric,
                                                     Precision precision) {
  if (!symmetric) return nullptr;
  return hexahedron_kernel<TangentAction>(tables, [&]<int n, int q>() -> std::unique_ptr<TangentAction> {
    if (precision == Precision::full)
      return std::make_unique<HexahedronAction<double, n, q>>(space, tables, constrained);
    return std::make_unique<HexahedronAction<float, n, q>>(space, tables, constrained);
  });
}

Mat TangentAction::shell(const mfem::ParFiniteElementSpace& space) {
  Mat shell;
  const int size = space.GetTrueVSize();
  check(MatCreateShell(PETSC_COMM_WORLD, size, size, PETSC_DETERMINE, PETSC_DETERMINE, this, &shell));
  check(MatSetBlockSize(shell, 3));
  check(MatShellSetOperation(shell, MATOP_MULT, reinterpret_cast<void (*)()>(shell_multiply)));
  return shell;
}

}  // namespace titin
