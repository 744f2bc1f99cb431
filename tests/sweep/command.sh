#!/bin/sh
# SPDX-License-Identifier: Apache-2.0
# command.sh ARTICULA SOURCE FOLDER [MPIRUN...]
#
# articula sweep: the same files from threads, from ranks and after an interruption; and one line with
# file, line and what was expected for each fault of a YAML file.
set -eu

articula=$1 source=$2 folder=$3
shift 3
fail() { echo "$*" >&2; exit 1; }
rm -rf "$folder"
mkdir -p "$folder"
cp "$source/examples/q2d/q2d.urdf" "$source/examples/pid_plus_gravity.yaml" "$folder"
cat >"$folder/good.yaml" <<'YAML'
robot: q2d.urdf
controllers: pid_plus_gravity.yaml
experiment:
  duration: 0.3
  target: {shoulder_active_joint: 0.5, elbow_active_joint: -0.5}
  disturbances: {elbow_active_joint: {type: step, height: 0.5, start: 0.1}}
vary:
  - {quantity: mass, link: elbow_passive_link, low: 0.5, high: 2}
  - {quantity: delay, low: 0, high: 0.003}
sampling: {method: latin_hypercube, runs: 300, seed: 5}
specifications: {elbow_active_joint.tracking_rms: 0.2}
worst: {metric: elbow_active_joint.tracking_rms, count: 3}
plots:
  histograms: [elbow_active_joint.overshoot]
  maps: [[mass.elbow_passive_link, delay]]
YAML

"$articula" sweep "$folder/good.yaml" --threads 1 >"$folder/table"
grep -q '^300 runs: 300 stable' "$folder/table" || fail "no table: $(cat "$folder/table")"
grep -q 'elbow_active_joint.settling_time *s *0' "$folder/table"
rows=$folder/good_results/rows.csv
[ "$(wc -l <"$rows")" -eq 301 ] || fail "300 runs do not have 300 lines"
grep -qF "set ylabel 'delay [s]'" "$folder/good_results/plot_2.gp" || fail "no plot with its unit"
if command -v gnuplot >/dev/null; then
  [ -s "$folder/good_results/plot_1.svg" ] && [ -s "$folder/good_results/plot_2.svg" ] ||
    fail "gnuplot has drawn nothing"
