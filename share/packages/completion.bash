# shellcheck shell=bash disable=SC2206,SC2207,SC2209,SC1007
# bash completion for atrium. Behind it stands the table of commands that `atrium generate bash-completion` prints: a function
# _atrium_table, which sets what may follow the command $1 (commands, options, NAME=KIND of the options that take a value, and
# the kinds of the words that stand by their place, with + if the last may be repeated).

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
