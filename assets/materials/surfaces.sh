#!/bin/bash
# Identifies the surfaces of surfaces.json anew on the virtual palpation bench.
#   PALPA=build/check/palpa bash assets/materials/surfaces.sh
set -euo pipefail
palpa=${PALPA:-palpa}
here=$(cd "$(dirname "$0")" && pwd)/surfaces
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
mkdir -p "$here"
for surface in "oiled gel" "skin" "leather" "rubber"; do
  for kind in material friction; do
    "$palpa" calibrate "$kind" --surface "$surface" --seed 1 --quiet --out "$work/$kind"
    cp "$work/$kind/$kind.json" "$here/${surface// /-}-$kind.json"
    rm -r "$work/$kind"
  done
done
