#!/bin/sh
# SPDX-License-Identifier: Apache-2.0
# check_rooms.sh ROOT
#
# The table of rooms in docs/design.md lists every folder of C++ files. A file includes only headers of
# its own room and of rooms above it in the table. No room has more than 18 files (.hpp and .cpp), nor
# has a folder of the tests, benchmarks, examples or programs.
set -eu

cd "$1"
rooms=$(sed -n '/^| room |/,/^$/p' docs/design.md | awk -F'|' 'NR > 2 && NF > 2 { gsub(/ /, "", $2); print $2 }')
cd include/articula
failed=0
known=' '
for room in $rooms; do
  known="$known$room "
  [ -d "$room" ] || { echo "docs/design.md: no such room: $room"; failed=1; continue; }
  files=$(find "$room" -maxdepth 1 -name '*.[hc]pp')
  count=$(echo "$files" | wc -l)
  [ "$count" -le 18 ] || { echo "$room: $count files, 18 are allowed"; failed=1; }
  for pair in $(sed -nE "s|^#include \"articula/(.*)/[^/]+\"|$room>\1|p" $files | sort -u); do
    case $known in
      *" ${pair#*>} "*) ;;
      *) echo "$room includes ${pair#*>}, which is not above it in docs/design.md"; failed=1 ;;
    esac
  done
done
for folder in $(find . -name '*.[hc]pp' -exec dirname {} + | sort -u | sed 's|^\./||'); do
  case "$known. " in
    *" $folder "*) ;;
    *) echo "docs/design.md: the table lacks the room $folder"; failed=1 ;;
  esac
done
cd ../..
for folder in $(find tests benchmarks examples cmake -name '*.[hc]pp' -exec dirname {} + | sort -u); do
  count=$(find "$folder" -maxdepth 1 -name '*.[hc]pp' | wc -l)
  [ "$count" -le 18 ] || { echo "$folder: $count files, 18 are allowed"; failed=1; }
done
echo "$(echo "$rooms" | wc -l) rooms checked"
[ "$failed" -eq 0 ]
