/// A block that is stretched slowly: uniform, so that one cell is exact, and without inertia to speak of.
#pragma once

namespace titin {

inline constexpr const char* uniform_block = R"(
model = "muscle"
[mesh]
box = "20, 10, 10 mm"
cells = [4, 2, 2]
[time]
end = "1 s"
step = "50 ms"
scheme = "newmark"
[materials.gel]
density = "1000 kg/m^3"
volumetric = {law = "simo", bulk_modulus = "200 kPa"}
terms.matrix = {law = "neo_hookean", mu = "100 kPa"}
[boundary."x-"]
displacement.x = "0 mm"
[boundary."x+"]
displacement.x = {time = "0, 1 s", value = "0, 3 mm"}
[boundary."y-"]
displacement.y = "0 mm"
[boundary."z-"]
displacement.z = "0 mm"
)";

}  // namespace titin
