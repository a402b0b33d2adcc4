# complete.zsh FOLDER LINE: what zsh offers at the end of a command line, a word a line, with the completions
# that are in the folder. An interactive zsh, on a terminal of its own, has a compadd that prints what it is
# given.
zmodload zsh/zpty

init=$(mktemp)
trap 'rm -f -- $init' EXIT
print -r -- "fpath=(${(q)1} \$fpath)" > $init
cat >> $init <<'END'
PROMPT=
autoload -Uz compinit
compinit -D -u
bindkey '^M' undefined
bindkey '^J' undefined
bindkey '^I' complete-word
zstyle ':completion:*' insert-tab false
mark() { print -r -- '<mark>' }
compprefuncs=(mark)
comppostfuncs=(mark exit)
compadd() {
  if [[ ${@[1,(i)(-|--)]} == *-(O|A|D)\ * ]]; then
    builtin compadd "$@"
    return
  fi
  local -a found
  builtin compadd -A found "$@"
  [[ -z $found ]] || print -rl -- $found
  builtin compadd "$@"
}
print -r -- '<ready>'
END

zpty inner zsh -f -i
zpty -w inner "source ${(q)init}"
repeat 20; do
  zpty -r inner line || exit 1
  [[ $line == '<ready>'* ]] && break
done
zpty -w inner "$2"$'\t'
marks=0
while zpty -r inner line; do
  line=${line%$'\r\n'}
  if [[ $line == *'<mark>' ]]; then
    ((++marks == 2)) && exit 0
  elif ((marks)); then
    print -r -- "$line"
  fi
done
