#!/usr/bin/env bash
# fault_campaign.sh PROGRAM FAULTS [COUNT]: COUNT short sessions (default 30; PALPA_FULL=1: 1,000),
# each struck by one fault from outside at a moment that follows from its number. Of each:
#   - it ends by itself, and with words: in order, or with a line "palpa: ..." of ours
#   - the evidence opens and replays to the last bit, as far as it was recorded
#   - `palpa finish` lists what has no report, then makes report and table; nothing is left beside
# FAULTS: the library of tests/computer_faults, the stand-in for a drive and a clock that fail. A
# full disk is a small tmpfs where this user may mount one, else that library, too.
set -uo pipefail
palpa=$1 faults=$2
count=${3:-30}
[ $# -lt 3 ] && [ "${PALPA_FULL:-}" = 1 ] && count=1000
top=$(cd "$(dirname "$0")/../.." && pwd)
library_words=$top/tests/support/library_words.txt
kinds=(
  'disk full' 'drive broken' 'memory' 'descriptors' 'size of files' 'killed' 'stopped'
  'asked to end' 'clock jumps' 'records lost'
)
longest_s=120  # of a session of a second, on a loaded computer
nothing_yet=40000   # bytes of evidence that says not yet what it is
no_tick_yet=100000  # that says it; with the first 200 ticks there are more

work=$(mktemp -d)
clean() {
  local place
  for place in "$work"/*/disk; do mountpoint -q "$place" && umount "$place"; done 2>/dev/null
  rm -rf "$work"
}
trap clean EXIT
trap 'exit 130' INT TERM
unset DISPLAY PALPA_RECORDS

# With one picture a second, which are most of a session's computing.
sed 's/"rate_Hz": [0-9]*/"rate_Hz": 1/' "$top/assets/stations/palpation_bench.json" \
  >"$work/station.json"
session=(squeeze --station "$work/station.json" --operator expert --fast --no-views --quiet
  --trials 2)

mkdir -p "$work/probe/disk"
if mount -t tmpfs -o size=64k tmpfs "$work/probe/disk" 2>/dev/null; then
  umount "$work/probe/disk"
  full_disk='a tmpfs'
else
  full_disk='a library loaded before the program'
fi
echo "disk full: $full_disk; drive broken, clock jumps: a library loaded before the program"

for little in $(seq 100 50 3000); do  # MB with which the program starts at all
  (ulimit -v $((1024 * little)) && "$palpa" --version) >/dev/null 2>&1 && break
done

for few in $(seq 4 40); do  # open files with which it starts
  (ulimit -n $few && "$palpa" --version) >/dev/null 2>&1 && break
done

# One trainee's records, and a session without a fault.
export HOME=$work XDG_STATE_HOME=$work/state XDG_DATA_HOME=$work/data
"$palpa" records trainee add --id T001 --consent --records "$work/records.sqlite" >/dev/null &&
  "$palpa" "${session[@]}" --out "$work/undisturbed" --records "$work/records.sqlite" \
    --trainee T001 >"$work/said" 2>&1
if [ $? != 0 ]; then
  echo "FAIL  without a fault a session does not end in order"
  cat "$work/said"
  exit 1
fi

# between LOW HIGH: a number that follows from the fault's own
between() { drawn=$(($1 + (RANDOM * 32768 + RANDOM) % ($2 - $1 + 1))); }

# ---- one fault: its kind in $kind; $here its folder, $out the session's, $pid the program's

complain() {   # WORDS
  printf '%s\n' "fault $number, $kind: $1" >>"$here/complaints"
}

running() { kill -0 "$pid" 2>/dev/null; }

# begin COMMAND...: the session by way of this command, which ends with the program's words
begin() {
  "$@" "$palpa" "${session[@]}" --seed $number --out "$out" --records "$here/records.sqlite" \
    --trainee T001 >"$here/said" 2>"$here/complained" &
  pid=$!
}

limited() {   # OPTION VALUE COMMAND...: under this limit of the shell's
  ulimit "$1" "$2" && shift 2 && exec "$@"
}

loaded() {   # FAULT AFTER COMMAND...
  PALPA_FAULT=$1 PALPA_FAULT_AFTER=$2 LD_PRELOAD=$faults exec "${@:3}"
}

after_a_while() {   # somewhere in the session, its start and its end included
  between 0 110
  sleep $((drawn / 100)).$(printf %02d $((drawn % 100)))
}

lose_records() {
  local records=$here/records.sqlite
  between 0 3
  case $drawn in
    0) rm -f "$records"* ;;
    1) echo 'something else, but long enough to be a file' >"$records" ;;
    2) truncate -s 700 "$records" 2>/dev/null ;;
    3) rm -f "$records"*; mkdir -p "$records" ;;
  esac
}

strike() {
  case $kind in
    'disk full')
      between 40 5000
      if [ "$full_disk" = 'a tmpfs' ]; then
        mkdir "$here/disk"
        mount -t tmpfs -o size=${drawn}k tmpfs "$here/disk"
        out=$here/disk/session
        begin
      else
        begin loaded 'drive fills' $((drawn / 3))
      fi
      ;;
    'drive broken') between 0 1600; begin loaded 'broken drive' $drawn ;;
    'memory') between $((1024 * little)) $((1024 * (little + 250))); begin limited -v $drawn ;;
    'descriptors') between $few $((few + 10)); begin limited -n $drawn ;;
    'size of files') between 8 5000; begin limited -f $drawn ;;
    'clock jumps') begin loaded 'date jumps' 0 ;;
    *) begin; after_a_while ;;
  esac
  case $kind in
    'killed') kill -KILL $pid ;;
    'stopped') kill -STOP $pid && sleep 1 && kill -CONT $pid ;;
    'asked to end') local asking=(INT TERM HUP QUIT); kill -${asking[RANDOM % 4]} $pid ;;
    'records lost') lose_records ;;
  esac 2>/dev/null
}

