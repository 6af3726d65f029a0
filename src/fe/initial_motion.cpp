#include "fe/initial_motion.hpp"

#include "fe/muscle_system.hpp"
#include "mesh/plane_vector.hpp"

namespace titin {
namespace {

/// Relative residual of the mass matrix' conjugate gradients: accelerations to more digits than a step keeps.
constexpr double mass_tolerance = 1e-14;
constexpr int mass_iterations = 500;

}  // namespace

void InitialMotion::bind(Section& s, const NamedMesh& mesh) {
  read_vector(s, "velocity", velocity, {.unit = "m/s", .doc = "of the whole body"}, mesh);
  s.read("spin", spin, {.unit = "1/s", .doc = "angular velocity about the centre, in radians"});
  read_vector(s, "centre", centre, {.unit = "m", .doc = "a point of the axis of the spin"}, mesh);
  if (mesh.mesh && mesh.mesh->Dimension() == 2 && (spin[0] != 0 || spin[1] != 0))
    s.error("spin", "turns the body out of its plane", "give [0, 0, rate]");
}

mfem::Vector InitialMotion::at_dofs(mfem::ParFiniteElementSpace& space) const {
  mfem::VectorFunctionCoefficient motion(space.GetVDim(), [this](const mfem::Vector& X, mfem::Vector& v) {
    std::array<double, 3> r{};  // plane bodies: z = 0
    for (int i = 0; i < X.Size(); ++i) r[i] = X(i) - centre[i];
    for (int i = 0; i < v.Size(); ++i) {
      const int j = (i + 1) % 3, k = (i + 2) % 3;
      v(i) = velocity[i] + spin[j] * r[k] - spin[k] * r[j];
    }
  });
  mfem::ParGridFunction field(&space);
  field.ProjectCoefficient(motion);
  mfem::Vector v(space.GetTrueVSize());
  field.GetTrueDofs(v);
  return v;
}

mfem::Vector initial_acceleration(MuscleSystem& system, double thickness, const mfem::Vector& residual) {
  mfem::ParFiniteElementSpace& space = system.space();
  mfem::Vector density(space.GetParMesh()->attributes.Max());
  density = 0.0;
  for (int cell = 0; cell < space.GetNE(); ++cell)
    density(space.GetParMesh()->GetAttribute(cell) - 1) = system.material(cell).density() * thickness;
  mfem::PWConstCoefficient of_region(density);
  mfem::ParBilinearForm form(&space);
  form.AddDomainIntegrator(new mfem::VectorMassIntegrator(of_region));
  form.Assemble();
  form.Finalize();
  mfem::Vector a(residual.Size()), b(residual);
  a = 0.0;
  b.Neg();
  for (int dof : system.constraints().dofs()) b(dof) = 0;
  mfem::HypreParMatrix M;
  form.FormSystemMatrix(system.constraints().dofs(), M);
  mfem::HypreDiagScale scaling(M);
  mfem::HyprePCG solver(M);
  solver.SetTol(mass_tolerance);
  solver.SetMaxIter(mass_iterations);
  solver.SetPreconditioner(scaling);
  solver.Mult(b, a);
  return a;
}

}  // namespace titin
