#!/usr/bin/env bash
# Makes assets/tasks/expert_ranges.json again: what the simulated experts reach in each shipped
# task, beside which a report shows a learner's trials. Their seeds and patients are not those of
# the expert path. PALPA names the program (./run where it is not given).
set -euo pipefail
top=$(cd "$(dirname "$0")/../.." && pwd)
palpa=${PALPA:-$top/run}
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
patients=25 trials=12  # of a needle one trial on each

held() {  # held NAME ARGUMENTS...
  local out=$work/$1
  shift
  "$palpa" train "$@" --operator expert --fast --no-views --tracking model --quiet --out "$out" >&2
}
for task in "$top"/assets/tasks/*.json; do
  grep -q '"engine"' "$task" || continue
  name=$(basename "$task" .json)
  printf '%s\n' "$name" >&2
  if grep -q '"expert_path"' "$task"; then
    for patient in $(seq 1 "$patients"); do
      held "$name-$patient" --task "$task" --patient-seed $((910000 + patient)) \
        --seed $((910000 + patient)) --trials 1 || echo "$name, patient $patient: left out" >&2
    done
  else
    held "$name" --task "$task" --seed 910001 --trials "$trials"
  fi
done
"$palpa" calibrate ranges --from "$work"/*/session.palpa \
  --made-by "bash assets/tasks/expert_ranges.sh" --out "$top/assets/tasks/expert_ranges.json"
