#!/bin/sh
# SPDX-License-Identifier: Apache-2.0
# compiled_sweep.sh ARTICULA SWEEP FOLDER
#
# The rows of `sweep --compile` are those of `sweep`, but for what fused operations of lanes change:
# 1e-7 of a metric's size plus 1e-7 (tests/sweep/lanes_test.cpp). The second time nothing is compiled.
set -eu

articula=$1 sweep=$2 folder=$3
fail() { echo "$*" >&2; exit 1; }
mkdir -p "$folder"
"$articula" sweep "$sweep" --output "$folder/one_by_one"
"$articula" sweep "$sweep" --output "$folder/compiled" --compile 2>"$folder/log"
grep -q 'compiles the robot' "$folder/log" || fail "nothing was compiled"
"$articula" sweep "$sweep" --output "$folder/again" --compile 2>"$folder/log"
grep -q 'compiles the robot' "$folder/log" && fail "the library was not kept"
cmp "$folder/compiled/rows.csv" "$folder/again/rows.csv"
paste -d '\n' "$folder/one_by_one/rows.csv" "$folder/compiled/rows.csv" | awk -F, '
  NR % 2 == 1 { fields = split($0, one, ","); next }
  NF != fields { print "lines " NR " differ in length"; exit 1 }
  {
    for (k = 1; k <= NF; ++k) {
      if ($k == one[k]) continue;
      size = one[k] < 0 ? -one[k] : one[k];
      off = $k < one[k] ? one[k] - $k : $k - one[k];
      if (k <= 3 || (one[3] == "stable" && !(off <= 1e-7 * size + 1e-7))) {
        print "run " $1 ", column " k ": " one[k] " and " $k;
        exit 1;
      }
    }
  }'
lines=$(wc -l <"$folder/compiled/rows.csv")
[ "$lines" -gt 100 ] || fail "there are only $lines lines"
