# Usage: complete.bash SCRIPT LINE. Prints what bash offers for the last word of the line.
source "$1"
COMP_LINE=$2
COMP_POINT=${#2}
# Only a completion that readline has called may set its options.
compopt() { :; }
_sonoglide
printf '%s\n' "${COMPREPLY[@]}"