fi
"$articula" sweep "$folder/good.yaml" --output "$folder/threads" --threads 3 --chunk 7 >"$folder/log"
cmp "$rows" "$folder/threads/rows.csv"
[ ! -e "$folder/threads/rows.h5" ] || cmp "${rows%.csv}.h5" "$folder/threads/rows.h5"
if [ $# -gt 0 ]; then
  "$@" "$articula" sweep "$folder/good.yaml" --output "$folder/ranks" --chunk 11 >"$folder/log"
  cmp "$rows" "$folder/ranks/rows.csv"
  cmp "$folder/good_results/checkpoint" "$folder/ranks/checkpoint"
fi
# Ranks with other files than rank 0 are refused by the first of them.
if [ $# -gt 0 ]; then
  for rank in 0 1 2; do
    mkdir -p "$folder/of_rank_$rank"
    cp "$folder/good.yaml" "$folder/q2d.urdf" "$folder/pid_plus_gravity.yaml" "$folder/of_rank_$rank"
  done
  sed -i 's/duration: 0.3/duration: 0.2/' "$folder/of_rank_2/good.yaml"
  if "$@" sh -c "'$articula' sweep '$folder'/of_rank_\$OMPI_COMM_WORLD_RANK/good.yaml --output '$folder/mixed'" \
    >"$folder/log" 2>&1; then fail "ranks had different sweeps"; fi
  grep -q 'rank 2 has another sweep than rank 0' "$folder/log" || fail "$(cat "$folder/log")"
fi
# Names are a part of gnuplot's commands and of the header of the CSV.
mkdir -p "$folder/names"
for file in good.yaml q2d.urdf pid_plus_gravity.yaml; do
  sed 's/elbow_active_joint/elbow`touch pwned`/g' "$folder/$file" >"$folder/names/$file"
done
if "$articula" sweep "$folder/names/good.yaml" >"$folder/log" 2>&1; then fail "a name was accepted"; fi
grep -q 'quotation mark' "$folder/log" || fail "$(cat "$folder/log")"
# A complete sweep goes on with nothing and says the same; another one has no right to the folder.
"$articula" sweep "$folder/good.yaml" --threads 1 >"$folder/again"
cmp "$folder/table" "$folder/again"
# So does one with other plots, quantiles and comments.
{ echo '# a comment'; sed 's/\[elbow_active_joint.overshoot\]/[energy]/' "$folder/good.yaml"; echo 'quantiles: [0.5]'; } \
  >"$folder/plots.yaml"
"$articula" sweep "$folder/plots.yaml" --output "$folder/good_results" >"$folder/again"
cmp "$rows" "$folder/threads/rows.csv"
grep -q energy "$folder/good_results/plot_1.gp" || fail "the plot is not another one"
# One process at a time has the folder.
if command -v flock >/dev/null; then
  if flock "$folder/good_results/lock" "$articula" sweep "$folder/good.yaml" 2>"$folder/log"; then
    fail "two processes have a folder"
  fi
  grep -q 'another process works in this folder' "$folder/log" || fail "$(cat "$folder/log")"
fi
# Processes that a launcher of another MPI starts would all be rank 0.
if [ $# -gt 0 ]; then
  if PMI_RANK=0 PMI_SIZE=4 "$articula" sweep "$folder/good.yaml" 2>"$folder/log"; then
    fail "the launcher's processes do not know each other"
  fi
  grep -q 'PMI_SIZE is 4' "$folder/log" || fail "$(cat "$folder/log")"
fi
sed 's/seed: 5/seed: 6/' "$folder/good.yaml" >"$folder/other.yaml"
if "$articula" sweep "$folder/other.yaml" --output "$folder/threads" 2>"$folder/log"; then
  fail "another sweep used the checkpoint"
fi
grep -q 'belongs to another sweep' "$folder/log"
"$articula" sweep "$folder/other.yaml" --output "$folder/threads" --fresh >"$folder/log"
cmp -s "$rows" "$folder/threads/rows.csv" && fail "another seed gave the same rows"

# refused <sed expression> <message>: one line, status 1.
refused() {
  sed "$1" "$folder/good.yaml" >"$folder/bad.yaml"
  status=0
  "$articula" sweep "$folder/bad.yaml" >"$folder/log" 2>&1 || status=$?
  [ $status -eq 1 ] && [ "$(wc -l <"$folder/log")" -eq 1 ] && grep -q -- "$2" "$folder/log" ||
    fail "$1: expected '$2', got status $status: $(cat "$folder/log")"
}
# A search finds better gains than those of the file, names them, and sweeps with them.
cat >>"$folder/other.yaml" <<'YAML'
search:
  minimise: elbow_active_joint.steady_error
  evaluations: 20
  over: [{quantity: proportional, low: 0.2, high: 5, spacing: logarithmic}]
YAML
sed -i 's/runs: 300/runs: 24/' "$folder/other.yaml"
if "$articula" --json sweep "$folder/other.yaml" --output "$folder/search" >"$folder/found"; then
  grep -Eq '"evaluations":(1[0-9]|20),' "$folder/found" || fail "no search: $(cat "$folder/found")"
  "$articula" sweep "$folder/other.yaml" --output "$folder/search" --fresh | sed -n 1p >"$folder/line"
  grep -q 'at the quantile 0.95 is [0-9.e-]* rad after' "$folder/line" || fail "$(cat "$folder/line")"
  # The sweep has other arms than the search.
  judged=$(sed 's/.*"name":"elbow_active_joint.steady_error"[^{]*{[^}]*"0.95":\([0-9.e-]*\).*/\1/' "$folder/found")
  gain=$(sed 's/.*"proportional":\([0-9.]*\).*/\1/' "$folder/found")
  cost=$(sed 's/.*"cost":\([0-9.e-]*\).*/\1/' "$folder/found")
  [ "$judged" != "$cost" ] || fail "the sweep judges the search by its own arms: $cost"
  head -n 1 "$folder/search/rows.csv" | grep -q proportional || fail "the sweep lacks what was found"
  sed "s/over: .*/over: [{quantity: proportional, low: 1, high: 1}]/" "$folder/other.yaml" >"$folder/one.yaml"
  "$articula" --json sweep "$folder/one.yaml" --output "$folder/one" >"$folder/known"
  known=$(sed 's/.*"cost":\([0-9.e-]*\).*/\1/' "$folder/known")
  awk "BEGIN { exit !($cost < $known && $gain > 0.2 && $gain < 5) }" ||
    fail "the gains of the file have $known, those that were found ($gain) $cost"
else
  grep -q 'without NLopt' "$folder/found" || fail "no search: $(cat "$folder/found")"
fi

refused 's/robot: .*//' "bad.yaml:.*'robot' is missing, expected it in this map$"
refused 's/low: 0.5/levels: 3, low: 0.5/' 'bad.yaml:8:.*only a grid has levels'
refused 's/robot: .*/robot: no.urdf/' 'no.urdf'
refused 's/^controllers: .*/&\ncontroller: pidd/' "bad.yaml:3:.*has no controller 'pidd', expected one of pid_plus_gravity"
refused 's/elbow_passive_link, low/elbow_pasive_link, low/' "bad.yaml:8:.*expected.*'elbow_passive_link'"
refused 's/elbow_passive_link, low/base_link, low/' 'does not move'
refused 's/quantity: mass/quantity: mas/' "bad.yaml:8:.*'mas'.*expected.*mass"
refused 's/quantity: delay/quantity: delay, joint: elbow_active_joint/' 'bad.yaml:9:.*no joint'
refused 's/low: 0.5/low: -1/' 'bad.yaml:8:.*range -1 .. 2'
refused 's/low: 0.5/low: 3/' 'bad.yaml:8:.*above its high end'
refused 's/low: 0.5/low: .nan/' 'bad.yaml:8:.*expected a number'
refused 's/high: 2}/high: 2, spacing: log}/' "bad.yaml:8:.*'log'"
refused 's/runs: 300/runs: 1e99/' 'bad.yaml:10:.*whole number'
refused 's/method: latin_hypercube/method: grid/' 'bad.yaml:10:.*levels of a grid'
refused 's/target: {shoulder_active_joint: 0.5/target: {shoulder: 0.5/' 'bad.yaml:5:.*shoulder_active_joint'
refused 's/target: {shoulder_active_joint: 0.5/target: {shoulder_active_joint: 5/' 'bad.yaml:5:.*within the joint'
refused 's/duration: 0.3/duration: 1e9/' 'bad.yaml:4:.*1 000 000 periods'
refused 's/tracking_rms: 0.2/speed: 0.2/' "bad.yaml:11:.*no metric 'elbow_active_joint.speed'"
refused 's/\[elbow_active_joint.overshoot\]/[height]/' "bad.yaml:14:.*no column 'height'"
refused 's/height: 0.5/height: many/' 'bad.yaml:6:.*a number'
refused 's/quantity: delay, low: 0, high: 0.003/quantity: damping, low: 1, high: 1e5/' 'damping 100000: simulator'
refused 's/^sampling/samplings/' "bad.yaml:10:.*unknown key 'samplings'"
