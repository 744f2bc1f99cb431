#!/usr/bin/env bash
# SPDX-License-Identifier: Apache-2.0
# Makes results/peers.md and results/peers.svg of results/peers.json, or of another file's figures:
#
#   benchmarks/run.sh peers                                              # runs this at its end
#   benchmarks/peers/table.sh [<figures.json> [<folder for table and plot>]]
set -euo pipefail
cd "$(dirname "$0")/.."
json=${1:-results/peers.json}
folder=${2:-results}

# <operation> <robot> <library> <median in ns>, one case a line.
cases=$(awk -F '"' '
  $2 == "run_name" { name = $4 }
  $2 == "aggregate_name" { aggregate = $4 }
  $2 == "cpu_time" && aggregate == "median" && name !~ /after_sleep/ {
    split(name, part, "/")
    sub(/^: /, "", $3); sub(/,$/, "", $3)
    print part[1], part[2], part[3], $3
  }' "$json")
cases=$(
  for robot in q2d ur10 panda pr2; do
    for operation in inverse_dynamics gravity mass_matrix forward_dynamics step \
                     forward_kinematics jacobian; do
      grep "^$operation $robot " <<<"$cases" || true
    done
  done
)
# The same for calls after a sleep: <operation> <robot> <library> <median and 99th percentile>.
slept=$(awk -F '"' '
  $2 == "run_name" { name = $4 }
  $2 == "aggregate_name" { aggregate = $4 }
  name ~ /after_sleep/ && aggregate == "median" && ($2 == "p50_ns" || $2 == "p99_ns") {
    split(name, part, "/")
    sub(/^: /, "", $3); sub(/,$/, "", $3)
    key = part[1] " " part[2] " " part[3]
    if (!(key in seen)) { seen[key] = 1; order[++n] = key }
    time[key, $2] = $3
  }
  END { for (i = 1; i <= n; ++i) print order[i], time[order[i], "p50_ns"], time[order[i], "p99_ns"] }
' "$json")
# The median and the largest coefficient of variation of all cases, in percent.
scatter=$(awk -F '"' '
  $2 == "aggregate_name" { aggregate = $4 }
  $2 == "run_name" { name = $4 }
  $2 == "cpu_time" && aggregate == "cv" && name !~ /after_sleep/ { sub(/^: /, "", $3); sub(/,$/, "", $3); print 100 * $3 }
' "$json" | sort -g | awk '{ cv[NR] = $1 } END { printf "%.0f and %.0f", cv[int((NR + 1) / 2)], cv[NR] }')
context() { sed -n "s/^ *\"$1\": \"\(.*\)\",\{0,1\}$/\1/p" "$json" | head -n 1; }

{
  echo "# articula beside KDL and MuJoCo"
  echo
  echo "$(context cpu); $(context compiler)."
  echo "Flags: \`$(context flags)\`, ours with \`-march=native\` besides; KDL and MuJoCo as Debian packages them."
  echo "Made by \`$(context command)\`, revision $(context revision)."
  echo
  echo "The figures are nanoseconds of one call, the median of five repetitions. A figure in brackets is the ratio"
  echo "to articula's described type. \"Shortest\" are MuJoCo's stages that the result needs, without the rest of the"
  echo "public function. KDL has the robot as kdl_parser makes it of the URDF. PR2: thirty joints, all free."
  echo "Forward kinematics and Jacobian are those of the tool, for the described type a link named at compile time."
  echo "Less than 2 ns cannot be told from the measuring itself. Median and largest coefficient of variation"
  echo "of the cases: $scatter percent."
  echo
  echo "| robot | operation | described type | \`Model<N>\` | KDL | MuJoCo | MuJoCo, shortest |"
  echo "|---|---|---:|---:|---:|---:|---:|"
  awk '
    function cell(library, time) {
      time = t[$0, library]
      if (time == "") return "-"
      if (t[$0, "described"] < 2) return sprintf("%.*f (> %.0f)", time < 100, time, time / 2)
      ratio = time / t[$0, "described"]
      return sprintf("%.*f (%.*f)", time < 100, time, ratio < 10, ratio)
    }
    { key = $2 " | " $1; if (!(key in seen)) { seen[key] = 1; order[++n] = key } t[key, $3] = $4 }
    END {
      for (i = 1; i <= n; ++i) {
        $0 = order[i]
        ours = t[$0, "described"]
        line = $0; gsub("_", " ", line)
        printf "| %s | %s | %s | %s | %s | %s |\n", line,
          ours < 2 ? "< 2" : sprintf("%.*f", ours < 100, ours), cell("model"), cell("kdl"),
          cell("mujoco"), cell("mujoco_shortest")
      }
    }' <<<"$cases"
  echo
  echo "All these calls follow each other: caches and branch predictors hold what they need. A control loop sleeps"
  echo "between calls. The next table has nanoseconds of calls after a millisecond of sleep. \"Clock\" is the time of"
  echo "reading the clock, which is in all of them."
  echo
  echo "| robot | operation | library | median | 99th percentile |"
  echo "|---|---|---|---:|---:|"
  while read -r operation robot library median high; do
    printf '| %s | %s | %s | %.0f | %.0f |\n' "$robot" "${operation//_/ }" "${library//_/ }" "$median" "$high"
  done <<<"$slept"
} >"$folder/peers.md"

# Ratios to ours, a group for each robot and operation.
data=$(mktemp)
trap 'rm -f "$data"' EXIT
awk '
  { key = $2 " " $1; if (!(key in seen)) { seen[key] = 1; order[++n] = key } t[key, $3] = $4 }
  function ratio(key, library) {  # less than 2 ns cannot be measured
    ours = t[key, "described"] < 2 ? 2 : t[key, "described"]
    return t[key, library] == "" ? "NaN" : t[key, library] / ours
  }
  END {
    for (i = 1; i <= n; ++i) {
      key = order[i]; label = key; gsub("_", " ", label)
      printf "\"%s\" %s %s %s\n", label, ratio(key, "model"), ratio(key, "kdl"),
        ratio(key, t[key, "mujoco"] == "" ? "mujoco_shortest" : "mujoco")
    }
  }' <<<"$cases" >"$data"
gnuplot <<PLOT
set terminal svg size 900,480 font "sans-serif,12" background "white"
set output "$folder/peers.svg"
set style data histograms
set style fill solid
set boxwidth 0.9
set logscale y
set ylabel "time / time of articula's described type"
set xtics rotate by -45
set grid ytics
set key top right
plot "$data" using 2:xtic(1) title "articula, Model<N>" linecolor "#7fb2d9", \
     "" using 3 title "KDL" linecolor "#e0a040", "" using 4 title "MuJoCo" linecolor "#a05050"
PLOT
echo "written: $folder/peers.md, $folder/peers.svg"
