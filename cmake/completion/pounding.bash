# Completion of pounding in bash: commands and options as its --help lists them, names of laws, words of the input, and files.
_pounding() {
  local program=${COMP_WORDS[0]} word=${COMP_WORDS[COMP_CWORD]} before=${COMP_WORDS[COMP_CWORD - 1]}
  local -a commands=()
  local i
  for ((i = 1; i < COMP_CWORD; ++i)); do
    [[ ${COMP_WORDS[i]} == -* ]] && break
    commands+=("${COMP_WORDS[i]}")
  done
  COMPREPLY=()
  if [[ $before == --law || ${commands[*]} == laws ]] && [[ $word != -* ]]; then
    mapfile -t COMPREPLY < <(compgen -W "$("$program" laws 2> /dev/null | sed -n 's/^\([a-z_]\+\)  .*/\1/p')" -- "$word")
    return
  fi
  if [[ ${commands[*]} == words && $word != -* ]]; then
    mapfile -t COMPREPLY < <(compgen -W "$("$program" words 2> /dev/null | sed -n 's/^ *\([A-Za-z_]\+\) .*/\1/p' | sort -u)" -- "$word")
    return
  fi
  local help
  case ${commands[0]-} in
    '') help=$("$program" --help 2> /dev/null) ;;
    record) help=$("$program" "${commands[@]:0:2}" --help 2> /dev/null) ;;
    *) help=$("$program" "${commands[0]}" --help 2> /dev/null) ;;
  esac
  if [[ $word == -* ]]; then
    mapfile -t COMPREPLY < <(compgen -W "$(sed -n '/^Options:/,/^$/ s/^  \(-[^ ]*\).*/\1/p' <<< "$help" | tr ',' '\n')" -- "$word")
  else
    mapfile -t COMPREPLY < <(compgen -W "$(sed -n '/^Subcommands:/,/^$/ s/^  \([a-z]\+\) .*/\1/p' <<< "$help")" -- "$word")
  fi
}
complete -o default -F _pounding pounding
