#!/usr/bin/env bash
# installed_tree.sh BUILD SOURCE: what `cmake --install` puts down works where it was put, and is
# whole: data found beside the program, manual page, completion, desktop entry, udev rule.
set -euo pipefail
build=$1 source=$2
here=$(cd "$(dirname "$0")" && pwd)
. "$here/expect.sh"
work=$build/tests/installed_tree
rm -rf "$work"
cmake --install "$build" --prefix "$work/first" >/dev/null
mv "$work/first" "$work/moved"   # nothing may hang on where it was put first
tree=$work/moved palpa=$work/moved/bin/palpa
mkdir -p "$work/home" && cd "$work/home"
export HOME=$work/home LC_ALL=C.UTF-8
unset PALPA_ASSETS PALPA_RECORDS XDG_STATE_HOME XDG_DATA_HOME DISPLAY

timed "doctor, from the moved tree" "$palpa" doctor --json
expect "its data are those beside it" grep -qF "\"$tree/share/palpa/assets\"" <<<"$answer"
# All data are there, none of the pictures of the README.
expect "data are complete" \
  diff -rq -x pictures -x '*.sh' "$source/assets" "$tree/share/palpa/assets"
pictures() { "$palpa" calibrate camera --images shot.png --board chessboard:9x6:0.025 2>&1; }
echo words >shot.png
expect "its codecs are those beside it" grep -qF "cannot be read as a picture" <<<"$(pictures)"
mv "$tree/lib/palpa" "$tree/lib/elsewhere"
expect "without them it says so" grep -qF "libpalpa_opencv_codecs.so: cannot" <<<"$(pictures)"
mv "$tree/lib/elsewhere" "$tree/lib/palpa"
expect "wrong PALPA_ASSETS is refused" bash -c "! PALPA_ASSETS=$work/home '$palpa' patient info"

page=$tree/share/man/man1/palpa.1.gz
zcat "$page" >page.1
expect "manual page has no faults" bash -c "[ -z \"\$(man --warnings -l page.1 2>&1 >page.txt)\" ]"
# Every option of every command, as its --help lists it, is in the page.
listed() { "$palpa" "$@" --help | sed -n '/^Subcommands:/,/^$/s/^  \([a-z-]*\) .*/\1/p'; }
commands=()
for one in $(listed); do
  below=$(listed "$one")
  [ -n "$below" ] || commands+=("$one")
  for two in $below; do
    further=$(listed "$one" "$two")
    [ -n "$further" ] || commands+=("$one $two")
    for three in $further; do
      commands+=("$one $two $three")
    done
  done
done
sed 's/\\-/-/g; s/\\f[BIR]//g' page.1 >plain.txt
missing=0 options=0
not_in_the_page() {
  echo "not in the page: $*"
  missing=1
}
options_of() {
  "$palpa" "$@" --help |
    grep -o '^  \(-[a-zA-Z],\)\?--[a-z0-9-]*' |
    grep -o '\-\-[a-z0-9-]*' |
    grep -vx -- --help
}
for command in "${commands[@]}"; do
  grep -qxF ".SS palpa $command" plain.txt || not_in_the_page "palpa $command"
  awk -v head=".SS palpa $command" '
    $0 == head {on = 1; next}
    /^\.S[SH]/ {on = 0}
    on' plain.txt >section.txt
  for option in $(options_of $command); do
    options=$((options + 1))
    grep -qE -- "^(-., )?$option( |$)" section.txt || not_in_the_page "palpa $command $option"
  done
done
expect "manual page names all ${#commands[@]} commands and their $options options" \
  [ "$missing" = 0 ]
missing=0
variables() {
  grep -rhoE '(getenv|environment)\("[A-Z_]+"\)' "$source"/{anatomy,apps,ar,haptics,scene} |
    grep -oE '[A-Z_]{2,}' |
    grep -vxE 'HOME|LANG|LC_ALL' |
    sort -u
}
for variable in $(variables); do
  grep -qw "$variable" plain.txt || not_in_the_page "$variable"
done
expect "manual page names every variable of the environment that is asked for" [ "$missing" = 0 ]
expect "that is a plausible number" [ ${#commands[@]} -ge 40 -a "$options" -ge 200 ]

# try WANTED WORD...: the completion of the last word
try() {
  local wanted=$1
  shift
  bash -c '
    . "$0"
    COMP_WORDS=("$@")
    COMP_CWORD=$(($# - 1))
    _palpa
    echo "${COMPREPLY[*]}"' "$tree/share/bash-completion/completions/palpa" "$@" >offered.txt
  expect "completion of \"$*\" offers \"$wanted\"" grep -qxF -- "$wanted" offered.txt
}
mkdir -p "results of May" && touch "my station.json"
try subclavian palpa sub
try "export" palpa records ex
try --format palpa records export --f
try "json" palpa records export --format j
try expert palpa subclavian --operator = ex
try "my station.json" palpa doctor --station my
try "results of May" palpa doctor --out res
try "" palpa subclavian --seed ""
try "my station.json" palpa replay my
try show palpa records sho

expect "desktop entry is valid" desktop-file-validate "$tree/share/applications/palpa.desktop"
exec_line=$(sed -n 's/^Exec=//p' "$tree/share/applications/palpa.desktop")
"$palpa" ${exec_line#palpa } --help >entry.txt
expect "its command exists: $exec_line" grep -qF "Usage: $exec_line" entry.txt
icon=$tree/share/icons/hicolor/scalable/apps/palpa.svg
expect "icon is a picture" [ "$(file -b --mime-type "$icon")" = image/svg+xml ]
expect "udev rule is for the Falcon, and for whoever sits there" \
  grep -q 'idVendor}=="0403".*idProduct}=="cb48".*uaccess' \
  "$tree/lib/udev/rules.d/60-palpa-falcon.rules"
expect "licence" grep -q Apache-2.0 "$tree/share/doc/palpa/copyright"
expect "changes" bash -c "zcat '$tree/share/doc/palpa/CHANGELOG.md.gz' | grep -q 0.1.0"
finish
