#!/bin/sh
# SPDX-License-Identifier: Apache-2.0
# run_with_vcan.sh [--exact] SECONDS PROGRAM... -- COMMAND
#
# Runs COMMAND in a folder with copies of the programs, on a kernel with virtual CAN: vcan0 is up. Its
# exit status is ours; no result within SECONDS is 124.
#
# Where the host's kernel has vcan with echo (modprobe vcan echo=1, without which tc has no effect on
# it) and lets us have a network namespace of our own, it runs there. Else in a virtual machine with
# the kernel that fetch_kernel.sh got, in software emulation if need be. Where neither is possible it
# says "Skipped: " and why, and is content with that unless ARTICULA_VCAN_REQUIRED is set.
#
# With --exact it is the virtual machine, whose time follows its instructions: however busy the host
# is, a cycle is late only by what the machine itself does.
set -eu

here=$(CDPATH='' cd "$(dirname "$0")" && pwd)
exact=''
[ "$1" != --exact ] || { exact=1; shift; }
limit=$1
shift
programs=''
while [ $# -gt 0 ] && [ "$1" != -- ]; do
  programs="$programs $1"
  shift
done
shift
command=$*

work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
mkdir -p "$work/root/test"
for program in $programs; do cp -L "$program" "$work/root/test/"; done

skip() {
  echo "Skipped: $1"
  [ -z "${ARTICULA_VCAN_REQUIRED:-}" ] || exit 1
  exit 0
}

# --- on this kernel -------------------------------------------------------------------------------

if [ -z "$exact" ] && [ "$(cat /sys/module/vcan/parameters/echo 2>/dev/null)" = Y ] &&
  unshare --map-root-user --net ip link add vcan0 type vcan 2>/dev/null; then
  status=0
  # shellcheck disable=SC2016 # expanded by the inner shell
  timeout --kill-after=5 "$limit" unshare --map-root-user --net sh -c '
    ip link set lo up && ip link add vcan0 type vcan && ip link set vcan0 up && cd "$0" && exec sh -c "$1"
  ' "$work/root/test" "$command" || status=$?
  exit "$status"
fi

# --- in a virtual machine -------------------------------------------------------------------------

for needed in qemu-system-x86_64 busybox dash chrt cpio ldd ip tc candump cansend cangen; do
  command -v "$needed" >/dev/null || skip "this kernel has no vcan, and for a virtual machine $needed is missing"
done
[ "$(uname -m)" = x86_64 ] || skip 'this kernel has no vcan, and the virtual machine is for x86-64'
kernel=${XDG_CACHE_HOME:-$HOME/.cache}/articula/kernel
image=$(ls "$kernel"/boot/vmlinuz-* 2>/dev/null | head -n 1)
[ -n "$image" ] || skip "this kernel has no vcan, and there is none for a virtual machine: $here/fetch_kernel.sh gets it"

root=$work/root
mkdir -p "$root/bin" "$root/sbin" "$root/modules" "$root/proc" "$root/sys" "$root/dev" "$root/tmp"
put() { # program: it and the libraries that it needs
  cp -L "$1" "$root/bin/"
  for library in $(ldd "$1" 2>/dev/null | grep -o '/[^ ]*'); do
    [ -e "$root$library" ] || { mkdir -p "$root$(dirname "$library")" && cp -L "$library" "$root$library"; }
  done
}
for program in chrt ip tc candump cansend cangen dash; do put "$(command -v "$program")"; done
for program in "$root"/test/*; do
  for library in $(ldd "$program" 2>/dev/null | grep -o '/[^ ]*'); do
    [ -e "$root$library" ] || { mkdir -p "$root$(dirname "$library")" && cp -L "$library" "$root$library"; }
  done
done
cp "$(command -v busybox)" "$root/bin/busybox"
mv "$root/bin/dash" "$root/bin/sh" # busybox's own shell would take its own ip and tc
[ ! -d /usr/lib/tc ] || { mkdir -p "$root/usr/lib" && cp -r /usr/lib/tc "$root/usr/lib/"; }

# In the order in which they are loaded. Newer kernels come with compressed modules.
order='net/can/can net/can/can-raw drivers/net/can/dev/can-dev net/sched/sch_netem net/sched/sch_tbf drivers/net/can/vcan'
for module in $order; do
  file=$(ls "$kernel"/lib/modules/*/kernel/"$module".ko* "$kernel"/usr/lib/modules/*/kernel/"$module".ko* 2>/dev/null | head -n 1)
  case $file in
    *.ko) cp "$file" "$root/modules/" ;;
    *.ko.xz) xz --decompress --stdout "$file" > "$root/modules/$(basename "$file" .xz)" ;;
    *) echo "$0: the kernel in $kernel lacks $module" >&2; exit 1 ;;
  esac
done
{
  echo '#!/bin/sh'
  echo '/bin/busybox --install -s /sbin'
  echo 'export PATH=/bin:/sbin'
  echo 'mount -t proc proc /proc; mount -t sysfs sys /sys; mount -t devtmpfs dev /dev; mount -t tmpfs tmp /tmp'
  for module in $order; do
    name=${module##*/}
    if [ "$name" = vcan ]; then options='echo=1'; else options=''; fi
    echo "insmod /modules/$name.ko $options"
  done
  echo 'ip link set lo up; ip link add vcan0 type vcan; ip link set vcan0 up'
  printf 'cd /test; sh -c %s\n' "'$(printf %s "$command" | sed "s/'/'\\\\''/g")'"
  echo 'echo "guest: exit status $?"'
  echo 'poweroff -f'
} > "$root/init"
chmod +x "$root/init"
(cd "$root" && find . | cpio --quiet -o -H newc -R 0:0) > "$work/initrd"

# One processor: with two, emulation makes the threads of a round trip wait for each other.
accelerator=tcg
if [ -n "$exact" ]; then
  accelerator='tcg -icount shift=1,sleep=off -rtc clock=vm'
elif [ -w /dev/kvm ] && grep -qwE 'vmx|svm' /proc/cpuinfo; then accelerator=kvm; fi
status=0
# shellcheck disable=SC2086 # several words
timeout --kill-after=5 "$limit" qemu-system-x86_64 -accel $accelerator -cpu max -smp 1 -m 1024 \
  -nodefaults -no-user-config -display none -nic none -no-reboot \
  -kernel "$image" -initrd "$work/initrd" \
  -append 'console=ttyS0 quiet panic=-1 mitigations=off nokaslr no_timer_check' \
  -serial file:"$work/console" </dev/null || status=$?
tr -d '\r' < "$work/console"
if [ "$status" -ne 0 ]; then
  echo "$0: the virtual machine ended with status $status (124: no result within $limit s)"
  exit 124
fi
result=$(tr -d '\r' < "$work/console" | sed -n 's/^guest: exit status \([0-9]*\)$/\1/p' | tail -n 1)
exit "${result:-125}"
