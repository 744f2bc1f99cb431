#!/bin/sh
# SPDX-License-Identifier: Apache-2.0
# Operates the program that `articula run --can` makes of a URDF and a YAML file from the terminal,
# while a simulated arm is on the bus: activation, a motion, drives that fall silent, and their return.
set -eu

# Drives have processors of their own: nothing here may delay them.
chrt -f 90 ./can_drives --protocol=cia402 --initial=0.2,-0.3 &
drives=$!
./bus_arm --seconds 120 &

say() { echo "operate_on_bus.sh: $*"; }
# Repeats a command until its output has the words.
wait_for() { # words command...
  words=$1
  shift
  for attempt in $(seq 200); do
    if "$@" > answer 2>&1 && grep -q "$words" answer; then return; fi
    sleep 0.1
  done
  say "no '$words' from '$*', but:"
  cat answer
  exit 1
}
# Whether a joint is within 0.01 rad of a position.
check_position() { # joint position
  ./articula --json status > answer
  tr '{' '\n' < answer | grep "\"name\":\"$1\".*\"position\":" | sed 's/.*"position":\([^,}]*\).*/\1/' > position
  # Without a number the joint is nowhere.
  awk -v wanted="$2" '{ d = $1 - wanted; near = d * d <= 1e-4 } END { exit !near }' position || {
    say "$1 is at $(cat position), not at $2"
    exit 1
  }
}

wait_for '^mode  *active' ./articula status
check_position shoulder_active_joint 0.2 # held where it was
./articula switch --start pid_plus_gravity_controller
./articula go shoulder_active_joint=0.5 elbow_active_joint=0.1 --wait
sleep 1
check_position shoulder_active_joint 0.5
check_position elbow_active_joint 0.1
./articula status > answer
cat answer
grep -q '^mode  *active' answer

kill "$drives"
wait_for '^mode  *fault' ./articula status
cat answer
chrt -f 90 ./can_drives --protocol=cia402 --initial=0.5,0.1 &
sleep 1
./articula fault ack
./articula activate
wait_for '^mode  *active' ./articula status
./articula go shoulder_active_joint=0.3 --wait
sleep 1
check_position shoulder_active_joint 0.3
say done