await_end() {
  local left=$((10 * longest_s))
  while running; do
    if [ $((left--)) = 0 ]; then
      complain 'hangs'
      kill -KILL $pid
    fi
    sleep 0.1
  done
  wait $pid
  code=$?
} 2>/dev/null

# ---- what must be true afterwards

foreign() { grep -qFf "$library_words" "$1"; }

# worded FILE CODE: what ended so said why
worded() {
  foreign "$1" && complain "a library's words: $(head -n 2 "$1")"
  [ "$2" = 0 ] && return
  case $2 in 1 | 2) ;; *) complain "ends with $2: $(head -n 2 "$1")" ;; esac
  grep -q '^palpa: .' "$1" || complain "no words: $(head -n 2 "$1")"
}

evidence_bytes() { cat "$out"/session.palpa "$out"/session.palpa-wal 2>/dev/null | wc -c; }

outcome_has_words() {
  if [ "$kind" = killed ] && [ $code = 137 ]; then
    outcome='killed'
    return
  fi
  if [ "$kind" = 'asked to end' ] && [ $code -gt 128 ] &&
    [ "$(evidence_bytes)" -le $nothing_yet ]; then
    outcome='ends as any program does'  # before it was a session
    return
  fi
  outcome="ends with $code"
  worded "$here/complained" $code
}

evidence_holds() {
  [ -e "$out/session.palpa" ] || return 1
  "$palpa" replay "$out/session.palpa" >"$here/replayed" 2>"$here/replay_said"
  local replay=$?
  worded "$here/replay_said" $replay
  if [ $replay = 0 ]; then
    grep -q 'run again: 0 differ' "$here/replayed" || complain "$(head -n 2 "$here/replayed")"
    return 0
  fi
  if grep -q ': holds no tick' "$here/replay_said"; then
    [ "$(evidence_bytes)" -le $no_tick_yet ] || complain 'its ticks are lost'
    outcome="$outcome, before the first tick"
    return 0
  fi
  [ "$(evidence_bytes)" -le $nothing_yet ] || complain "no replay: $(cat "$here/replay_said")"
  return 1
}

session_is_finished() {
  if ! [ -s "$out/report.html" ] || ! [ -s "$out/trials.csv" ]; then
    outcome="$outcome, finished later"
    "$palpa" finish 2>&1 | grep -qF "palpa finish $out" || complain 'is not among the unfinished'
  fi
  "$palpa" finish "$out" >"$here/finished" 2>"$here/finish_said"
  local finish=$?
  worded "$here/finish_said" $finish
  [ $finish = 0 ] || complain "cannot be finished: $(cat "$here/finish_said")"
  [ -s "$out/report.html" ] || complain 'no report'
  [ -s "$out/trials.csv" ] || complain 'no table'
}

nothing_beside() {
  local left
  left=$(find "$here" -name '*.part*' -print)
  [ -z "$left" ] || complain "left behind: $left"
}

one_fault() {   # NUMBER
  number=$1 kind=${kinds[$1 % ${#kinds[@]}]} here=$work/$1 outcome=
  out=$here/session RANDOM=$number
  mkdir -p "$here"
  export HOME=$here XDG_STATE_HOME=$here/state XDG_DATA_HOME=$here/data
  cp "$work/records.sqlite" "$here/records.sqlite"
  strike
  await_end
  outcome_has_words
  [ "$kind" = 'disk full' ] && mountpoint -q "$here/disk" &&
    mount -o remount,size=64m "$here/disk"
  if evidence_holds; then
    session_is_finished
    nothing_beside
  else
    outcome="$outcome, before anything was recorded"
  fi
  mountpoint -q "$here/disk" && umount "$here/disk"
  [ -e "$here/complaints" ] && outcome="$outcome, NOT AS IT MUST BE"
  printf '%-16s %s\n' "$kind" "$outcome" >>"$work/outcomes"
  cat "$here/complaints" 2>/dev/null >>"$work/all_complaints"
  rm -rf "$here"
}

for number in $(seq "$count"); do
  while [ "$(jobs -rp | wc -l)" -ge "$(nproc)" ]; do wait -n; done
  one_fault "$number" &
  [ $((number % 50)) = 0 ] && echo "$number of $count"
done
wait

sort "$work/outcomes" | uniq -c
struck=$(wc -l <"$work/outcomes")
recorded=$(grep -Evc 'before (anything|the first tick)' "$work/outcomes")
[ $((2 * recorded)) -ge "$count" ] ||
  echo "only $recorded of $count sessions recorded anything" >>"$work/all_complaints"
if [ "$struck" != "$count" ] || [ -s "$work/all_complaints" ]; then
  echo "FAIL  $struck of $count faults judged"
  cat "$work/all_complaints" 2>/dev/null
  exit 1
fi
echo "all $count as expected"
