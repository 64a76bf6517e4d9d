#compdef pounding
# Completion of pounding in zsh: commands and options as its --help lists them, names of laws, words of the input, and files.
_pounding() {
  local help
  local -a found
  if (( CURRENT == 2 )); then
    help=$($words[1] --help 2> /dev/null)
  elif [[ $words[2] == record ]] && (( CURRENT > 3 )); then
    help=$($words[1] record $words[3] --help 2> /dev/null)
  else
    help=$($words[1] $words[2] --help 2> /dev/null)
  fi
  if [[ $PREFIX == -* ]]; then
    found=(${(f)"$(sed -n '/^Options:/,/^$/ s/^  \(-[^ ]*\).*/\1/p' <<< $help | tr ',' '\n')"})
    compadd -a found
  elif [[ $words[CURRENT-1] == --law || $words[2] == laws ]]; then
    found=(${(f)"$($words[1] laws 2> /dev/null | sed -n 's/^\([a-z_]\+\)  .*/\1/p')"})
    compadd -a found
  elif [[ $words[2] == words ]]; then
    found=(${(fu)"$($words[1] words 2> /dev/null | sed -n 's/^ *\([A-Za-z_]\+\) .*/\1/p')"})
    compadd -a found
  else
    found=(${(f)"$(sed -n '/^Subcommands:/,/^$/ s/^  \([a-z]\+\)  *\(.*\)/\1:\2/p' <<< $help)"})
    (( $#found )) && _describe command found || _files
  fi
}
_pounding "$@"
