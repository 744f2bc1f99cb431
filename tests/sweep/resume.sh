#!/bin/sh
# SPDX-License-Identifier: Apache-2.0
# resume.sh SWEEPER FOLDER [MPIRUN...]
#
# A sweep that SIGKILL ends goes on when it is started again, and has the same bits as one without
# interruption. With MPIRUN, ranks compute it, and one of them is killed. Its memory does not grow with
# the number of runs.
set -eu

sweeper=$1 folder=$2
shift 2
fail() { echo "$*" >&2; exit 1; }
rm -rf "$folder"
mkdir -p "$folder/whole" "$folder/other" "$folder/killed" "$folder/failed"

"$sweeper" "$folder/whole" 1
[ "$(wc -l <"$folder/whole/rows.csv")" -eq 3001 ] || fail "3000 runs do not have 3000 lines"
"$@" "$sweeper" "$folder/other" 3
cmp "$folder/whole/rows.csv" "$folder/other/rows.csv"
cmp "$folder/whole/checkpoint" "$folder/other/checkpoint"

if "$@" "$sweeper" "$folder/killed" 2 --kill 1500 2>"$folder/log"; then fail "it was not killed"; fi
[ -e "$folder/killed/killed" ] || fail "no process has killed itself"
cmp -s "$folder/whole/checkpoint" "$folder/killed/checkpoint" && fail "it was complete"
begun=$(sed -n 1p "$folder/killed/checkpoint" | awk '{ print $4 + $5 + $6 + $7 }')
[ "$begun" -ge 500 ] && [ "$begun" -le 1500 ] || fail "the checkpoint has $begun runs"
# What a crash may leave of a line.
printf '99,12' >>"$folder/killed/rows.csv"
"$@" "$sweeper" "$folder/killed" 2 --kill 1500
cmp "$folder/whole/rows.csv" "$folder/killed/rows.csv"
cmp "$folder/whole/checkpoint" "$folder/killed/checkpoint"

# A run that throws ends the sweep with one line that names it.
if "$@" "$sweeper" "$folder/failed" 2 --fail 2>"$folder/log"; then fail "the failure was lost"; fi
grep -q 'run 990 (rate .*): it fails' "$folder/log" || fail "no reason: $(cat "$folder/log")"

# Ranks do not wait for ever for rank 0, if an exception keeps it from the sweep.
if [ $# -gt 0 ]; then
  if "$@" "$sweeper" "$folder/failed" 2 --leave 2>"$folder/log"; then fail "rank 0 was there"; fi
  grep -q 'rank 0 ends by an exception' "$folder/log" || fail "no reason: $(cat "$folder/log")"
fi

# Another sweep does not go on from this one's checkpoint.
sed 's/checkpoint-2 [0-9]*/checkpoint-2 7/' "$folder/whole/checkpoint" >"$folder/other/checkpoint"
if "$sweeper" "$folder/other" 1 2>"$folder/log"; then fail "another sweep's checkpoint was used"; fi
grep -q 'belongs to another sweep' "$folder/log"
awk 'NR == 1 { $4 += 9 } { print }' "$folder/whole/checkpoint" >"$folder/other/checkpoint"
if "$sweeper" "$folder/other" 1 2>"$folder/log"; then fail "a checkpoint had too many runs"; fi
grep -q 'lines of runs' "$folder/log"
head -n 3 "$folder/whole/checkpoint" >"$folder/other/checkpoint"
if "$sweeper" "$folder/other" 1 2>"$folder/log"; then fail "half a checkpoint was used"; fi
grep -q 'not complete' "$folder/log"

# Memory does not grow with the number of runs. The rows of 200 000 runs would take more than 25 MB.
# A sanitizer keeps freed memory; here it keeps 1 MB.
peak() {
  rm -rf "$folder/memory"
  mkdir "$folder/memory"
  ASAN_OPTIONS="${ASAN_OPTIONS:-}:quarantine_size_mb=1" "$@" "$folder/memory" 2 --runs $runs |
    awk -v runs=$runs '$1 == runs && $2 == "runs" { print $3 }'
}
runs=1000
few=$(peak "$@" "$sweeper")
runs=200000
many=$(peak "$@" "$sweeper")
echo "peak memory: $few kB for 1000 runs, $many kB for 200 000 runs"
[ "$many" -lt $((few + 8000)) ] || fail "memory grows with the number of runs"
