#!/bin/sh
# SPDX-License-Identifier: Apache-2.0
# check_named_tests.sh ROOT DOCUMENT...
#
# Every row of a table whose last column is called "test" names, in quotes, a part of the name of a test
# case or section that exists in ROOT/tests.
set -eu

root=$1
shift
# A name may stand in the line after its macro.
names=$(grep -rhE -A1 --include='*.cpp' '(TEST_CASE|SECTION)\(' "$root/tests")
failed=0
checked=0
for document in "$@"; do
  rows=$(awk -F'|' '
    !/^\|/ { in_table = 0; next }
    { cell = $(NF - 1); gsub(/^ +| +$/, "", cell) }
    !in_table { in_table = 1; wanted = cell == "test"; next }
    wanted && cell !~ /^-+$/ { print cell }' "$root/$document")
  while IFS= read -r row; do
    [ -n "$row" ] || { echo "$document: a row names no test"; failed=1; continue; }
    quoted=$(printf '%s\n' "$row" | grep -o '"[^"]*"' | tr -d '"') ||
      { echo "$document: no test in quotes: $row"; failed=1; continue; }
    while IFS= read -r name; do
      checked=$((checked + 1))
      printf '%s\n' "$names" | grep -qF -- "$name" || { echo "$document: no such test: $name"; failed=1; }
    done <<EOF
$quoted
EOF
  done <<EOF
$rows
EOF
done
echo "$checked names checked"
[ "$checked" -gt 0 ] && [ "$failed" -eq 0 ]
