#!/usr/bin/env bash
# fresh_debian.sh BUILD: the package in a Debian that holds nothing else, of the version that it was
# built on: installed, used, removed without a trace. Needs root (or user namespaces), mmdebstrap
# and a network.
set -euo pipefail
build=$(cd "$1" && pwd)
here=$(cd "$(dirname "$0")" && pwd)
skip() {
  echo "skipped: $*"
  exit 77
}
fail() {
  echo "FAIL  $*"
  exit 1
}

[ "${PALPA_FULL:-}" = 1 ] || skip "only with PALPA_FULL=1 (./check --full)"
command -v mmdebstrap >/dev/null || skip "mmdebstrap is not installed"
mode=unshare
[ "$(id -u)" = 0 ] && mode=root
[ $mode = root ] || command -v newuidmap >/dev/null ||
  skip "without root it takes the package uidmap"
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
chmod 755 "$work"

(cd "$work" && cpack --config "$build/CPackConfig.cmake" -G DEB -B "$work" >cpack.log 2>&1) || {
  tail -n 20 "$work/cpack.log"
  fail "packing"
}
deb=$(ls "$work"/palpa_*.deb)
installed=$(dpkg-deb -f "$deb" Installed-Size)
echo "package: $(basename "$deb"), $(stat -c %s "$deb") bytes, $installed kB installed"
if command -v lintian >/dev/null; then
  known=$(grep -v '^#' "$here/lintian_known.txt" | cut -d' ' -f1 | paste -sd,)
  lintian --no-cfg --allow-root --pedantic --fail-on error,warning \
    --suppress-tags "$known" "$deb" ||
    fail "lintian"
  echo "ok    lintian finds no error and gives no warning"
fi

cat >"$work/hook" <<HOOK
#!/bin/sh
set -e
cp "$deb" "$here/expect.sh" "$here/in_fresh_debian.sh" "\$1/opt/"
exec chroot "\$1" /bin/bash /opt/in_fresh_debian.sh
HOOK
chmod 755 "$work/hook"
suite=$(. /etc/os-release && echo "${VERSION_CODENAME:-bookworm}")
echo "Debian ($suite) is made (mmdebstrap --mode=$mode) ..."
mirror=${PALPA_DEBIAN_MIRROR:-http://deb.debian.org}
mmdebstrap --quiet --mode=$mode --variant=minbase --format=null \
  --customize-hook="$work/hook" "$suite" - \
  "deb $mirror/debian $suite main" \
  "deb $mirror/debian $suite-updates main" \
  "deb $mirror/debian-security $suite-security main"
