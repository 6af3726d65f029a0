/// The list of laws: one line each, and nothing else to do for a new one.
#include "materials/active_stress.hpp"
#include "materials/arruda_boyce.hpp"
#include "materials/blemker_fibre.hpp"
#include "materials/blemker_shear.hpp"
#include "materials/cann.hpp"
#include "materials/collagen_table.hpp"
#include "materials/compressible_neo_hookean.hpp"
#include "materials/demiray.hpp"
#include "materials/fluid.hpp"
#include "materials/fung.hpp"
#include "materials/gent.hpp"
#include "materials/goh.hpp"
#include "materials/guccione.hpp"
#include "materials/hencky.hpp"
#include "materials/hill_active.hpp"
#include "materials/hill_passive.hpp"
#include "materials/holmes_mow.hpp"
#include "materials/holzapfel_ogden.hpp"
#include "materials/icnn.hpp"
#include "materials/isotropic_family.hpp"
#include "materials/linear_fibre.hpp"
#include "materials/mooney_rivlin.hpp"
#include "materials/neo_hookean.hpp"
#include "materials/ogden.hpp"
#include "materials/st_venant_kirchhoff.hpp"
#include "materials/veronda_westmann.hpp"
#include "materials/volumetric.hpp"
#include "materials/weiss_fibre.hpp"
#include "materials/yeoh.hpp"

namespace titin {
namespace detail {

// Functions' statics, because laws register before main in no fixed order.
std::vector<LawEntry>& law_list() {
  static std::vector<LawEntry> list;
  return list;
}
std::vector<VolumetricEntry>& volumetric_list() {
  static std::vector<VolumetricEntry> list;
  return list;
}

bool add(LawEntry entry) {
  law_list().push_back(std::move(entry));
  return true;
}
bool add(VolumetricEntry entry) {
  volumetric_list().push_back(std::move(entry));
  return true;
}

}  // namespace detail

const std::vector<LawEntry>& law_entries() { return detail::law_list(); }
const std::vector<VolumetricEntry>& volumetric_entries() { return detail::volumetric_list(); }

namespace {

template <class Read>
LawInfo described(LawInfo info, Read read) {
  Config config = Config::describing();
  read(config.root());
  info.parameters = config.keys();
  return info;
}

}  // namespace

std::vector<LawInfo> laws() {
  std::vector<LawInfo> all;
  for (const LawEntry& entry : law_entries())
    all.push_back(described(entry.info, [&](Section s) { entry.read(s, {}); }));
  for (const VolumetricEntry& entry : volumetric_entries()) all.push_back(described(entry.info, entry.read));
  for (const FluidEntry& entry : fluid_entries()) all.push_back(described(entry.info, entry.read));
  return all;
}

}  // namespace titin
