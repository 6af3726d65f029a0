/// What a core gets out of memory: the triad a = b + s c of STREAM (McCalpin 1995), on arrays larger than caches.
#pragma once

namespace titin {

/// Bytes per CPU-second of this rank, the best of a few passes: 24 a number, the store's own load not counted, as
/// STREAM does. Takes some hundredths of a second and 48 MB for as long.
double triad_bandwidth();

}  // namespace titin
