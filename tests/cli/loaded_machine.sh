#!/usr/bin/env bash
# loaded_machine.sh PROGRAM fast|real [COUNT]: 20 sessions (COUNT) of a simulated expert beside 16
#   processes that take all the time they get. In virtual time all end with report and trials.csv;
#   in real time at least half of them, and each of the others says in a line why it did not.
# Needs PALPA_FULL=1 or COUNT; skipped otherwise, code 77.
set -uo pipefail
palpa=$1 kind=$2 asked=${3:-}
if [ -z "$asked" ] && [ "${PALPA_FULL:-}" != 1 ]; then
  echo "Skipped: takes an hour; with PALPA_FULL=1"
  exit 77
fi
count=${asked:-20}
work=$(mktemp -d)
busy=()
trap 'kill -KILL "${busy[@]}" 2>/dev/null; rm -rf "$work"' EXIT
trap 'exit 130' INT TERM
export HOME=$work XDG_STATE_HOME=$work/state XDG_DATA_HOME=$work/data
for _ in $(seq 16); do
  bash -c 'while :; do :; done' &
  busy+=($!)
done

how=()
[ "$kind" = fast ] && how=(--fast)
ended=0 silent=0
for seed in $(seq "$count"); do
  out=$work/$seed
  timeout 600 "$palpa" subclavian --operator expert "${how[@]}" --quiet --seed "$seed" \
    --out "$out" >/dev/null 2>"$work/said.txt"
  code=$?
  if [ $code = 0 ] && [ -s "$out/report.html" ] && [ "$(wc -l <"$out/trials.csv")" -ge 2 ]; then
    ended=$((ended + 1))
  else
    echo "Session $seed, exit code $code: $(tail -n 1 "$work/said.txt")"
    [ $code = 1 ] && [ -s "$work/said.txt" ] || silent=$((silent + 1))
  fi
done
echo "$ended of $count sessions ended with report and table"
least=$count
[ "$kind" = real ] && least=$((count / 2))
[ "$ended" -ge "$least" ] && [ "$silent" = 0 ]
