#!/usr/bin/env bash
# Makes the Debian package: cmake/package.sh [--yes]. Installs what is missing to build it (asks
# first, unless root or --yes); the last line says where it is.
set -euo pipefail
top=$(cd "$(dirname "$0")/.." && pwd)
. "$top/cmake/prepare.sh"

yes=0
[ "${1:-}" = --yes ] && yes=1
install_missing "$yes" build package
build release -DPALPA_TESTS=OFF
say "Packing ..."
(cd "$top/build/release" && cpack -G DEB >cpack.log 2>&1) || {
  tail -n 20 "$top/build/release/cpack.log" >&2
  fail "packing failed; see build/release/cpack.log"
}
ls -1 "$top"/build/release/palpa_*.deb
