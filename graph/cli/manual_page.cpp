// The manual page: commands and options from the parser's tables, exit codes from theirs.
#include <fmt/format.h>

#include "graph/cli/command_table.hpp"

namespace atrium::cli {
namespace {

/// A text as roff prints it as it is: '-' as a minus sign, which can be copied to a shell; `literal`: "'" too.
std::string roff(std::string_view text, bool literal = false) {
  std::string result;
  for (const char c : text) {
    if (c == '\\')
      result += "\\e";
    else if (c == '-')
      result += "\\-";
    else if (c == '\'' && literal)
      result += "\\(aq";
    else if (c == '`')
      result += "\\(ga";
    else if (c == '\n')
      result += ' ';
    else
      result += c;
  }
  const bool is_request = result.starts_with('.') || result.starts_with('\'');
  return is_request ? "\\&" + result : result;
}

std::string bold(std::string_view text) { return "\\fB" + roff(text, true) + "\\fR"; }
std::string italic(std::string_view text) { return "\\fI" + roff(text, true) + "\\fR"; }

std::string sentence(const std::string& text) {
  if (text.empty()) return "";
  std::string result = text;
  if (result.front() >= 'a' && result.front() <= 'z') result.front() = static_cast<char>(result.front() - 'a' + 'A');
  if (result.back() != '.') result += '.';
  return result;
}

std::string synopsis(const Command& command) {
  std::string line = bold(command.path.empty() ? "atrium" : "atrium " + command.path);
  bool optional = false;
  for (const auto& option : command.options) {
    if (option.names.empty()) continue;
    if (option.required)
      line += " " + bold(option.names.back()) + " " + italic(option.value);
    else
      optional = true;
  }
  if (optional) line += " [" + italic("OPTION") + "]...";
  if (!command.commands.empty()) line += " " + italic("COMMAND");
  for (const auto& word : command.options) {
    if (!word.names.empty()) continue;
    const std::string name = italic(word.value) + (word.repeated ? "..." : "");
    line += word.required ? " " + name : " [" + name + "]";
  }
  return line;
}

std::string entry(const CommandOption& option) {
  std::string head;
  for (const auto& name : option.names) head += (head.empty() ? "" : ", ") + bold(name);
  if (!option.value.empty()) head += (head.empty() ? "" : " ") + italic(option.value);
  std::string text = roff(sentence(option.text));
  const auto add = [&](const std::string& more) { text += (text.empty() ? "" : "\n") + more; };
  if (!option.choices.empty()) {
    std::string list;
    for (const auto& choice : option.choices) list += (list.empty() ? "" : ", ") + bold(choice);
    add("One of: " + list + ".");
  }
  if (!option.limits.empty()) add(roff("Value: " + option.limits + "."));
  if (!option.default_value.empty()) add("Default: " + bold(option.default_value) + ".");
  if (option.required && !option.names.empty()) add("Required.");
  return fmt::format(".TP\n{}\n{}\n", head, text.empty() ? "\\&" : text);
}

std::string section(const Command& command) {
  std::string text = command.path.empty() ? ".SH OPTIONS\n" : fmt::format(".SS \"atrium {}\"\n", command.path);
  if (!command.path.empty()) text += synopsis(command) + "\n.PP\n" + roff(sentence(command.text)) + "\n";
  for (const auto& option : command.options)
    if (option.names.empty()) text += entry(option);
  for (const auto& option : command.options)
    if (!option.names.empty() && (command.path.empty() || option.names.back() != "--help")) text += entry(option);
  return text;
}

struct Term {
  std::string name, text;
};
std::string rows(std::string_view title, const std::vector<Term>& list) {
  std::string text = fmt::format(".SH {}\n", title);
  for (const auto& row : list) text += fmt::format(".TP\n{}\n{}\n", bold(row.name), roff(row.text));
  return text;
}

}  // namespace

std::string manual_page(const CLI::App& app) {
  const auto commands = commands_of(app);
  std::string text = fmt::format(
      ".\\\" Made by `atrium generate man`; do not edit.\n"
      ".TH ATRIUM 1 \"\" \"atrium {}\" \"User Commands\"\n"
      ".SH NAME\natrium \\- light planar models of buildings from indoor point clouds\n.SH SYNOPSIS\n",
      ATRIUM_VERSION);
  for (const auto& command : commands)
    if (command.commands.empty()) text += (&command == &commands[1] ? "" : ".br\n") + synopsis(command) + "\n";
  text += ".SH DESCRIPTION\n" + roff(commands.front().text) +
          "\n.PP\nResults go to standard output; progress, warnings and errors go to standard error.\n"
          "A pipeline or sweep that is not found by its path is looked for among those that are installed, so\n" +
          bold("atrium run atrium.yaml") + "\nworks from any folder. A file of that name in the working folder wins.\n";
  text += section(commands.front()) + ".SH COMMANDS\n";
  for (const auto& command : commands)
    if (!command.path.empty()) text += section(command);
  text += rows("EXIT STATUS", {{"0", "It is done."},
                               {"1", "A node failed, or a file could not be written."},
                               {"2", "The command was used wrongly."},
                               {"3", "A pipeline or sweep is invalid; nothing was run."},
                               {"4", "Some variants of a sweep failed."},
                               {"5", "A plugin cannot be loaded."},
                               {"130, 143", "The program was ended by SIGINT or SIGTERM; what was done is kept."}});
  text +=
      rows("ENVIRONMENT",
           {{"ATRIUM_CACHE", "The folder of what earlier runs computed; off: there is none."},
            {"ATRIUM_PLUGIN_PATH", "Folders with plugins, separated by ':'; they are looked at before Atrium's own."}});
  text += rows("FILES", {{"PREFIX/share/atrium/pipelines", "The installed pipelines; PREFIX is /usr for a package."},
                         {"PREFIX/share/atrium/schema", "JSON schemas of pipeline files and of building.json."}});
  text += rows("EXAMPLES", {{"atrium run simulate.yaml --out scan", "Simulates the scan of a flat."},
                            {"atrium run atrium.yaml -s scan=scan/scan.ply --out model", "Makes a model of it."},
                            {"atrium nodes plane.ransac", "Explains a node type: ports, parameters, units, limits."}});
  return text;
}

}  // namespace atrium::cli
