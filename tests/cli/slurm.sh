#!/usr/bin/env bash
# slurm.sh PROGRAM [SEEDS]: the same campaign of short sessions, four a seed (default 2 seeds;
# PALPA_FULL=1: 250), by one process and through Slurm on this computer; with more than two seeds by
# two processes, too. The table is the same to the byte; a cancelled array goes on with what is
# missing, and computes nothing twice.
# Its own munged, slurmctld and slurmd run in a folder of their own, as this user. Without the
# programs (Debian: slurmctld slurmd slurm-client munge): skipped, code 77.
set -uo pipefail
palpa=$1 seeds=${2:-2}
[ $# -lt 2 ] && [ "${PALPA_FULL:-}" = 1 ] && seeds=250
sessions=$((4 * seeds))
top=$(cd "$(dirname "$0")/../.." && pwd)
for program in munged slurmctld slurmd sbatch scontrol squeue scancel; do
  command -v $program >/dev/null || PATH=$PATH:/usr/sbin:/sbin
  command -v $program >/dev/null || {
    echo "Skipped: there is no $program (packages slurmctld, slurmd, slurm-client, munge)"
    exit 77
  }
done

work=$(mktemp -d)
chmod 755 "$work"
fail() {
  echo "FAIL: $*"
  tail -n 20 "$work"/*.log 2>/dev/null
  exit 1
}
clean() {
  local name
  for name in slurmd slurmctld munged; do
    [ -s "$work/$name.pid" ] && kill "$(cat "$work/$name.pid")"
  done 2>/dev/null
  wait
  rm -rf "$work"
}
trap clean EXIT
trap 'exit 130' INT TERM
unset DISPLAY PALPA_RECORDS
export HOME=$work XDG_STATE_HOME=$work/state SLURM_CONF=$work/slurm.conf

# ---- a cluster of one computer

free_port() {
  local port
  for port in $(seq $((20000 + RANDOM % 10000)) 32000); do
    (exec 3<>"/dev/tcp/127.0.0.1/$port") 2>/dev/null || { echo "$port"; return; }
  done
}
mkdir "$work/saved" "$work/spool" "$work/munge"
chmod 700 "$work/munge"
dd if=/dev/urandom of="$work/munge/key" bs=128 count=1 status=none
chmod 600 "$work/munge/key"
munged --foreground --force --key-file="$work/munge/key" --socket="$work/munge.socket" \
  --pid-file="$work/munged.pid" --log-file="$work/munged.log" --seed-file="$work/munge/seed" \
  --num-threads=1 >"$work/munged_said.log" 2>&1 &
node=$(hostname -s)
cat >"$SLURM_CONF" <<CONF
ClusterName=palpa
SlurmctldHost=$node(127.0.0.1)
AuthType=auth/munge
AuthInfo=socket=$work/munge.socket
CredType=cred/munge
SlurmUser=$(id -un)
SlurmdUser=$(id -un)
SlurmctldPort=$(free_port)
SlurmdPort=$(free_port)
SlurmctldPidFile=$work/slurmctld.pid
SlurmdPidFile=$work/slurmd.pid
SlurmctldLogFile=$work/slurmctld.log
SlurmdLogFile=$work/slurmd.log
StateSaveLocation=$work/saved
SlurmdSpoolDir=$work/spool
ProctrackType=proctrack/linuxproc
TaskPlugin=task/none
SwitchType=switch/none
MpiDefault=none
SelectType=select/cons_tres
SelectTypeParameters=CR_Core
ReturnToService=2
SchedulerParameters=sched_interval=2
MinJobAge=10
NodeName=$node NodeAddr=127.0.0.1 CPUs=2 RealMemory=4000 State=UNKNOWN
PartitionName=all Nodes=ALL Default=YES MaxTime=INFINITE State=UP
CONF
within() {   # SECONDS WORDS COMMAND...: until it succeeds
  local look seconds=$1 words=$2
  shift 2
  for look in $(seq $((5 * seconds))); do
    "$@" >/dev/null 2>&1 && return
    sleep 0.2
  done
  fail "$words"
}
within 30 "munged does not start" test -S "$work/munge.socket"
slurmctld -D >>"$work/slurmctld_said.log" 2>&1 &
within 60 "slurmctld does not answer" scontrol ping
slurmd -D -N "$node" >>"$work/slurmd_said.log" 2>&1 &
idle() { sinfo -h -o %T | grep -qx idle; }
within 120 "the node does not become idle" idle

# ---- the campaign

sed 's/"rate_Hz": [0-9]*/"rate_Hz": 1/' "$top/assets/stations/palpation_bench.json" \
  >"$work/station.json"
cat >"$work/campaign.json" <<JSON
{"version": 1, "id": "slurm", "title": "Comparisons", "tasks": ["$top/assets/tasks/squeeze.json"],
 "station": "station.json", "operators": ["expert", "novice"],
 "seeds": {"from": 1, "count": $seeds},
 "settings": [{"name": "touch"}, {"name": "no_touch", "force_feedback": false}]}
JSON
campaign() { "$palpa" campaign "$work/campaign.json" --keep table --quiet "$@"; }
campaign --out "$work/one" --jobs 1 >"$work/one.txt" || fail "one process: $(cat "$work/one.txt")"
if [ "$seeds" -gt 2 ]; then
  campaign --out "$work/two" --jobs 2 >"$work/two.txt" || fail "two: $(cat "$work/two.txt")"
  cmp "$work/one/trials.csv" "$work/two/trials.csv" || fail "two processes give another table"
fi

parts=$((sessions < 8 ? sessions : 8))
campaign --out "$work/many" --slurm $parts >"$work/campaign.sbatch" || fail "no script"
results() { find "$work/many/results" -mindepth 1 -maxdepth 1 2>/dev/null | wc -l; }
gone() { [ -z "$(squeue -h)" ]; }
cd "$work" || fail "no folder"

# Cancelled once a few are there.
sbatch campaign.sbatch >"$work/sbatch.txt" 2>&1 || fail "sbatch: $(cat "$work/sbatch.txt")"
few() { [ "$(results)" -ge 2 ]; }
within 600 "no job makes a result" few
scancel --signal=KILL --full --name=palpa-slurm 2>/dev/null
scancel --name=palpa-slurm
within 120 "cancelled jobs do not end" gone
first=$(results)
echo "cancelled after $first of $sessions sessions"
find "$work/many/results" -name trials.csv -printf '%f %p %T@\n' | sort >"$work/before.txt"

# The same array again, to its end.
sbatch campaign.sbatch >"$work/sbatch.txt" 2>&1 || fail "sbatch: $(cat "$work/sbatch.txt")"
within $((600 + 20 * sessions)) "the array does not end" gone
campaign --out "$work/many" --collect >"$work/collect.txt" 2>&1 ||
  fail "collecting: $(cat "$work/collect.txt" "$work"/many/slurm-*.txt)"
find "$work/many/results" -name trials.csv -printf '%f %p %T@\n' | sort >"$work/after.txt"
[ "$(comm -23 "$work/before.txt" "$work/after.txt" | wc -l)" = 0 ] ||
  fail "what was done before was done again"
cmp "$work/one/trials.csv" "$work/many/trials.csv" || fail "the tables differ"
[ "$(wc -l <"$work/many/trials.csv")" = $((sessions + 1)) ] || fail "there are not $sessions trials"
echo "$sessions sessions through Slurm: the same bytes as by one process"
