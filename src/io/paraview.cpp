#include "io/paraview.hpp"

#include <algorithm>

#include "io/output_error.hpp"

namespace titin {

ParaView::ParaView(const std::string& folder, const std::string& name, mfem::ParMesh& mesh, const Fields& fields)
    : collection_(name, &mesh) {
  int order = 1;
  collection_.SetPrefixPath(folder);
  for (const auto& [field, values] : fields) {
    collection_.RegisterField(field, values);
    order = std::max(order, values->ParFESpace()->GetMaxElementOrder());
  }
  collection_.SetHighOrderOutput(true);
  collection_.SetLevelsOfDetail(order);
  collection_.SetDataFormat(mfem::VTKFormat::BINARY);
  collection_.SetCompression(true);
}

void ParaView::write(int cycle, double time) {
  collection_.SetCycle(cycle);
  collection_.SetTime(time);
  collection_.Save();
  if (collection_.Error() != mfem::DataCollection::No_Error)
    throw OutputError(collection_.GetPrefixPath() + collection_.GetCollectionName());
}

}  // namespace titin
