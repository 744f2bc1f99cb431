#!/bin/sh
# SPDX-License-Identifier: Apache-2.0
# check_named_files.sh ROOT DOCUMENT...
#
# Every file of the project that a document names exists: headers as #include or as rooms have them,
# sources, documents, scripts and folders of examples, tests and benchmarks.
set -eu

cd "$1"
shift
failed=0
checked=0
ending='hpp|cpp|md|sh|cmake|svg'
room='examples|tests|benchmarks|docs|cmake'
for document in "$@"; do
  # Code blocks have headers of the reader's own; the compiler checks theirs.
  names=$(sed '/^```/,/^```/d' "$document" |
    grep -oE "[A-Za-z0-9_./*-]+\.($ending)\b|($room)/[A-Za-z0-9_./*-]*[A-Za-z0-9_*]" | sort -u)
  for name in $names; do
    checked=$((checked + 1))
    found=no
    for folder in . include include/articula include/articula/* include/articula/*/* \
      include/articula/*/*/* docs tests tests/* tests/*/* examples benchmarks \
      benchmarks/results "$(dirname "$document")"; do
      # A name may have a * in it, or lack its ending.
      for file in "$folder"/$name "$folder"/$name.*; do
        [ -e "$file" ] && found=yes
      done
    done
    [ "$found" = yes ] || { echo "$document: no such file: $name"; failed=1; }
  done
done
echo "$checked names checked"
[ "$checked" -gt 0 ] && [ "$failed" -eq 0 ]
