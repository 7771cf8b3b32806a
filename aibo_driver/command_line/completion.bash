# Completes the commands and options of aibo in bash, as `aibo help` lists them.
_aibo() {
  local word=${COMP_WORDS[COMP_CWORD]} command='' each names words
  names=$("$1" help | sed -n 's/^  \([a-z][a-z-]*\) .*/\1/p')
  for each in "${COMP_WORDS[@]:1:COMP_CWORD-1}"; do
    grep -qxe "$each" <<< "$names" && { command=$each; break; }
  done
  words=$("$1" help ${command:+"$command"} | grep -o -- '--[a-z][a-z-]*' | sort -u)
  [[ $command != "" && $command != help ]] || words+=$'\n'$names
  mapfile -t COMPREPLY < <(compgen -W "$words" -- "$word")
}
complete -o default -F _aibo aibo
