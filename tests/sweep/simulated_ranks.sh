#!/bin/sh
# SPDX-License-Identifier: Apache-2.0
# simulated_ranks.sh RUN FOLDER
#
# Thousands of ranks of a simulated cluster give the bits that 64 give. The protocol leaves 64 ranks an
# efficiency of 95 %. Without the computations of this machine, which other programs slow down.
set -eu

run=$1 folder=$2
mkdir -p "$folder"
"$run" "$folder" --cfg=smpi/simulate-computation:no -- 64:1:100 127:1:50 2101:1:3 >"$folder/log"
cat "$folder/log"
[ "$(grep -c '403200 runs' "$folder/log")" -eq 3 ] || { echo "runs are missing" >&2; exit 1; }
means=$(sed 's/.*mean/mean/' "$folder/log" | sort -u | wc -l)
[ "$means" -eq 1 ] || { echo "the bits depend on the number of ranks" >&2; exit 1; }
awk '/^64 ranks/ { sub(",", "", $8); good = $8 >= 0.95 } END { exit !good }' "$folder/log" ||
  { echo "64 ranks are not efficient" >&2; exit 1; }
