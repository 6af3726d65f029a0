#include "fe/initial_motion.hpp"

#include <memory>

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
  motion.bind(s);
}

mfem::Vector InitialMotion::at_dofs(mfem::ParFiniteElementSpace& space) const {
  mfem::VectorFunctionCoefficient velocities(space.GetVDim(), [this](const mfem::Vector& X, mfem::Vector& v) {
    Vec3 x{}, r{};  // plane bodies: z = 0
    for (int i = 0; i < X.Size(); ++i) x[i] = X(i), r[i] = X(i) - centre[i];
    const Vec3 named = motion.velocity_at(x);
    for (int i = 0; i < v.Size(); ++i) {
      const int j = (i + 1) % 3, k = (i + 2) % 3;
      v(i) = velocity[i] + spin[j] * r[k] - spin[k] * r[j] + named[i];
    }
  });
  mfem::ParGridFunction field(&space);
  field.ProjectCoefficient(velocities);
  mfem::Vector v(space.GetTrueVSize());
  field.GetTrueDofs(v);
  return v;
}

namespace {

/// The mass matrix where displacements are free, and on rails, whose carriers stand for their plates and loads.
class ConstrainedMass : public mfem::Operator {
 public:
  ConstrainedMass(mfem::ParBilinearForm& form, const Constraints& constraints)
      : Operator(form.ParFESpace()->GetTrueVSize()),
        M_(form.ParallelAssemble()),
        constraints_(constraints),
        diagonal_(Height()) {
    M_->GetDiag(diagonal_);
    constraints_.condense(diagonal_);
    add_loads([this](int carrier, double mass) { diagonal_(carrier) += mass; });
    for (double& entry : diagonal_) entry = entry > 0 ? entry : 1;
  }
  void Mult(const mfem::Vector& x, mfem::Vector& y) const override {
    mfem::Vector all(x);
    constraints_.rails().spread(all);
    M_->Mult(all, y);
    constraints_.condense(y);
    add_loads([&](int carrier, double mass) { y(carrier) += mass * x(carrier); });
  }
  const mfem::Vector& diagonal() const { return diagonal_; }

 private:
  template <class Visit>
  void add_loads(Visit visit) const {
    for (const Rails::Rail& rail : constraints_.rails().list())
      if (rail.carrier >= 0) visit(rail.carrier, rail.config->mass);
  }
  std::unique_ptr<mfem::HypreParMatrix> M_;
  const Constraints& constraints_;
  mfem::Vector diagonal_;
};

class Scaling : public mfem::Solver {
 public:
  explicit Scaling(const mfem::Vector& diagonal) : Solver(diagonal.Size()), diagonal_(diagonal) {}
  void SetOperator(const mfem::Operator&) override {}
  void Mult(const mfem::Vector& x, mfem::Vector& y) const override {
    for (int i = 0; i < x.Size(); ++i) y(i) = x(i) / diagonal_(i);
  }

 private:
  const mfem::Vector& diagonal_;
};

}  // namespace

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
  const ConstrainedMass M(form, system.constraints());
  Scaling scaling(M.diagonal());
  mfem::CGSolver solver(space.GetComm());
  solver.SetRelTol(mass_tolerance);
  solver.SetMaxIter(mass_iterations);
  solver.SetPreconditioner(scaling);
  solver.SetOperator(M);
  mfem::Vector a(residual.Size()), b(residual);
  a = 0.0;
  b.Neg();
  solver.Mult(b, a);
  system.constraints().rails().spread(a);
  return a;
}

}  // namespace titin
