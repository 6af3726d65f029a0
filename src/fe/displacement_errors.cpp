#include "fe/displacement_errors.hpp"

#include <limits>

namespace titin {
namespace {

using Part = Vec3 MotionPoint::*;

class ExactValues : public mfem::VectorCoefficient {
 public:
  ExactValues(int dimension, const ExactMotion& exact, Part part, double time)
      : VectorCoefficient(dimension), exact_(exact), part_(part), time_(time) {}
  void Eval(mfem::Vector& value, mfem::ElementTransformation& map, const mfem::IntegrationPoint& point) override {
    mfem::Vector place;
    map.Transform(point, place);
    Vec3 X{};
    for (int i = 0; i < place.Size(); ++i) X[i] = place(i);
    const Vec3 exact = exact_.at(X, time_).*part_;
    value.SetSize(vdim);
    for (int i = 0; i < vdim; ++i) value(i) = exact[i];
  }

 private:
  const ExactMotion& exact_;
  Part part_;
  double time_;
};

}  // namespace

std::vector<Quantity> displacement_errors(mfem::ParFiniteElementSpace& space, const mfem::Vector& u,
                                          const mfem::Vector& v, const ExactMotion& exact, double time) {
  const mfem::IntegrationRule* rules[mfem::Geometry::NumGeom] = {};
  const int degree = 2 * space.GetMaxElementOrder() + 2;
  for (int geometry = mfem::Geometry::TRIANGLE; geometry < mfem::Geometry::NUM_GEOMETRIES; ++geometry)
    rules[geometry] = &mfem::IntRules.Get(geometry, degree);
  struct Compared {
    const char *name, *unit;
    Part part;
    const mfem::Vector& values;
  };
  struct Norm {
    const char* name;
    double power;
  };
  std::vector<Quantity> list;
  mfem::ParGridFunction field(&space);
  for (const Compared& c : {Compared{"displacement", "m", &MotionPoint::displacement, u},
                            Compared{"velocity", "m/s", &MotionPoint::velocity, v}}) {
    field.SetFromTrueDofs(c.values);
    ExactValues values(space.GetVDim(), exact, c.part, time);
    for (const Norm& norm : {Norm{"_L1", 1}, {"_L2", 2}, {"_Linf", std::numeric_limits<double>::infinity()}})
      list.push_back(
          {std::string(c.name) + norm.name, c.unit, field.ComputeLpError(norm.power, values, nullptr, nullptr, rules)});
  }
  return list;
}

}  // namespace titin
