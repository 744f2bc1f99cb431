#!/usr/bin/env bash
# SPDX-License-Identifier: Apache-2.0
# walk_commands.sh ROOT ARTICULA SCRATCH DOCUMENT
#
# Types the commands of a walkthrough, in its order, in a copy of ROOT/examples. They stand in the tables
# whose columns are called "today", "here" and "you see". The output of a command contains each text in
# quotes of the last column, apart from the width of spaces. Its exit status is 0, or 1 if that column
# begins with "refused".
# `articula run` goes on beside the commands after it, until the next one or the end.
# grep -q reads no pipe here: it ends at the first match, and pipefail reports that its writer failed.
set -euo pipefail

articula=$(realpath "$2")
scratch=$3
name=$4
document=$1/$name
rm -rf "$scratch"
mkdir -p "$scratch"
cp -r "$1/examples" "$scratch"
cd "$scratch/examples/walkthroughs"
export DISPLAY='' WAYLAND_DISPLAY=''

port=0
walked=0
process=
end_run() {
  [[ -z $process ]] && return 0
  kill -INT "$process"
  wait "$process" || { echo "$name: the run ended with status $?"; exit 1; }
  process=
}
trap '[[ -z $process ]] || kill "$process" 2>/dev/null || true' EXIT

# Starts a run, and waits until its loop is active.
start_run() {
  end_run
  : >run.txt
  "$articula" --port 0 "$@" >run.txt 2>&1 &
  process=$!
  for ((attempt = 0; attempt < 600; ++attempt)); do
    kill -0 "$process" 2>/dev/null || { cat run.txt; return 1; }
    port=$(sed -nE 's|^http://[^:]*:([0-9]+)/.*|\1|p' run.txt)
    [[ -n $port ]] && grep -q '^mode  *active' <("$articula" --port "$port" status) && break
    sleep 0.1
  done
  cat run.txt
  ((attempt < 600))
}

while IFS=$'\t' read -r command seen; do
  walked=$((walked + 1))
  echo "\$ $command"
  read -ra words <<<"$command"
  wanted=0
  [[ $seen != refused* ]] || wanted=1
  status=0
  if [[ ${words[1]} == run ]]; then
    start_run "${words[@]:1}" >output.txt || status=$?
  else
    "$articula" --port "$port" "${words[@]:1}" >output.txt 2>&1 </dev/null || status=$?
  fi
  cat output.txt
  [[ $status == "$wanted" ]] || { echo "$name: status $status, not $wanted: $command"; exit 1; }
  # shellcheck disable=SC2016 # these are no expressions
  while IFS= read -r text; do
    [[ -z $text ]] || grep -qF -- "$text" <(tr -s ' ' <output.txt) || { echo "$name: no '$text': $command"; exit 1; }
  done < <(grep -o '`[^`]*`' <<<"$seen" | tr -d '`')
done < <(awk -F ' *[|] *' '
  !/^\|/ { in_table = 0; next }
  !in_table { in_table = 1; wanted = $2 == "today" && $3 == "here" && $4 == "you see"; next }
  wanted && $3 ~ /^`articula / { gsub(/`/, "", $3); print $3 "\t" $4 }' "$document")
end_run
echo "$walked commands"
((walked > 0))
