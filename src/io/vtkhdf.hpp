/// VTKHDF files, written by all ranks together: of one time (version 1.0, which ParaView reads from 5.10 on), or of a
/// whole run (version 2.0 with "Steps": ParaView 5.12, VTK 9.3).
///
/// In a file of a whole run the cells are written once, and where their points are with each time.
#pragma once

#include <string>
#include <vector>

#include "io/drawn_mesh.hpp"
#include "io/vtu.hpp"

namespace titin {

/// Collective, like all here. Throws OutputError.
void write_vtkhdf(const std::string& path, DrawnMesh& mesh, double time, Digits precision);

class TransientVtkhdf {
 public:
  /// A new file, or with `steps` > 0 the first so many steps of one that is there.
  TransientVtkhdf(const std::string& path, Digits precision, long steps);
  void append(DrawnMesh& mesh, double time);

 private:
  std::string path_;
  Digits precision_;
  long steps_;
};

}  // namespace titin
