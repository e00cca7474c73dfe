#pragma once
#include <cstddef>
#include <exception>
#include <vector>

#include "graph/api/context.hpp"

namespace atrium::io {

/// Calls work(block) for each block side by side. Of several errors that of the first block is thrown, whatever the
/// threads do: it names the first bad place of a file.
template <class Work>
void for_blocks(const Context& context, std::size_t blocks, const Work& work) {
  std::vector<std::exception_ptr> errors(blocks);
  context.parallel_chunks(blocks, 1, [&](std::size_t block, std::size_t, std::size_t) {
    try {
      work(block);
    } catch (...) {
      errors[block] = std::current_exception();
    }
  });
  for (const auto& error : errors)
    if (error) std::rethrow_exception(error);
}

}  // namespace atrium::io
