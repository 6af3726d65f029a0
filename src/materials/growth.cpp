#include "materials/growth.hpp"

#include <cmath>

namespace titin {
namespace {

/// A_iJkL = w Ae_iMkN G_JM G_LN for symmetric G = F_g^-1.
void push_tangent(double w, const Mat3& G, Mat9& A) {
  Mat9 half;  // Ae_iJkN G_LN
  for (int p = 0; p < 9; ++p)
    for (int k = 0; k < 3; ++k)
      for (int L = 0; L < 3; ++L) {
        double sum = 0;
        for (int N = 0; N < 3; ++N) sum += A[9 * p + 3 * k + N] * G[3 * L + N];
        half[9 * p + 3 * k + L] = w * sum;
      }
  for (int i = 0; i < 3; ++i)
    for (int J = 0; J < 3; ++J)
      for (int q = 0; q < 9; ++q) {
        double sum = 0;
        for (int M = 0; M < 3; ++M) sum += half[9 * (3 * i + M) + q] * G[3 * J + M];
        A[9 * (3 * i + J) + q] = sum;
      }
}

}  // namespace

void Growth::bind(Section& s) {
  s.choose("law", law, {{"isotropic", Law::isotropic}, {"area", Law::area}, {"fibre", Law::fibre}},
           {.required = true, .doc = "in all directions, across a normal, or along a direction"});
  s.read("stretch", stretch,
         {.range = positive,
          .required = true,
          .doc = "ratio of grown to original lengths (isotropic), of areas across the normal, or of lengths along the "
                 "direction"});
  s.choose("per", per, {{"intermediate", Per::intermediate}, {"reference", Per::reference}},
           {.doc = "energies are per grown volume (new tissue like the old), or per volume before growth (swelling)"});
  const auto read_axis = [&](const char* key, bool required, const char* doc) {
    s.read(key, axis, {.required = required, .doc = doc});
    const double length = norm(axis);
    if (length > 0) axis = {axis[0] / length, axis[1] / length, axis[2] / length};
    if (s.has(key) && !(length > 0)) s.error(key, "a vector of zero length has no direction", "give [0, 0, 1], say");
  };
  if (s.describing() || law == Law::area)
    read_axis("normal", !s.describing(), "area, where it must be given: normal of the plane that grows");
  if (s.describing() || law == Law::fibre)
    read_axis("direction", false, "fibre: direction that grows (default: the fibre of each point)");
}

double Growth::volume_ratio() const { return law == Law::isotropic ? stretch * stretch * stretch : stretch; }

Mat3 Growth::inverse(const Vec3& fibre) const {
  // F_g = x I + (y - x) a (x) a, whose inverse is of the same kind
  const double across = law == Law::isotropic ? 1 / stretch : law == Law::area ? 1 / std::sqrt(stretch) : 1;
  const double along = law == Law::area ? 1 : 1 / stretch;
  const Vec3& a = norm(axis) > 0 ? axis : fibre;
  Mat3 G = dyad(a, a);
  for (double& x : G) x *= along - across;
  for (int i = 0; i < 9; i += 4) G[i] += across;
  return G;
}

struct GrownMaterial::Points {
  Points(const GrownMaterial& material, const PointInput& all)
      : w(material.growth_.weight()),
        in(all),
        F(all.n),
        F_old(all.F_old ? all.n : 0),
        G(all.n),
        F_rate_old(all.F_rate_old ? all.n : 0),
        F_rate(all.F_rate ? all.n : 0) {
    const Vec3 own = material.fibre();
    for (int p = 0; p < in.n; ++p) {
      G[p] = material.growth_.inverse(in.fibre ? in.fibre[p] : own);
      F[p] = multiply(in.F[p], G[p]);
      if (in.F_old) F_old[p] = multiply(in.F_old[p], G[p]);
      if (in.F_rate_old) F_rate_old[p] = multiply(in.F_rate_old[p], G[p]);
      if (in.F_rate) F_rate[p] = multiply(in.F_rate[p], G[p]);
    }
    in.F = F.data();
    if (in.F_old) in.F_old = F_old.data();
    if (in.F_rate_old) in.F_rate_old = F_rate_old.data();
    if (in.F_rate) in.F_rate = F_rate.data();
  }
  void push(Mat3* P, Mat9* A) const {
    for (int p = 0; p < in.n; ++p) {
      P[p] = scaled(w, multiply(P[p], G[p]));
      if (A) push_tangent(w, G[p], A[p]);
    }
  }
  void weigh(double* W) const {
    for (int p = 0; p < in.n; ++p) W[p] *= w;
  }

  double w;
  PointInput in;
  std::vector<Mat3> F, F_old, G, F_rate_old, F_rate;
};

void GrownMaterial::stress(const PointInput& in, Mat3* P, Mat9* A) const {
  const Points points(*this, in);
  inside_->stress(points.in, P, A);
  points.push(P, A);
}

void GrownMaterial::term_stress(int term, const PointInput& in, Mat3* P) const {
  const Points points(*this, in);
  inside_->term_stress(term, points.in, P);
  points.push(P, nullptr);
}

void GrownMaterial::term_energy(int term, const PointInput& in, double* W) const {
  const Points points(*this, in);
  inside_->term_energy(term, points.in, W);
  points.weigh(W);
}

void GrownMaterial::potential(const PointInput& in, double* W) const {
  const Points points(*this, in);
  inside_->potential(points.in, W);
  points.weigh(W);
}

void GrownMaterial::fibre_state(const PointInput& in, double* stretch, double* rate, double* activation) const {
  inside_->fibre_state(Points(*this, in).in, stretch, rate, activation);
}

Material::Volumetric GrownMaterial::volumetric(double ratio) const {
  const double w = growth_.weight(), J = growth_.volume_ratio();
  const Volumetric inside = inside_->volumetric(ratio / J);
  return {w * inside.U, w * inside.dU / J, w * inside.d2U / (J * J)};
}

void GrownMaterial::term_dissipation(int term, int n, const double* history, double* D) const {
  inside_->term_dissipation(term, n, history, D);
  for (int p = 0; p < n; ++p) D[p] *= growth_.weight();
}

std::shared_ptr<const Material> read_growth(Section& s, std::shared_ptr<const Material> material) {
  if (!s.has("growth") && !s.describing()) return material;
  Growth growth;
  Section g = s.section("growth", "the material grows by this much: F = F_e F_g, its laws know F_e");
  growth.bind(g);
  if (growth.law == Growth::Law::fibre && !(norm(growth.axis) > 0) && !(norm(material->fibre()) > 0) && !s.describing())
    g.error("", "grows along the fibre, and there is none", "give direction = [1, 0, 0], say, or the material a fibre");
  return std::make_shared<GrownMaterial>(growth, std::move(material));
}

}  // namespace titin
