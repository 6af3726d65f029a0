#include "fe/tangent_border.hpp"

#include "base/parallel.hpp"

namespace titin {

TangentBorder::TangentBorder(const mfem::ParFiniteElementSpace& space, const Constraints& constraints,
                             const Links& links)
    : space_(space), constraints_(constraints), links_(links) {
  for (const Rails::Rail& rail : constraints.rails().list()) {
    border_.unknowns.push_back({{rail.dofs.begin(), rail.dofs.end()}, rail.carrier});
    columns_.emplace_back(space.GetVSize());
    rows_.emplace_back(space.GetVSize());
  }
  for (const Links::Link& link : links.list()) {
    border_.unknowns.push_back({});
    free_g_.push_back(link.g);
    constraints.set_zero(free_g_.back());
  }
  border_.columns.assign(border_.size(), mfem::Vector(space.GetTrueVSize()));
  border_.rows = border_.columns;
  border_.corner.SetSize(border_.size());
}

void TangentBorder::begin() {
  border_.corner = 0.0;
  for (auto* list : {&columns_, &rows_})
    for (mfem::Vector& v : *list) v = 0.0;
}

void TangentBorder::add(const int* dofs, int n, const double* K) {
  const Rails& rails = constraints_.rails();
  for (int d = 0; d < n && rails.any(); ++d) {
    const int rail = rails.of_local(dofs[d]);
    if (rail < 0) continue;
    for (int c = 0; c < n; ++c) {
      const int other = rails.of_local(dofs[c]);
      if (other >= 0) {
        border_.corner(other, rail) += K[c * n + d];
      } else if (!constraints_.is_constrained_local(dofs[c])) {
        columns_[rail](dofs[c]) += K[c * n + d];
        rows_[rail](dofs[c]) += K[d * n + c];
      }
    }
  }
}

void TangentBorder::end(double inertia, double displacement_part, double velocity_factor) {
  const auto& rails = constraints_.rails().list();
  std::vector<double> corner(border_.corner.Data(), border_.corner.Data() + border_.size() * border_.size());
  sum(corner);
  std::copy(corner.begin(), corner.end(), border_.corner.Data());
  for (std::size_t j = 0; j < rails.size(); ++j) {
    space_.GetProlongationMatrix()->MultTranspose(columns_[j], border_.columns[j]);
    space_.GetProlongationMatrix()->MultTranspose(rows_[j], border_.rows[j]);
    border_.corner(j, j) += rails[j].config->mass * inertia;
  }
  set_links(displacement_part, velocity_factor);
}

void TangentBorder::set_links(double displacement_part, double velocity_factor) {
  const int rails = static_cast<int>(constraints_.rails().list().size());
  for (std::size_t i = 0; i < links_.list().size(); ++i) {
    const Links::Link& link = links_.list()[i];
    const int l = rails + static_cast<int>(i);
    const double kappa = displacement_part * link.spring + velocity_factor * link.damper;
    border_.columns[l] = free_g_[i];
    border_.rows[l] = free_g_[i];
    border_.rows[l] *= kappa;
    border_.corner(l, l) = -1;
    const std::vector<double> on_plates = constraints_.rails().totals(link.g);
    for (int j = 0; j < rails; ++j) {
      border_.corner(j, l) = on_plates[j];
      border_.corner(l, j) = kappa * on_plates[j];
    }
  }
}

}  // namespace titin
