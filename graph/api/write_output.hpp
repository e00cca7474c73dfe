#pragma once
#include <string>
#include <string_view>

#include "graph/api/context.hpp"

namespace atrium {

/// Writes a file of the run's folder, whole or not at all, and tells the run that it is there. Throws Error.
inline void write_output(const Context& context, const std::string& relative, std::string_view text) {
  const auto path = context.output(relative);
  AtomicFile file(path);
  file.write(text);
  file.commit();
  context.wrote(path);
}

}  // namespace atrium
