/// Springs and dampers between two boundaries: a tendon in series, a spring beside a muscle.
///
/// Along each axis the force between them is  s = k e + c de/dt  with the elongation  e = mean of u over the second -
/// mean over the first = g . u, shared out by reference area: -s g at the dofs. It has a potential where c = 0.
#pragma once

#include <mfem.hpp>
#include <string>
#include <vector>

#include "base/config.hpp"
#include "mesh/mesh.hpp"

namespace titin {

class CellElements;

struct LinkConfig {
  std::string name;
  std::vector<std::string> between;          // two boundaries of the mesh
  std::array<double, 3> spring{}, damper{};  // [N/m], [N s/m] by component
  void bind(Section& s, const NamedMesh& mesh);
};

class Links {
 public:
  /// One link along one axis.
  struct Link {
    const LinkConfig* config;
    int axis;
    mfem::Vector g;  // true dofs
    double spring, damper;
    double force = 0;  // at the last update [N]; positive pulls the boundaries together
  };
  /// Collective.
  Links(const std::vector<LinkConfig>& links, const NamedMesh& mesh, const CellElements& elements,
        const mfem::ParFiniteElementSpace& space, int points);

  bool any() const { return !links_.empty(); }
  bool has_damper() const;
  const std::vector<Link>& list() const { return links_; }
  /// Forces at this displacement and velocity (which may be empty: at rest); true dofs. Collective.
  void update(const mfem::Vector& u, const mfem::Vector& v);
  /// Adds what they do to the body, and their sizes.
  void add(mfem::Vector& forces, mfem::Vector& absolute) const;
  static double elongation(const Link& link, const mfem::Vector& u);  ///< g . u. Collective.
  double energy(const mfem::Vector& u) const;                         ///< [J]. Collective.

 private:
  std::vector<Link> links_;
};

}  // namespace titin
