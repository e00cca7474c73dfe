#pragma once
#include <string>
#include <vector>

namespace CLI {
class App;
}

namespace atrium::cli {

/// What the value of an option, or a word without one, is.
enum class ValueKind { none, any, file, folder, pipeline, setting, node_type, choice };

/// One option or positional word of a command, read from the parser's own tables.
struct CommandOption {
  std::vector<std::string> names;    ///< "-j", "--threads"; empty: a word that stands by its place
  std::string value;                 ///< "DIR"; what the word is called; empty for a flag
  std::string limits;                ///< "INT in [1 - 1024]"; empty: none
  std::vector<std::string> choices;  ///< the only values
  std::string default_value;         ///< empty: none, or the text says it
  std::string text;
  bool required = false, repeated = false;
  ValueKind kind = ValueKind::none;
};

/// A command: "" (the program itself), "run", "sweep plan".
struct Command {
  std::string path, text;
  std::vector<CommandOption> options;  ///< those with names, then the words, in their order
  std::vector<std::string> commands;   ///< one of them must follow
};

/// The program and all its commands, depth first. Commands of an empty group (CLI11's way to hide them) are left out.
std::vector<Command> commands_of(const CLI::App& app);

/// The hidden command `generate`, whose callback reads `app` again.
void add_generate(CLI::App& app);

/// The manual page, section 1 (roff, with the macros of man(7)).
std::string manual_page(const CLI::App& app);
/// What share/packages/completion.bash completes: the function _atrium_table of bash.
std::string bash_completion(const CLI::App& app);

}  // namespace atrium::cli
