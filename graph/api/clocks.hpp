#pragma once
#include <cstdint>

namespace atrium {

double wall_seconds();            ///< since some fixed time
double thread_cpu_seconds();      ///< of the calling thread
double process_cpu_seconds();     ///< of all threads of the process
std::uint64_t peak_memory();      ///< highest resident memory of the process so far, bytes
std::uint64_t resident_memory();  ///< of the process now, bytes

/// Lets peak_memory() begin anew from what is resident now.
void reset_peak_memory();

}  // namespace atrium
