#include "modules/baseline/helper_program.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "graph/api/error.hpp"
#include "graph/api/helper_process.hpp"

namespace atrium::baseline {

std::filesystem::path helper_file(const std::string& name) {
  static const char anchor = 0;
  return folder_of_library(&anchor) / name;
}

HelperResult run_helper(const HelperProgram& helper, const Exchange& request, Context& context) {
  const std::filesystem::path file = helper_file(helper.name);
  std::error_code ignored;
  if (!std::filesystem::is_regular_file(file, ignored))
    throw Error(fmt::format("this build has no {} (looked for {})", helper.name, file.string()), helper.lacks);
  const HelperReply reply = run_helper_process(
      {helper.name, file, helper.seconds, helper.mebibytes, "raise 'time_limit', or give it fewer planes",
       "raise 'memory_limit', or give it fewer planes"},
      to_bytes(request), context);
  HelperResult result;
  result.seconds = reply.seconds;
  result.mebibytes = reply.mebibytes;
  try {
    result.reply = from_bytes(reply.bytes);
  } catch (const std::runtime_error& error) {
    throw Error(fmt::format("{} gave no reply that can be read: {}", helper.name, error.what()),
                "build and install the plugin and its helper together");
  }
  const std::string& text = result.reply.text;
  const std::size_t end = std::min(text.find('\n'), text.size());
  if (!text.empty()) throw Error(text.substr(0, end), text.substr(std::min(end + 1, text.size())));
  return result;
}

}  // namespace atrium::baseline
