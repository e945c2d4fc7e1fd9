#!/bin/sh
# exported_symbols.sh LIBRARY HEADER SONAME: the shared library exports exactly the functions that the header
# declares, all of them named striae_*, and carries its SONAME.
set -eu
library=$1 header=$2 soname=$3
echo "protects: nothing but the header's functions is exported"
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT

nm -D --defined-only "$library" | awk '{print $3}' | sed 's/@.*//' | sort -u >"$work/exported"
# A declaration's name stands before its parenthesis; comments are dropped first.
sed 's://.*::' "$header" | tr '\n' ' ' | sed 's:/\*[^*]*\*\+\([^/*][^*]*\*\+\)*/: :g' |
    grep -oE 'striae_[a-z0-9_]+ *\(' | tr -d ' (' | sort -u >"$work/declared"

status=0
if ! diff "$work/declared" "$work/exported" >"$work/difference"; then
    echo "declared (<) and exported (>) differ:"
    cat "$work/difference"
    status=1
fi
echo "$(wc -l <"$work/declared") functions declared, $(wc -l <"$work/exported") symbols exported"
[ -s "$work/exported" ] || status=1
echo "protects: the SONAME"
readelf -d "$library" | grep -F "[$soname]" || { echo "no SONAME $soname"; status=1; }
exit $status
