#include "mesh/plane_triangles.hpp"

namespace titin {

mfem::Mesh make_plane_triangles(int nx, int ny, double a, double b, BoxCuts cuts) {
  const bool crossed = cuts == BoxCuts::crossed;
  mfem::Mesh mesh(2, (nx + 1) * (ny + 1) + crossed * nx * ny, (crossed ? 4 : 2) * nx * ny, 2 * (nx + ny));
  const auto node = [&](int i, int j) { return j * (nx + 1) + i; };
  for (int j = 0; j <= ny; ++j)
    for (int i = 0; i <= nx; ++i) mesh.AddVertex(a * i / nx, b * j / ny);
  for (int j = 0; j < ny; ++j)
    for (int i = 0; i < nx; ++i) {
      const int corner[] = {node(i, j), node(i + 1, j), node(i + 1, j + 1), node(i, j + 1)};
      if (crossed) {
        const int middle = mesh.AddVertex(a * (i + 0.5) / nx, b * (j + 0.5) / ny);
        for (int k = 0; k < 4; ++k) mesh.AddTriangle(corner[k], corner[(k + 1) % 4], middle);
        continue;
      }
      const int first = cuts == BoxCuts::alternating && (i + j) % 2 == 0 ? 1 : 0;  // where the diagonal starts
      const auto turned = [&](int k) { return corner[(first + k) % 4]; };
      mesh.AddTriangle(turned(0), turned(1), turned(2));
      mesh.AddTriangle(turned(0), turned(2), turned(3));
    }
  for (int i = 0; i < nx; ++i) {
    mesh.AddBdrSegment(node(i, 0), node(i + 1, 0), 1);
    mesh.AddBdrSegment(node(i + 1, ny), node(i, ny), 3);
  }
  for (int j = 0; j < ny; ++j) {
    mesh.AddBdrSegment(node(0, j + 1), node(0, j), 4);
    mesh.AddBdrSegment(node(nx, j), node(nx, j + 1), 2);
  }
  mesh.FinalizeTriMesh(1, 0, true);
  return mesh;
}

}  // namespace titin
