#!/usr/bin/env bash
# Makes the pictures of docs/pictures.md: each task's session by two programs, side by side.
#   BEFORE=/path/to/older assets/pictures/before_after.sh
#     a source tree whose ./run has built its program; of the older pictures here it was at eaddff2d
#   AFTER=/path/to/newer: the same of the newer one (default: this tree)
# Needs ImageMagick (package imagemagick).
set -euo pipefail
here=$(cd "$(dirname "$0")" && pwd)
before=${BEFORE:?the older tree}
after=${AFTER:-$here/../..}
out=$here/before_after
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
mkdir -p "$out"

# of TREE WORDS...: that tree's program, with its own data
of() {
  local tree=$1
  shift
  PALPA_ASSETS=$tree/assets "$tree/build/${PRESET:-release}/palpa" "$@" >/dev/null
}

# pair NAME MOMENT WORDS...: that moment of both
pair() {
  local name=$1 moment=$2 which
  shift 2
  for which in before after; do
    of "${!which}" "$@" --operator expert --seed 3 --fast --quiet --out "$work/$name-$which"
  done
  convert "$work/$name-before/view-01-$moment.png" "$work/$name-after/view-01-$moment.png" \
    -resize 640x360 +append -strip -quality 80 "$out/$name.jpg"
  printf '%s: %d bytes\n' "$name" "$(stat -c %s "$out/$name.jpg")"
}

pair needle 03-phase-2 paracentesis
pair breast 01-start palpation --preset breast
pair abdomen 01-start palpation --preset abdomen
pair prostate 01-start palpation --preset prostate
pair neck 01-start palpation --preset neck
pair squeeze 02-held squeeze
pair friction 02-stroked friction
pair pulse 02-mark pulse
pair search 01-start search

# Without a camera's picture: a replay.
for which in before after; do
  of "${!which}" replay "$work/needle-$which/session.palpa" --pictures "$work/$which" --from 9 \
    --to 10 --fps 1 --size 1280x720
done
convert "$work/before/picture-00000.jpg" "$work/after/picture-00000.jpg" \
  -resize 640x360 +append -strip -quality 80 "$out/replay.jpg"
