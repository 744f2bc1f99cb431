#!/usr/bin/env bash
# SPDX-License-Identifier: Apache-2.0
# operate.sh <articula> <program of a loop> <its arguments>...: starts the loop, and moves a joint from
# a terminal.
set -euo pipefail

articula=$1
shift
coproc loop { exec "$@"; }
# shellcheck disable=SC2154 # coproc sets it
process=$loop_PID
trap 'kill -INT "$process" 2>/dev/null || true' EXIT
port=
while [[ -z $port ]] && read -r line; do
  if [[ $line =~ http://[^:]*:([0-9]+) ]]; then port=${BASH_REMATCH[1]}; fi
done <&"${loop[0]}"

for ((attempt = 0; attempt < 600; ++attempt)); do
  grep -q "^mode  *active" <("$articula" --port "$port" status) && break
  sleep 0.1
done
"$articula" --port "$port" controllers
"$articula" --port "$port" switch --start arms_torque --replace
"$articula" --port "$port" switch --start arms --replace
"$articula" --port "$port" gains set arms.left_elbow_joint.p=60
"$articula" --port "$port" go left_elbow_joint=0.3 --wait
kill -INT "$process"
wait "$process"
