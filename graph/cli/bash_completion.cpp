// The script that teaches bash the program's words: a table of commands from the parser's own, and one function.
#include <fmt/format.h>

#include "graph/cli/command_table.hpp"

namespace atrium::cli {
namespace {

constexpr const char* head = R"(# bash completion for atrium; made by `atrium generate bash-completion`, do not edit.
)";

constexpr const char* functions = R"bash(
# Completes a value of the kind $1 that begins with $2; node types and pipelines are asked from the program $3.
_atrium_value() {
  local IFS=$'\n'
  case $1 in
    folder) compopt -o filenames 2>/dev/null; COMPREPLY=($(compgen -d -- "$2")) ;;
    file) compopt -o filenames 2>/dev/null; COMPREPLY=($(compgen -f -- "$2")) ;;
    pipeline) compopt -o filenames 2>/dev/null
              COMPREPLY=($(compgen -f -- "$2"; compgen -W "$("$3" generate pipelines 2>/dev/null)" -- "$2")) ;;
    node_type) COMPREPLY=($(compgen -W "$("$3" generate node-types 2>/dev/null)" -- "$2")) ;;
    choice:*) local choices=${1#choice:}
              COMPREPLY=($(compgen -W "${choices//,/$'\n'}" -- "$2")) ;;
  esac
}

# Sets `kind` to what the value of the option $1 is; fails if it takes none.
_atrium_kind() {
  local entry
  for entry in "${values[@]}"; do
    [[ ${entry%%=*} == "$1" ]] && { kind=${entry#*=}; return 0; }
  done
  return 1
}

_atrium() {
  local program=$1 current=${COMP_WORDS[COMP_CWORD]} at=$COMP_CWORD target=
  COMPREPLY=()
  # What stands around "=" comes as words of their own: -s planes.type=plane.ransac, --out=runs.
  if [[ $current == "=" ]]; then
    current= at=$((at - 1)) target=${COMP_WORDS[COMP_CWORD - 1]}
  elif [[ ${COMP_WORDS[at - 1]} == "=" ]]; then
    at=$((at - 2)) target=${COMP_WORDS[COMP_CWORD - 2]}
  fi
  local commands options words path= place=0 kind= index word
  local -a values kinds
  _atrium_table ""
  for ((index = 1; index < at; ++index)); do
    word=${COMP_WORDS[index]}
    if [[ $word == -* ]]; then
      _atrium_kind "$word" && ((++index))
    elif [[ " $commands " == *" $word "* ]]; then
      path=${path:+$path }$word place=0
      _atrium_table "$path"
    else
      ((++place))
    fi
    # The value behind "=" belongs to what is before it.
    [[ ${COMP_WORDS[index + 1]-} == "=" ]] && ((index += 2))
  done
  kind=
  if [[ $target == -* ]]; then
    _atrium_kind "$target"
  elif _atrium_kind "${COMP_WORDS[at - 1]}"; then
    case $kind:$target in
      setting:*.type) kind=node_type ;;
      setting:*.pipeline) kind=pipeline ;;
      setting:?*) kind=file ;;
    esac
  elif [[ $current == -* ]]; then
    COMPREPLY=($(compgen -W "$options" -- "$current"))
    return 0
  elif [[ -n $commands ]]; then
    COMPREPLY=($(compgen -W "$commands" -- "$current"))
    return 0
  else
    kinds=($words)
    # The last word may be repeated.
    ((place >= ${#kinds[@]} && ${#kinds[@]} > 0)) && [[ ${kinds[-1]} == *+ ]] && place=$((${#kinds[@]} - 1))
    kind=${kinds[place]-}
  fi
  _atrium_value "${kind%+}" "$current" "$program"
  return 0
}

complete -F _atrium atrium
)bash";

std::string name_of(const CommandOption& option) {
  switch (option.kind) {
    case ValueKind::folder: return "folder";
    case ValueKind::file: return "file";
    case ValueKind::pipeline: return "pipeline";
    case ValueKind::setting: return "setting";
    case ValueKind::node_type: return "node_type";
    case ValueKind::choice: {
      std::string text = "choice:";
      for (const auto& choice : option.choices) text += (text.back() == ':' ? "" : ",") + choice;
      return text;
    }
    default: return "any";
  }
}

/// One branch of the table: what may follow the command.
std::string branch(const Command& command) {
  std::string commands, options, values, words;
  for (const auto& name : command.commands) commands += (commands.empty() ? "" : " ") + name;
  for (const auto& option : command.options) {
    for (const auto& name : option.names) {
      options += (options.empty() ? "" : " ") + name;
      if (option.kind != ValueKind::none) values += fmt::format(" {}={}", name, name_of(option));
    }
    if (option.names.empty()) words += (words.empty() ? "" : " ") + name_of(option) + (option.repeated ? "+" : "");
  }
  return fmt::format(
      "    \"{}\")\n      commands=\"{}\"\n      options=\"{}\"\n      values=({})\n      words=\"{}\" ;;\n",
      command.path, commands, options, values.empty() ? "" : values.substr(1), words);
}

}  // namespace

std::string bash_completion(const CLI::App& app) {
  std::string text = head;
  text +=
      "\n# Sets what may follow the command $1: commands, options, NAME=KIND of the options that take a value, and "
      "the\n"
      "# kinds of the words that stand by their place (with + if the last may be repeated).\n"
      "_atrium_table() {\n  case $1 in\n";
  for (const auto& command : commands_of(app)) text += branch(command);
  return text + "  esac\n}\n" + functions;
}

}  // namespace atrium::cli
