#!/usr/bin/env bash
# SPDX-License-Identifier: Apache-2.0
# Installs the packages for building and testing articula, on Debian 12 or newer and derivatives.
#
#   cmake/install-dependencies.sh          for the demo, the tests and articula's own benchmarks
#   cmake/install-dependencies.sh --view   also for the page of the view in a browser
#   cmake/install-dependencies.sh --all    also for .ci/run, the benchmarks beside other libraries
#                                          and the developers' tools
set -euo pipefail

packages=(
  g++ cmake ninja-build ccache pkg-config git
  libeigen3-dev      # the only dependency of articula::articula
  liburdfdom-dev     # robots from URDF files
  nlohmann-json3-dev # recordings as JSON
  libyaml-cpp-dev    # configuration files
  libfastrtps-dev    # Fast DDS, for topics and services of ROS 2
  cyclonedds-dev     # another vendor's DDS, as peer in their tests
  libtbb-dev libhdf5-dev libopenmpi-dev openmpi-bin libnlopt-dev # sweeps
  catch2             # tests
  libxsimd-dev       # another library's packs, for tests of programs over them
  binutils           # nm, for the check of the object code
  libbenchmark-dev   # benchmarks
  rt-tests           # cyclictest, for comparison with benchmarks/jitter
  libcli11-dev       # command line of the examples
  gnuplot-nox        # plots of the examples
)
# The server of the view needs a Boost of 1.81 or later; Debian 12's default is older.
if grep -qs '^VERSION_CODENAME=bookworm' /etc/os-release; then
  packages+=(libboost1.81-dev)
else
  packages+=(libboost-dev)
fi

# npm builds the page of the view. Node.js from elsewhere brings it, and Debian's npm would replace
# that.
view_packages() { command -v npm >/dev/null || packages+=(nodejs npm); }

case ${1:-} in
  '') ;;
  --view) view_packages ;;
  --all)
    view_packages
    packages+=(chromium) # tests/view/page
    packages+=(fish)     # tests/terminal
    packages+=(clang-19 libclang-rt-19-dev clang-format-19 clang-tidy-19 valgrind)
    packages+=(liborocos-kdl-dev libmujoco-dev) # peers, in tests and benchmarks
    # tests/webassembly
    packages+=(lld-19 libc++-19-dev-wasm32 libc++abi-19-dev-wasm32 libclang-rt-19-dev-wasm32)
    packages+=(wasi-libc)
    command -v node >/dev/null || packages+=(nodejs)
    # tests/vcan: a virtual machine with CAN in its kernel, if this kernel has none
    packages+=(qemu-system-x86 busybox-static dash cpio xz-utils iproute2 can-utils)
    ;;
  *) echo "usage: $0 [--view | --all]" >&2; exit 2 ;;
esac

if ! { command -v dpkg-query && command -v apt-get; } >/dev/null; then
  echo "$0: dpkg-query or apt-get was not found; install these packages by other means:" \
    "${packages[*]}" >&2
  exit 1
fi

missing=()
for package in "${packages[@]}"; do
  state=$(dpkg-query --show --showformat='${db:Status-Status}' "$package" 2>/dev/null || true)
  [[ $state == *installed* && $state != *not-installed* ]] || missing+=("$package")
done

# The kernel of that virtual machine is only unpacked, not installed.
fetch_kernel() {
  [[ ${1:-} != --all || $(dpkg --print-architecture) != amd64 ]] ||
    "$(dirname "$0")/../tests/vcan/fetch_kernel.sh"
}
if ((${#missing[@]} == 0)); then
  fetch_kernel "$@"
  exit 0
fi

as_root=()
if ((EUID != 0)); then
  if ! command -v sudo >/dev/null; then
    echo "$0: no right to install: ${missing[*]}; run as root, or install sudo" >&2
    exit 1
  fi
  as_root=(sudo)
fi
echo "installing: ${missing[*]}"
${as_root[@]+"${as_root[@]}"} apt-get update
${as_root[@]+"${as_root[@]}"} env DEBIAN_FRONTEND=noninteractive \
  apt-get install -y --no-install-recommends "${missing[@]}"
fetch_kernel "$@"
