/// The fields of a run over time, for ParaView: files of one of three formats, and an index that opens them all.
///
///   vtu                fields/fields.pvd, fields/Cycle000004/data.pvtu and proc000000.vtu of each rank
///   vtkhdf             fields/fields.vtkhdf.series, fields/fields_000004.vtkhdf
///   vtkhdf_transient   fields/fields.vtkhdf
///
/// The index is written as a whole after the data that it names: whoever reads it finds them.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "io/drawn_mesh.hpp"
#include "io/vtkhdf.hpp"
#include "io/vtu.hpp"

namespace titin {

enum class FieldFormat { vtu, vtkhdf, vtkhdf_transient };

struct FieldFiles {
  FieldFormat format = FieldFormat::vtu;
  Digits precision = Digits::twofold;
  Jumps jumps = Jumps::nodes;
};

class ParaView {
 public:
  /// One time that was written.
  struct Entry {
    int cycle;
    double time;
  };
  /// Into RUN/fields. Mesh and fields stay the caller's and must live as long as this. `earlier`: what a run that is
  /// restarted had written up to there; what it wrote later is removed. Collective.
  ParaView(const std::string& run, mfem::ParMesh& mesh, const std::vector<Field>& fields, const FieldFiles& files,
           std::vector<Entry> earlier = {});
  /// Writes the fields as they are now. Collective. Throws OutputError.
  void write(int cycle, double time);
  const std::vector<Entry>& entries() const { return entries_; }

 private:
  std::string name_of(int cycle) const;
  void write_pieces(int cycle);
  void write_index() const;
  void remove_later() const;

  std::string folder_;
  FieldFiles files_;
  DrawnMesh mesh_;
  std::vector<Entry> entries_;
  std::unique_ptr<TransientVtkhdf> transient_;
};

}  // namespace titin
