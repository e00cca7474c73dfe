#pragma once
#include <string>
#include <string_view>
#include <vector>

/// Texts that are of a form of their own (the name of a coordinate reference system), checked before anything runs.
namespace atrium {

/// What a text parameter of a node type must be: `check` throws Error, whose message says what is wrong and whose help
/// says what would be right.
struct TextCheck {
  std::string_view type, param;
  void (*check)(const std::string& text);
};

/// Checks the value of a parameter by what the plugin of its node type says of it, if anything. Throws Error.
void check_text(const std::string& type, const std::string& param, const std::string& text);

}  // namespace atrium

/// Used at most once per plugin, in a file of its own: ATRIUM_TEXT_CHECKS({Node::type, "param", check}, …)
#define ATRIUM_TEXT_CHECKS(...)                                                     \
  extern "C" __attribute__((visibility("default"))) void atrium_plugin_text_checks( \
      std::vector<atrium::TextCheck>& checks) {                                     \
    checks = {__VA_ARGS__};                                                         \
  }
