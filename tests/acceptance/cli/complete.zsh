# Usage: complete.zsh SCRIPT LINE FILE. Writes the line, its last word completed, to the file.
zmodload zsh/zpty
zpty shell 'TERM=dumb zsh -f -i'
zpty -w shell "autoload -Uz compinit; compinit -u -D; source ${(q)1}"
zpty -w shell 'completed() { print -r -- "$BUFFER" > $OUT; exit }; zle -N completed; bindkey "^X" completed'
zpty -w shell "OUT=${(q)3}"
zpty -w -n shell "$2"$'\t\x18'
while zpty -r shell text; do :; done
