#!/usr/bin/env bash
# Makes the pictures beside this script, which READMEs show, with the commands printed there.
#   assets/pictures/make.sh                     with the program that ./run has built
#   PALPA=/path/to/palpa assets/pictures/make.sh
# Needs ImageMagick (package imagemagick). The picture of the report needs chromium
# and is left out without it.
set -euo pipefail
here=$(cd "$(dirname "$0")" && pwd)
top=$(cd "$here/../.." && pwd)
palpa=${PALPA:-$top/build/release/palpa}
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
most=200000  # bytes a picture

fail() {
  printf 'make.sh: %s\n' "$*" >&2
  exit 1
}
[ -x "$palpa" ] || fail "$palpa is not there: ./run builds it, or set PALPA"
command -v convert >/dev/null || fail "convert is missing: apt-get install imagemagick"
case $palpa in
  /*) ;;
  *) palpa=$PWD/$palpa ;;
esac

# small FROM TO [convert options...]: a palette without dithering keeps text sharp and files small
small() {
  local from=$1 to=$2 colours size
  shift 2
  for colours in 256 128 64 32; do
    convert "$from" "$@" -strip +dither -colors "$colours" "PNG8:$work/small.png"
    size=$(stat -c %s "$work/small.png")
    [ "$size" -le "$most" ] && break
  done
  [ "$size" -le "$most" ] || fail "$to would have $size bytes, more than $most"
  mv "$work/small.png" "$here/$to"
  printf '%s: %d bytes, %d colours\n' "$to" "$size" "$colours"
}

# moment FOLDER LABEL TO: the first picture of a marked moment; a JPEG, because a camera's grain has
# more colours than a palette
moment() {
  local found=("$1"/view-*-"$2".png) size
  [ -f "${found[0]}" ] || fail "the session kept no picture of \"$2\""
  convert "${found[0]}" -strip -quality 85 "$here/$3"
  size=$(stat -c %s "$here/$3")
  [ "$size" -le "$most" ] || fail "$3 has $size bytes, more than $most"
  printf '%s: %d bytes\n' "$3" "$size"
}

cd "$work"
"$palpa" subclavian --operator expert --seed 1 --fast --out out/readme
moment out/readme phase-2 session.jpg

root=()
[ "$(id -u)" = 0 ] && root=(--no-sandbox)  # chromium refuses its sandbox to root

# page FILE HEIGHT TO [convert options...]: the top of a page
page() {
  local from=$1 height=$2 to=$3
  shift 3
  chromium --headless "${root[@]}" --disable-gpu --no-first-run --hide-scrollbars \
    --user-data-dir="$work/profile" --window-size=1000,"$height" \
    --screenshot="$work/$to" "file://$work/$from" >/dev/null 2>&1 ||
    fail "chromium could not draw $from"
  small "$to" "$to" "$@"
}

if command -v chromium >/dev/null; then
  page out/readme/report.html 1580 report.png
  "$palpa" palpation --preset abdomen --operator expert --seed 2001 --fast --no-views --quiet \
    --out palpation >/dev/null
  page palpation/report.html 1900 palpation.png -crop 920x665+30+1100 +repage
  "$palpa" search --operator expert --mode all --trials 20 --seed 3001 --fast --no-views --quiet \
    --out search >/dev/null
  page search/report.html 900 search.png -crop 1000x850+0+10 +repage
  "$palpa" calibrate all --seed 3 --quiet --out station3 >/dev/null
  page station3/calibration.html 1480 calibration.png
else
  echo "report.png, palpation.png, search.png and calibration.png are left as they were:" \
    "chromium is not installed"
fi
