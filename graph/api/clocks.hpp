#pragma once
#include <cstdint>

namespace atrium {

double wall_seconds();            ///< since some fixed time
double thread_cpu_seconds();      ///< of the calling thread
double process_cpu_seconds();     ///< of all threads of the process
std::uint64_t peak_memory();      ///< highest resident memory of the process so far, bytes
std::uint64_t resident_memory();  ///< of the process now, bytes

/// Gives back to the system what the allocator keeps for later, where that is much. Thread-safe; milliseconds.
void give_back_memory();

/// Lets peak_memory() begin anew from what is resident now.
void reset_peak_memory();

}  // namespace atrium
