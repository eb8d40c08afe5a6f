# Usage: complete.zsh SHELL LINE FILE. Types the line and a tab in bash or zsh, which has read its
# script from ./SHELL, and writes the line that is then there to the file.
zmodload zsh/zpty
export OUT=$3 TERM=dumb
if [[ $1 == bash ]]; then
  zpty shell 'bash --norc --noprofile -i'
  zpty -w shell 'completed() { printf "%s\n" "$READLINE_LINE" >"$OUT"; exit; }'
  zpty -w shell 'source ./bash; bind -x "\"\C-t\": completed"'
else
  zpty shell 'zsh -f -i'
  zpty -w shell 'completed() { print -r -- "$BUFFER" >$OUT; exit }; zle -N completed'
  zpty -w shell 'autoload -Uz compinit; compinit -u -d ./compdump; source ./zsh; bindkey "^T" completed'
fi
zpty -w -n shell "$2"$'\t\x14'
while zpty -r shell text; do :; done
