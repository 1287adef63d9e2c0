#!/usr/bin/env bash
# at_a_console.sh PALPA WORK day|week|room|learning|words: starts a console of PALPA on an empty
# virtual bench in the folder WORK and lives an educator's day or week at it in Chromium, or
# watches a room of two stations from it, or is sent there by a learning management system.
# Exits with 77 (skipped) and says why where Chromium, Node or the two libraries cannot be had.
set -euo pipefail
palpa=$(realpath "$1") work=$(realpath -m "$2") part=$3 more=()
here=$(cd "$(dirname "$0")" && pwd)
top=$(cd "$here/../../.." && pwd)
. "$top/cmake/npm_package.sh"

skip() {
  echo "skipped: $*"
  exit 77
}

[ -x "${PALPA_CHROMIUM:-/usr/bin/chromium}" ] || skip "no Chromium (Debian: chromium)"
command -v node >/dev/null || skip "no Node (Debian: nodejs)"
rm -rf "$work" && mkdir -p "$work"
cp "$here"/*.mjs "$here/package.json" "$top/assets/console/language.js" "$work"
if [ "$part" = week ]; then  # with a study that ends within the week
  mkdir -p "$work/assets/protocols"
  ln -s "$top"/assets/* "$work/assets" 2>/dev/null || true  # "protocols" is there
  cp -r "$top/assets/protocols/." "$here/week_study.json" "$work/assets/protocols"
  export PALPA_ASSETS=$work/assets
  # As where tablets come to it: it asks for a token, and is encrypted.
  head -c 24 /dev/urandom | base64 >"$work/token" && chmod 600 "$work/token"
  PALPA_CONSOLE_TOKEN=$(cat "$work/token")
  export PALPA_CONSOLE_TOKEN
  more=(--tls --token-file "$work/token" --name station.test)
fi

if [ "$part" = week ] && [ "${PALPA_FULL:-0}" = 1 ]; then  # a room that can be filmed: by a film
  "$palpa" subclavian --operator expert --fast --no-views --record-video --quiet \
    --out "$work/filmed" >/dev/null
  more+=(--room-camera "$work/filmed/camera.mjpeg")
  export PALPA_ROOM_CAMERA=1
fi

if [ "$part" = room ]; then
  broker=$(PATH=$PATH:/usr/sbin command -v mosquitto) || skip "no broker (Debian: mosquitto)"
  port=$(node -e 'const s = require("net").createServer().listen(0, "127.0.0.1", () => {
    console.log(s.address().port); s.close(); })')
  "$palpa" console pair bench1 --broker localhost --port "$port" --room "$work/room" \
    --out "$work/bench1" >/dev/null
  "$palpa" console pair bench2 --room "$work/room" --out "$work/bench2" >/dev/null
  more=(--room "$work/room")
fi

# The browser's driver and axe: each one file of the registry, without further
# libraries, known by its sum.
mkdir -p "$work/node_modules"
while read -r name version sum; do
  place=$work/node_modules/$name
  if [ -f "$here/node_modules/$name/package.json" ]; then
    cp -r "$here/node_modules/$name" "$place"
    continue
  fi
  fetch_npm_package "$name" "$version" "$work/$name.tgz" ||
    skip "$name $version could not be fetched from registry.npmjs.org"
  is_npm_package "$work/$name.tgz" "$sum" || {
    echo "$name $version is not what it should be"
    exit 1
  }
  unpack_npm_package "$work/$name.tgz" "$place"
done <"$here/libraries.txt"

run=$(mktemp -d)  # a short name: a socket's path has 107 bytes
export HOME=$work XDG_RUNTIME_DIR=$run LC_ALL=C.UTF-8
unset DISPLAY PALPA_RECORDS XDG_DATA_HOME XDG_STATE_HOME
# begin.sh [--port N]: starts the console and waits until it is there. Kills the one before, as a
# power cut would.
cat >"$work/begin.sh" <<BEGIN
if [ -f "$work/pid" ]; then
  before=\$(cat "$work/pid")
  kill -KILL "\$before"
  while grep -qv ') Z ' "/proc/\$before/stat" 2>/dev/null; do sleep 0.05; done
fi
setsid "$palpa" console --no-open --home "$work/home" --records "$work/records.sqlite" \\
  ${more[*]} "\$@" >"$work/console.txt" 2>&1 </dev/null &
echo \$! >"$work/pid"
for _ in \$(seq 300); do
  grep -q '^The console: ' "$work/console.txt" && exit 0
  kill -0 \$(cat "$work/pid") 2>/dev/null || {
    cat "$work/console.txt"
    exit 1
  }
  sleep 0.1
done
exit 1
BEGIN
# A session goes on without its console: one that a failed day left would run for ever.
leave() {
  kill "$(cat "$work/pid")" ${room[@]+"${room[@]}"} 2>/dev/null || true
  grep -lsaFf <(echo "$run/palpa/") /proc/[0-9]*/cmdline |
    while IFS=/ read -r _ _ pid _; do kill "$pid" 2>/dev/null || true; done || true
  rm -rf "$run"
}
room=()
trap leave EXIT
if [ "$part" = room ]; then
  "$broker" -c "$work/room/mosquitto.conf" >"$work/broker.txt" 2>&1 &
  room+=($!)
  for station in bench1 bench2; do
    "$palpa" console --no-open --home "$work/home-$station" --records "$work/records.sqlite" \
      --room "$work/$station" >"$work/$station.txt" 2>&1 &
    room+=($!)
  done
fi
bash "$work/begin.sh"
url=$(sed -n 's/^The console: //p' "$work/console.txt")
cd "$work"
export PALPA_PROGRAM=$palpa PALPA_CONSOLE_HOME=$work/home
export PALPA_CONSOLE_BEGIN=$work/begin.sh PALPA_CONSOLE_URL=$url PALPA_CONSOLE_SHOTS=$work/pictures
if [ "$part" = room ]; then  # once both have come, the second one leaves
  for _ in $(seq 300); do
    [ "$(curl -sf "${url}api/room" | grep -o '"present":true' | wc -l)" = 2 ] && break
    sleep 0.2
  done
  kill "${room[2]}"
fi
if [ "$part" = day ]; then
  # Beside a package.json that says what kind of module it is.
  cp "$top/assets/console/moments.js" "$work"
  PALPA_CONSOLE_PAGES=$work node --test moments.test.mjs
fi
node --test "$part.test.mjs"
