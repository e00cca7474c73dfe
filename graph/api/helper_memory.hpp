#pragma once
#include <cstdint>

namespace atrium {

/// A node that lets a program compute for it tells here how much resident memory that program needed at most, in bytes,
/// on the thread on which the node itself runs. The run adds the highest of them to the node's peak.
void note_helper_memory(std::uint64_t bytes);

/// The highest that was noted on this thread since the last call; for the runner.
std::uint64_t take_helper_memory();

}  // namespace atrium
