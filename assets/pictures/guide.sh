#!/usr/bin/env bash
# Makes every picture of docs/ anew, by running the chapters themselves with every stated count (minutes).
#   assets/pictures/guide.sh [BUILD]        BUILD: a build with tests; default build/check
# Needs ImageMagick (package imagemagick) and chromium.
set -euo pipefail
here=$(cd "$(dirname "$0")" && pwd)
build=$(cd "${1:-$here/../../build/check}" && pwd)
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
most=200000  # bytes a picture
fail() { printf 'guide.sh: %s\n' "$*" >&2; exit 1; }
for program in convert chromium; do command -v $program >/dev/null || fail "$program is missing"; done

PALPA_FULL=1 PALPA_GUIDE_PICTURES=$work "$build/tests/guide/test_guide" --gtest_filter="${FILTER:-*Chapter*}"
# A palette without dithering keeps text sharp and files small; of photographs the JPEGs stay as they are.
for from in "$work"/*; do
  name=$(basename "$from") size=$(stat -c %s "$from")
  if [ "${name##*.}" = png ]; then
    for colours in 256 128 64 32; do
      convert "$from" -strip +dither -colors "$colours" "PNG8:$work/small"
      size=$(stat -c %s "$work/small")
      [ "$size" -le "$most" ] && break
    done
    mv "$work/small" "$from"
  fi
  [ "$size" -le "$most" ] || fail "$name would have $size bytes, more than $most"
  mv "$from" "$here/guide/$name"
  printf '%s: %d bytes\n' "$name" "$size"
done
