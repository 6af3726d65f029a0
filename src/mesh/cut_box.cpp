#include "mesh/cut_box.hpp"

namespace titin {
namespace {

using Place = std::array<int, 3>;  // in half boxes

/// Corners, middles of faces and middles of boxes: vertices once a simplex uses them.
class Lattice {
 public:
  Lattice(const std::vector<int>& cells, const std::vector<double>& edge, BoxCuts cuts)
      : D_(static_cast<int>(cells.size())), edge_(edge), mesh_(D_, 0, 0) {
    for (int d = 0; d < D_; ++d) end_[d] = 2 * cells[d];
    vertex_.assign(std::size_t(end_[0] + 1) * (end_[1] + 1) * (end_[2] + 1), -1);
    Place p{};
    for (p[2] = 0; p[2] == 0 || p[2] < end_[2]; p[2] += 2)
      for (p[1] = 0; p[1] < end_[1]; p[1] += 2)
        for (p[0] = 0; p[0] < end_[0]; p[0] += 2) cuts == BoxCuts::crossed ? cross(p) : alternate(p);
    mesh_.FinalizeTopology();
    mesh_.Finalize(true, true);
    number_boundaries();
  }
  mfem::Mesh take() { return std::move(mesh_); }

 private:
  int vertex(const Place& p) {
    int& v = vertex_[(std::size_t(p[2]) * (end_[1] + 1) + p[1]) * (end_[0] + 1) + p[0]];
    if (v >= 0) return v;
    double x[3] = {};
    for (int d = 0; d < D_; ++d) x[d] = edge_[d] * p[d] / end_[d];
    return v = mesh_.AddVertex(x);
  }

  template <class... Places>
  void add(const Places&... places) {  // any order: MFEM turns those that are inside out
    const int corners[] = {vertex(places)...};
    sizeof...(places) == 3 ? mesh_.AddTriangle(corners) : mesh_.AddTet(corners);
  }

  static Place moved(Place p, int axis, int by) {
    p[axis] += by;
    return p;
  }
  /// The corner of the box p across this axis.
  static Place across(const Place& p, Place corner, int axis) {
    corner[axis] = 2 * p[axis] + 2 - corner[axis];
    return corner;
  }

  /// Cuts meet at every other corner of the lattice, not at the origin, which one simplex then has for itself.
  void alternate(const Place& p) {
    Place at = p;
    if ((p[0] + p[1] + p[2]) / 2 % 2 == 0) at = across(p, at, 0);
    const auto away = [&](int a, int b) { return across(p, across(p, at, a), b); };
    if (D_ == 2) {
      add(at, across(p, at, 0), away(0, 1));
      add(at, across(p, at, 1), away(0, 1));
      return;
    }
    const Place xy = away(0, 1), yz = away(1, 2), zx = away(2, 0);
    add(at, xy, yz, zx);
    add(across(p, at, 0), at, xy, zx);
    add(across(p, at, 1), at, xy, yz);
    add(across(p, at, 2), at, yz, zx);
    add(across(p, xy, 2), xy, yz, zx);
  }

  void cross(const Place& p) {
    Place middle = p;
    for (int d = 0; d < D_; ++d) ++middle[d];
    for (int axis = 0; axis < D_; ++axis)
      for (int side : {-1, 1}) {
        const Place face = moved(middle, axis, side);
        const int b = (axis + 1) % D_, c = (axis + 2) % 3;
        if (D_ == 2) {
          add(middle, moved(face, b, -1), moved(face, b, 1));
          continue;
        }
        Place round[] = {moved(moved(face, b, -1), c, -1), moved(moved(face, b, 1), c, -1),
                         moved(moved(face, b, 1), c, 1), moved(moved(face, b, -1), c, 1)};
        for (int k = 0; k < 4; ++k) add(middle, face, round[k], round[(k + 1) % 4]);
      }
  }

  /// MFEM has found the faces outside; where they are says which side of the box they are of.
  void number_boundaries() {
    constexpr int plane[3][2] = {{4, 2}, {1, 3}, {}}, space[3][2] = {{5, 3}, {2, 4}, {1, 6}};
    for (int f = 0; f < mesh_.GetNBE(); ++f) {
      mfem::Array<int> corners;
      mesh_.GetBdrElementVertices(f, corners);
      for (int d = 0; d < D_; ++d) {
        double low = edge_[d], high = 0;
        for (int v : corners) {
          low = std::min(low, mesh_.GetVertex(v)[d]);
          high = std::max(high, mesh_.GetVertex(v)[d]);
        }
        const double inside = 0.5 * edge_[d] / end_[d];
        const bool is_low = high<inside, is_high = low> edge_[d] - inside;
        if (is_low || is_high) mesh_.SetBdrAttribute(f, (D_ == 2 ? plane : space)[d][is_high]);
      }
    }
    mesh_.SetAttributes();
  }

  int D_;
  std::vector<double> edge_;
  mfem::Mesh mesh_;
  Place end_{};
  std::vector<int> vertex_;
};

}  // namespace

mfem::Mesh make_cut_box(const std::vector<int>& cells, const std::vector<double>& edge, BoxCuts cuts) {
  return Lattice(cells, edge, cuts).take();
}

}  // namespace titin
