#!/bin/sh
# SPDX-License-Identifier: Apache-2.0
# run.sh FOLDER [option of smpirun...] -- RANKS:MILLISECONDS:CHUNKS...
#
# The efficiency of sweeps on clusters that SimGrid simulates (Debian: libsimgrid-dev), for some numbers
# of ranks, mean times of a run and chunks for each rank. Builds the program in the folder.
#
# Each rank has a node of its own, with 10 Gbit/s and 5 us to a switch. The computations of this machine
# count, in its speed, but for the runs, whose time is given. A look for messages takes 1 us.
set -eu

folder=$1
shift
options=''
while [ "$1" != -- ]; do options="$options $1" && shift; done
shift
here=$(cd "$(dirname "$0")" && pwd)
mkdir -p "$folder"
cat >"$folder/cluster.xml" <<END
<?xml version='1.0'?>
<!DOCTYPE platform SYSTEM "https://simgrid.org/simgrid.dtd">
<platform version="4.1">
  <zone id="world" routing="Full">
    <cluster id="cluster" prefix="node-" suffix="" radical="0-8191" speed="1Gf" bw="1.25GBps" lat="5us"/>
  </zone>
</platform>
END
seq -f 'node-%g' 0 8191 >"$folder/hosts"
smpicxx -std=c++20 -O2 -I"$here/../../include" -isystem /usr/include/eigen3 \
  "$here/simulated_ranks.cpp" -o "$folder/simulated_ranks" -ltbb
for item in "$@"; do
  ranks=${item%%:*} rest=${item#*:}
  # shellcheck disable=SC2086 # several options
  smpirun -np "$ranks" -platform "$folder/cluster.xml" -hostfile "$folder/hosts" \
    --cfg=smpi/host-speed:1Gf --cfg=smpi/test:1e-6 --log=root.thres:warning $options \
    "$folder/simulated_ranks" "${rest%%:*}e-3" "${rest#*:}"
done
