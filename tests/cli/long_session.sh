#!/usr/bin/env bash
# long_session.sh PROGRAM window [MINUTES]: a session of a simulated expert in real time, with its
#   window on a display of its own, for two hours (MINUTES); what it holds grows by at most 20 MB
#   after the first ten minutes (the first twelfth), however long it goes on.
# long_session.sh PROGRAM trials [COUNT]: a session of 1,000 trials (COUNT) in virtual time holds
#   less than 400 MB.
# Both need PALPA_FULL=1, MINUTES or COUNT; skipped otherwise, code 77.
set -uo pipefail
palpa=$1 kind=$2 asked=${3:-}
if [ -z "$asked" ] && [ "${PALPA_FULL:-}" != 1 ]; then
  echo "Skipped: takes hours; with PALPA_FULL=1"
  exit 77
fi
work=$(mktemp -d)
program= server=
trap 'kill -KILL $program $server 2>/dev/null; rm -rf "$work"' EXIT
trap 'exit 130' INT TERM
export HOME=$work XDG_STATE_HOME=$work/state XDG_DATA_HOME=$work/data
fail() {
  echo "FAIL: $*"
  tail -n 5 "$work/said.txt" 2>/dev/null
  exit 1
}

# kilobytes in memory, from now on to the program's end or for SECONDS, each second
watch() {
  local until=$((SECONDS + $1))
  while [ $SECONDS -lt $until ] && kill -0 $program 2>/dev/null; do
    sed -n 's/^VmRSS:[^0-9]*\([0-9]*\) kB/\1/p' /proc/$program/status
    sleep 1
  done >"$work/kilobytes"
}
middle() { sort -n | sed -n "$((($1 + 1) / 2))p"; }   # of so many numbers

case $kind in
  window)
    command -v Xvfb >/dev/null || { echo "Skipped: Xvfb is not installed"; exit 77; }
    minutes=${asked:-120}
    Xvfb -displayfd 3 -screen 0 1280x800x24 3>"$work/display" 2>/dev/null &
    server=$!
    until [ -s "$work/display" ]; do
      kill -0 $server 2>/dev/null || fail "Xvfb does not start"
      sleep 0.1
    done
    # It lives in real time, the tests beside it do not.
    DISPLAY=:$(cat "$work/display") nice -n -5 "$palpa" subclavian --display window \
      --operator expert --trials 1000 --quiet --out "$work/session" >"$work/said.txt" 2>&1 &
    program=$!
    watch $((60 * minutes))
    kill -TERM $program || fail "the session has ended by itself"
    wait $program || fail "the session ends with $?"
    [ -s "$work/session/report.html" ] || fail "no report"
    settled=$((5 * minutes)) span=$((60 * minutes / 24))  # measured each second
    first=$(sed -n "$((settled - span / 2)),$((settled + span / 2))p" "$work/kilobytes" |
      middle $span)
    last=$(tail -n $span "$work/kilobytes" | middle $span)
    echo "$minutes minutes with a window: $((first / 1000)) MB after the first twelfth," \
      "$((last / 1000)) MB at the end, $(($(wc -l <"$work/session/trials.csv") - 1)) trials"
    echo "MB at each twelfth:" $(awk -v step=$((5 * minutes)) 'NR % step == 0 {
      printf "%d ", $1 / 1000 }' "$work/kilobytes")
    [ $((last - first)) -le 20000 ] || fail "it grew by $((last - first)) kB"
    ;;
  trials)
    trials=${asked:-1000}
    "$palpa" subclavian --fast --no-views --operator expert --trials "$trials" --quiet \
      --out "$work/session" >"$work/said.txt" 2>&1 &
    program=$!
    watch 36000
    wait $program || fail "the session ends with $?"
    [ "$(wc -l <"$work/session/trials.csv")" = $((trials + 1)) ] || fail "trials are missing"
    most=$(sort -n "$work/kilobytes" | tail -n 1)
    echo "$trials trials in virtual time: $((most / 1000)) MB at most"
    [ "$most" -lt 400000 ] || fail "it held $most kB"
    ;;
  *) fail "what is '$kind'? window or trials" ;;
esac
