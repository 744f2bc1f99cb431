#!/bin/sh
# SPDX-License-Identifier: Apache-2.0
# check_links.sh ROOT DOCUMENT...
#
# Every relative link in a document leads to a file that exists, and to a heading of that file if the
# link has a fragment.
set -eu

cd "$1"
shift
failed=0
checked=0

# The fragments of a document's headings, as GitHub makes them.
fragments_of() {
  sed '/^```/,/^```/d' "$1" | sed -n 's/^##* //p' | tr '[:upper:]' '[:lower:]' |
    sed 's/[^a-z0-9 _-]//g; s/ /-/g'
}

for document in "$@"; do
  links=$(sed '/^```/,/^```/d' "$document" | grep -oE '\]\([^)]*\)' | sed 's/^](//; s/)$//' |
    grep -vE '^https?:' | sort -u) || continue
  for link in $links; do
    checked=$((checked + 1))
    path=${link%%#*}
    file=$document
    [ -z "$path" ] || file=$(dirname "$document")/$path
    [ -e "$file" ] || { echo "$document: no such file: $link"; failed=1; continue; }
    case $link in
      *#*) fragments_of "$file" | grep -qxF -- "${link#*#}" ||
        { echo "$document: no such heading: $link"; failed=1; } ;;
    esac
  done
done
echo "$checked links checked"
[ "$checked" -gt 0 ] && [ "$failed" -eq 0 ]
