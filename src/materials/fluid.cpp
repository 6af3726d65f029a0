#include "materials/fluid.hpp"

namespace titin {
namespace {

template <class Law>
FluidEntry entry() {
  LawInfo info = detail::info<Law>();
  info.kind = "fluid";
  info.needs_volumetric = false;
  return {std::move(info), [](Section s) -> std::shared_ptr<const Fluid> {
            return std::make_shared<detail::FluidAdaptor<Law>>(detail::read_law<Law>(s));
          }};
}

}  // namespace

const std::vector<FluidEntry>& fluid_entries() {
  static const std::vector<FluidEntry> list{entry<PerfectGas>(), entry<StiffenedGas>(), entry<MieGruneisen>()};
  return list;
}

std::shared_ptr<const Fluid> Fluid::read(Section s) {
  std::vector<std::string> names;
  for (const FluidEntry& e : fluid_entries()) names.push_back(e.info.name);
  int chosen = -1;
  s.choose_word("law", chosen, names, {.required = true, .doc = "equation of state"});
  return chosen < 0 ? nullptr : fluid_entries()[chosen].read(s);
}

}  // namespace titin
