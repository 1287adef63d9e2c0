#!/usr/bin/env bash
# Two builds of Palpa side by side: do they make the same sessions? For a change that must not
# change any (moving, renaming, tidying).
#
#   tests/session/same_sessions.sh record PALPA DIR        the listed sessions, with this build
#   tests/session/same_sessions.sh compare PALPA DIR_A DIR_B
#       same trials.csv, same samples of every tick (exported by PALPA); then every session in
#       DIR_A is replayed by PALPA, tick for tick
#
# Exit code 1, and a line for each, where they differ.
set -euo pipefail
here=$(cd "$(dirname "$0")" && pwd)

sessions() { grep -v '^#' "$here/same_sessions.txt"; }

record() {
  local palpa=$1 out=$2 number=0 arguments
  mkdir -p "$out"
  while read -r arguments; do
    number=$((number + 1))
    [ -e "$out/$number/done" ] && continue
    rm -rf "${out:?}/$number"
    (
      cd "$here/../.."
      # shellcheck disable=SC2086  # a line holds several words
      "$palpa" $arguments --fast --no-views --quiet --out "$out/$number" \
        >/dev/null 2>"$out/$number.log"
    ) && touch "$out/$number/done" || echo "failed: $arguments ($out/$number.log)"
  done < <(sessions)
}

compare() {
  local palpa=$1 a=$2 b=$3 number=0 different=0 arguments
  while read -r arguments; do
    number=$((number + 1))
    same "$palpa" "$a/$number" "$b/$number" || {
      different=$((different + 1))
      echo "differs: $arguments"
    }
  done < <(sessions)
  echo "$number sessions, $different differ"
  [ "$different" = 0 ]
}

# same PALPA A B: of one session
same() {
  local palpa=$1 a=$2 b=$3 folder
  for folder in "$a" "$b"; do
    [ -e "$folder/ticks.csv" ] ||
      "$palpa" export "$folder/session.palpa" --out "$folder/ticks.csv" >/dev/null
  done
  cmp "$a/trials.csv" "$b/trials.csv" && cmp "$a/ticks.csv" "$b/ticks.csv" &&
    "$palpa" replay "$a/session.palpa" >/dev/null
}

case "${1:-}" in
  record) record "$2" "$3" ;;
  compare) compare "$2" "$3" "$4" ;;
  *)
    sed -n '2,11s/^# \{0,1\}//p' "$0"
    exit 2
    ;;
esac
