#!/bin/bash
# Identifies the surface and the lumps of lumps.json anew on the virtual palpation bench.
#   PALPA=build/check/palpa bash assets/materials/lumps.sh
set -euo pipefail
palpa=${PALPA:-palpa}
here=$(cd "$(dirname "$0")" && pwd)/lumps
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
mkdir -p "$here"
keep() {  # kind, name, further arguments
  "$palpa" calibrate "$1" "${@:3}" --seed 1 --quiet --out "$work/$2"
  cp "$work/$2/$1.json" "$here/$2.json"
}
keep material material
keep friction friction
for lump in "middle" "soft lump" "deep" "large" \
  "large, soft lump" "small, shallow" "large, deep" "hard"; do
  name=${lump//,/}
  keep inclusion "${name// /-}" --mockup "$lump"
done
