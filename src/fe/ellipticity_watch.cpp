#include "fe/ellipticity_watch.hpp"

#include <algorithm>
#include <limits>

#include "base/log.hpp"
#include "base/parallel.hpp"
#include "base/timers.hpp"
#include "materials/ellipticity.hpp"

namespace titin {

void EllipticityWatch::update(const mfem::Vector& u, const StepState& step) {
  Timers::Scope timer("ellipticity");
  smallest_.assign(system_.space().GetNE(), 0.0);
  system_.for_each_cell(u, [&](int cell, const Material& material, const ThreeField& kernel) {
    const PointInput in = kernel.points(system_.point_input(cell));
    std::vector<AcousticValue> values(in.n);
    legendre_hadamard(material, in, values.data());
    const auto less = [](const AcousticValue& a, const AcousticValue& b) { return a.value < b.value; };
    smallest_[cell] = std::min_element(values.begin(), values.end(), less)->value;
  });
  const bool lost = std::any_of(smallest_.begin(), smallest_.end(), [](double value) { return value < 0; });
  if (!warned_ && any_of(lost)) warn(step.time);
}

std::vector<Quantity> EllipticityWatch::quantities() const {
  double least = std::numeric_limits<double>::infinity();
  for (double value : smallest_) least = std::min(least, value);
  const auto lost = std::count_if(smallest_.begin(), smallest_.end(), [](double value) { return value < 0; });
  return {{"legendre_hadamard", "Pa", min(least)}, {"cells_not_elliptic", "", sum(static_cast<double>(lost))}};
}

/// Says where it is worst.
void EllipticityWatch::warn(double time) {
  warned_ = true;
  const auto worst = std::min_element(smallest_.begin(), smallest_.end());
  const double mine = worst == smallest_.end() ? std::numeric_limits<double>::infinity() : *worst, least = min(mine);
  const double owner = min(mine == least ? rank() : std::numeric_limits<double>::max());
  std::vector<double> x(3, 0.0);
  if (owner == rank()) {
    mfem::Vector centre(x.data(), system_.tables().dimension());
    auto& map = *system_.space().GetElementTransformation(static_cast<int>(worst - smallest_.begin()));
    map.Transform(mfem::Geometries.GetCenter(map.GetGeometryType()), centre);
  }
  sum(x);
  const std::vector<Quantity> now = quantities();
  logging::warning(fmt::format(
      "ellipticity is lost at {:.6g} s in {:.0f} of {} cells, worst near undeformed ({:.4g}, {:.4g}, {:.4g}) m "
      "(Legendre-Hadamard value {:.4g} Pa): from here on bands may form whose width is that of a cell; stiffen the "
      "base "
      "material, activate less, or keep the fibres off their descending limb",
      time, now[1].value, system_.space().GetParMesh()->GetGlobalNE(), x[0], x[1], x[2], least));
}

}  // namespace titin
