/// How much memory is left on the machine.
#pragma once

namespace titin {

/// What all ranks together may still take [bytes]: of each machine what its kernel calls available, or what the control
/// group (a batch system's limit) leaves, if that is less. Infinite where neither is known. Collective.
double available_memory();

}  // namespace titin
