#!/bin/sh
# SPDX-License-Identifier: Apache-2.0
# Gets Debian's kernel with its modules for the virtual machine of run_with_vcan.sh: unpacks the
# package, without installing it, into ${XDG_CACHE_HOME:-~/.cache}/articula/kernel.
set -eu

cache=${XDG_CACHE_HOME:-$HOME/.cache}/articula
[ ! -d "$cache/kernel" ] || exit 0
[ "$(dpkg --print-architecture)" = amd64 ] || { echo "$0: only for amd64" >&2; exit 1; }
# linux-image-amd64 depends on the newest one; the variants for clouds have no CAN.
package=$(apt-cache depends linux-image-amd64 | sed -n 's/^ *Depends: \(linux-image-[0-9][^ ]*\)$/\1/p')
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
(cd "$work" && apt-get download "$package")
mkdir "$work/kernel"
dpkg-deb --extract "$work"/*.deb "$work/kernel"
mkdir -p "$cache"
mv "$work/kernel" "$cache/kernel"
