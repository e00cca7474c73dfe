#pragma once
#include <gtest/gtest.h>

#include <cstdlib>
#include <string>
#include <vector>

#include "tests/support/process.hpp"

namespace atrium::test {

/// Whether a check by other people's programs must not be skipped: ATRIUM_CHECK_ALL is set, as CI does.
inline bool must_check_all() {
  const char* value = std::getenv("ATRIUM_CHECK_ALL");  // NOLINT(concurrency-mt-unsafe): nobody sets it
  return value != nullptr && *value != '\0';
}

inline bool has_program(const std::string& name) {
  return run_process({"sh", "-c", "command -v \"$0\"", name}).exit_code == 0;
}

/// A Python that has a module, empty if there is none: Debian's own may not be the first on the path.
inline std::string python_with(const std::string& module) {
  for (const std::string candidate : {"python3", "/usr/bin/python3"})
    if (run_process({candidate, "-c", "import " + module}).exit_code == 0) return candidate;
  return {};
}

/// Runs tests/NAME, a program that has files checked by others' programs or rules. It ends with 77 where it cannot (see
/// ATRIUM_SKIP_LACKING).
inline ProcessResult run_validator(const std::string& name, std::vector<std::string> arguments) {
  arguments.insert(arguments.begin(), ATRIUM_SOURCE_DIR "/tests/" + name);
  return run_process(arguments);
}

}  // namespace atrium::test

/// Skips the rest of the test for want of what `why` says; where must_check_all(), the test fails.
#define ATRIUM_SKIP_LACKING(why)                                                        \
  do {                                                                                  \
    if (::atrium::test::must_check_all()) FAIL() << "ATRIUM_CHECK_ALL is set: " << why; \
    GTEST_SKIP() << why;                                                                \
  } while (false)
