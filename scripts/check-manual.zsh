# Prints what zsh makes of a line and a tab:
#   zsh -f scripts/check-manual.zsh FOLDER_OF_COMPLETIONS LINE
zmodload zsh/zpty
zpty shell zsh -f -i
zpty -w shell "PS1='> '; setopt interactivecomments; fpath=($1 \$fpath); autoload -Uz compinit; compinit -D -u; print rea''dy"
# The line editor reads keys once it has asked the terminal to mark pasted text.
zpty -r shell seen $'*ready*\e\\[?2004h*'
zpty -n -w shell "$2"$'\t'
# A # at the beginning makes the line a comment, and has the shell show all of it.
zpty -n -w shell $'\C-a#\C-j'
zpty -w shell "print do''ne"
zpty -r shell seen '*done*'
print -r -- $seen
zpty -d shell
