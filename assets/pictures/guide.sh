#!/usr/bin/env bash
# Makes every picture of docs/ anew, by running the chapters themselves with every stated count
# (minutes). Needs chromium.
#   assets/pictures/guide.sh [BUILD]        BUILD: a build with tests; default build/check
set -euo pipefail
here=$(cd "$(dirname "$0")" && pwd)
build=$(cd "${1:-$here/../../build/check}" && pwd)
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
most=200000  # bytes a picture
fail() {
  printf 'guide.sh: %s\n' "$*" >&2
  exit 1
}
command -v chromium >/dev/null || fail "chromium is missing: apt-get install chromium"

PALPA_FULL=1 PALPA_GUIDE_PICTURES=$work "$build/tests/guide/test_guide" --gtest_filter='*Chapter.*'
for picture in "$work"/*; do
  size=$(stat -c %s "$picture")
  [ "$size" -le "$most" ] ||
    fail "$(basename "$picture") has $size bytes, more than $most:" \
      "let the chapter make a smaller one"
  cp "$picture" "$here/guide/"
  printf '%s: %d bytes\n' "$(basename "$picture")" "$size"
done
