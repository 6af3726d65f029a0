#include "fe/places_of_dofs.hpp"

namespace titin {

mfem::Vector places_of_dofs(mfem::ParFiniteElementSpace& space) {
  mfem::VectorFunctionCoefficient place(space.GetVDim(), [](const mfem::Vector& X, mfem::Vector& x) { x = X; });
  mfem::ParGridFunction field(&space);
  field.ProjectCoefficient(place);
  mfem::Vector X(space.GetTrueVSize());
  field.GetTrueDofs(X);
  return X;
}

}  // namespace titin
