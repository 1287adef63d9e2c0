#!/bin/bash
# Identifies the textures of textures/ anew on the virtual bench's rough surfaces.
#   PALPA=build/check/palpa bash assets/materials/textures.sh
set -euo pipefail
palpa=${PALPA:-palpa}
here=$(cd "$(dirname "$0")" && pwd)/textures
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
mkdir -p "$here"
for surface in "fine fabric" "sandpaper" "ribbed" "wood"; do
  name=${surface// /-}
  "$palpa" calibrate texture --surface "$surface" --seed 1 --quiet --out "$work/$name"
  cp "$work/$name/texture.json" "$here/$name.json"
done
