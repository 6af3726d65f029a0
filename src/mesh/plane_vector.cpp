#include "mesh/plane_vector.hpp"

#include <algorithm>

#include "base/words.hpp"

namespace titin {

void read_vector(Section& s, std::string_view name, std::array<double, 3>& value, Key key, const NamedMesh& mesh) {
  if (s.describing() || (mesh.mesh && mesh.mesh->Dimension() == 3)) return s.read(name, value, key);
  std::vector<double> list(value.begin(), value.begin() + 2);
  s.read(name, list, key);
  if (mesh.mesh && list.size() != 2)
    s.error(name, "has " + count(list.size(), "number") + ", and the body is plane", "give two, x and y");
  if (!s.has(name)) return;
  value = {0, 0, 0};
  std::copy_n(list.begin(), std::min<std::size_t>(list.size(), 3), value.begin());
}

}  // namespace titin
