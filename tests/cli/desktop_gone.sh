#!/usr/bin/env bash
# desktop_gone.sh PROGRAM PRESS BENCH: sessions in real time whose X server dies or hangs, whose
# window another program destroys, whose terminal hangs up. Each ends in order, with report and
# table.
# PRESS: presses a session's emergency stop by its socket. BENCH: the virtual bench's station file.
# PALPA_FULL=1: 50 of each, two at a time; otherwise one, and of the two ways to lose a window one.
set -uo pipefail
palpa=$1 press=$2 bench=$3
here=$(cd "$(dirname "$0")" && pwd)
. "$here/../package/expect.sh"
for tool in Xvfb xdotool; do
  command -v $tool >/dev/null || { echo "skipped: $tool is not installed"; exit 77; }
done
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
sessions=1
[ "${PALPA_FULL:-}" = 1 ] && sessions=50

# until SECONDS COMMAND...: the command succeeds before that
until_true() {
  local left=$((10 * $1))
  shift
  until "$@" 2>/dev/null; do
    [ $((left--)) -gt 0 ] || return 1
    sleep 0.1
  done
}
over() { ! kill -0 $program 2>/dev/null; }

begin() {   # a session of a simulated expert, in a window of a display of its own
  out=$place/$1
  rm -f "$place/display"
  Xvfb -displayfd 3 -screen 0 1280x800x24 3>"$place/display" 2>/dev/null &
  server=$!
  until_true 20 test -s "$place/display"
  export DISPLAY=:$(cat "$place/display")
  "$palpa" subclavian --station "$place/station.json" --display window --operator expert \
    --trials 9 --quiet --out "$out" --live "$out.live" >"$out.said" 2>&1 &
  program=$!
  until_true 120 test -s "$out/session.palpa"
  sleep $((1 + number % 3)).$((number % 10))  # another moment of the trial in each round
}

finished() {   # WORDS [pressed]: the program ends by itself; nothing is owed
  until_true 90 over
  wait $program
  local code=$?
  expect "$1: ends in order" test $code = 0
  expect "$1: report" test -s "$out/report.html"
  expect "$1: table" test -s "$out/trials.csv"
  [ "${2:-}" = pressed ] || expect "$1: nobody pressed the emergency stop" bash -c \
    "! grep -qi 'emergency stop' '$out/report.html'"
  [ $code = 0 ] || tail -n 5 "$out.said"
  kill -KILL $server 2>/dev/null
  wait $server 2>/dev/null
}

stopped() {   # from the tick that carries the stop on there is no force
  "$palpa" export "$out/session.palpa" --out "$out.csv" >/dev/null && awk -F, '
    NR == 1 { for (i = 1; i <= NF; ++i) at[$i] = i; next }
    $at["emergency_stop"] != 0 { ++ticks }
    ticks && ($at["emergency_stop"] == 0 || $at["f_command_D_x_N"] != 0 ||
              $at["f_command_D_y_N"] != 0 || $at["f_command_D_z_N"] != 0) { exit bad = 1 }
    END { exit bad || ticks < 1000 }' "$out.csv"
}

window() { xdotool search --onlyvisible --name '^Palpa$' | head -n 1; }

one_round() {   # NUMBER: a session of each kind
  number=$1 place=$work/$1 server= program=
  mkdir "$place"
  trap 'kill -KILL $server $program 2>/dev/null; rm -rf "$place"' EXIT
  export HOME=$place XDG_STATE_HOME=$place/state XDG_DATA_HOME=$place/data

  # The virtual bench with a stop pedal, whose end of the line is here.
  mkfifo "$place/foot"
  exec 9<>"$place/foot"
  sed "s#^{#{\"stop_pedal\": \"$place/foot\",#" "$bench" >"$place/station.json"

  begin server
  kill -KILL $server
  finished "X server killed"

  begin destroyed
  xdotool windowclose "$(window)"
  finished "window destroyed"

  if [ $sessions -gt 1 ]; then
    begin client
    xdotool windowkill "$(window)"
    finished "connection killed"
  fi

  begin terminal
  kill -HUP $program
  finished "terminal hung up"

  begin hung
  kill -STOP $server
  sleep 1
  expect "X server hangs: the stop is confirmed" "$press" "$out.live"
  sleep 3
  kill -TERM $program
  finished "X server hangs" pressed
  expect "X server hangs: no force after the stop" stopped
  expect "X server hangs: it is named" grep -q 'the picture does not answer' "$out/report.html"

  pedal_while_hung
}

# The same by the pedal alone: a key of it goes down (input_event: time, EV_KEY, KEY_B, 1).
pedal_while_hung() {
  begin pedal
  kill -STOP $server
  sleep 1
  printf '\0\0\0\0\0\0\0\0\0\0\0\0\0\0\0\0\1\0\60\0\1\0\0\0' >&9
  sleep 3
  kill -TERM $program
  finished "X server hangs, pedal" pressed
  expect "X server hangs, pedal: no force after the stop" stopped
}

for round in $(seq $sessions); do
  while [ "$(jobs -rp | wc -l)" -ge 2 ]; do wait -n; done
  (one_round "$round") >"$work/said.$round" 2>&1 &
  [ $((round % 10)) = 0 ] && echo "$round of $sessions"
done
wait
cat "$work"/said.* | sort | uniq -c
failures=$(cat "$work"/said.* | grep -c '^FAIL')
[ "$(cat "$work"/said.* | grep -c '^ok    X server hangs: it is named')" = $sessions ] ||
  expect "every round comes to its end" false
finish
