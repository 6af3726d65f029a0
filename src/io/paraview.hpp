/// Fields for ParaView: one collection of high-order VTU files, binary and compressed. `DIR/NAME/NAME.pvd` opens it.
#pragma once

#include <mfem.hpp>
#include <string>
#include <utility>
#include <vector>

namespace titin {

class ParaView {
 public:
  using Fields = std::vector<std::pair<std::string, mfem::ParGridFunction*>>;

  /// The mesh and the fields stay the caller's and must live as long as this. Collective.
  ParaView(const std::string& folder, const std::string& name, mfem::ParMesh& mesh, const Fields& fields);
  /// Writes the fields as they are now. Collective.
  void write(int cycle, double time);

 private:
  mfem::ParaViewDataCollection collection_;
};

}  // namespace titin
