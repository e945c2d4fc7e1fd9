#!/bin/sh
# readme.sh COMPILER INCLUDE README: the README's lines of C compile, around nothing but what they say is the renderer's.
set -eu
echo "protects: the first lines of C that people see"
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
{
    echo '#include <striae.h>'
    echo 'void lines(StriaePoint point, const float view[3], const float light[3], float f[3]);'
    echo 'void lines(StriaePoint point, const float view[3], const float light[3], float f[3]) {'
    awk '/^```c$/ { on = 1; next } /^```/ { on = 0 } on' "$3"
    echo '}'
} >"$work/lines.c"
grep -q striae_eval "$work/lines.c" || { echo "no lines of C in $3"; exit 1; }
"$1" -std=c11 -Wall -Wextra -Werror -fsyntax-only "-I$2" "$work/lines.c"
