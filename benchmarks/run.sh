#!/usr/bin/env bash
# SPDX-License-Identifier: Apache-2.0
# Builds and runs the benchmarks; results go to benchmarks/results/<subject>.json, or another folder.
#
#   benchmarks/run.sh [<subject>...] [--output=<folder>]
#                     [--benchmark_filter=... and other options of Google Benchmark]
set -euo pipefail

subjects=()
options=()
command=benchmarks/run.sh
results=$(dirname "$0")/results
for argument in "$@"; do
  case $argument in
    --output=*) results=${argument#*=} && continue ;; # the recorded command omits the folder
    --*) options+=("$argument") ;;
    *) subjects+=("$argument") ;;
  esac
  command+=" $argument"
done

mkdir -p "$results"
results=$(cd "$results" && pwd)
cd "$(dirname "$0")/.."

peers=OFF # needs other libraries and minutes to compile, so it is built on request only
for subject in ${subjects[@]+"${subjects[@]}"}; do [[ $subject != peers ]] || peers=ON; done
cmake --preset bench -DARTICULA_BENCHMARK_PEERS=$peers
cmake --build --preset bench
programs=build/bench/benchmarks

if ((${#subjects[@]} == 0)); then
  for file in benchmarks/*_benchmark.cpp; do
    [[ -e $file ]] && subjects+=("$(basename "$file" _benchmark.cpp)")
  done
fi

# The context of a result: its origin.
cached() { sed -n "s/^$1:[A-Z]*=//p" build/bench/CMakeCache.txt; }
cpu=$(sed -n 's/^model name[[:space:]]*: //p' /proc/cpuinfo | head -n 1)
lanes=sse2
for wider in avx2 avx512f; do
  if grep -qw "$wider" /proc/cpuinfo; then lanes=$wider; fi
done
# The name alone does not show the internal width of the registers: Zen 4 has halves of AVX-512's,
# Zen 5 has whole ones.
number_of() { sed -n "s/^$1[[:space:]]*: //p" /proc/cpuinfo | head -n 1; }
family=$(number_of 'cpu family') model=$(number_of model) generation=''
if [[ $(number_of vendor_id) == AuthenticAMD ]]; then
  case $family in
    23) generation=', Zen, Zen+ or Zen 2' ;;
    25) # models 10h to 1Fh and 60h to AFh are Zen 4
      generation=', Zen 3'
      if ((model >= 16 && model < 32 || model >= 96)); then generation=', Zen 4'; fi
      ;;
    26) generation=', Zen 5' ;;
  esac
fi
cpu+=" (family $family model $model$generation, $lanes)"
compiler=$("$(cached CMAKE_CXX_COMPILER)" --version | head -n 1)
flags="-std=c++20 $(cached CMAKE_CXX_FLAGS) $(cached CMAKE_CXX_FLAGS_RELEASE)"
revision=$(git describe --always --dirty 2>/dev/null || echo unknown)
context_of() { # <subject>
  local key flags=$flags
  [[ $1 != packs && $1 != lanes || -z $(cached ARTICULA_HAS_MARCH_NATIVE) ]] || flags+=' -march=native'
  for key in cpu compiler flags revision command; do
    printf '    "%s": "%s",\n' "$key" "$(tr -s ' ' <<<"${!key//\"/\'}")"
  done
}

for subject in ${subjects[@]+"${subjects[@]}"}; do
  result=$results/$subject.json
  order=() # random order: a disturbance then affects all cases, and ratios stay correct
  [[ $subject != peers && $subject != packs && $subject != lanes ]] || order=(--benchmark_enable_random_interleaving=true)
  "$programs/${subject}_benchmark" \
    --benchmark_repetitions=5 --benchmark_report_aggregates_only=true \
    --benchmark_out_format=json --benchmark_out="$result" \
    ${order[@]+"${order[@]}"} ${options[@]+"${options[@]}"}
  # The context replaces the name of the machine.
  sed -i -e '/"host_name"/{r /dev/stdin' -e 'd}' "$result" < <(context_of "$subject")
  echo "written: $result"
  [[ $subject != peers ]] || benchmarks/peers/table.sh "$result" "$results"
done
