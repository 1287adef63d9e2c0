#!/bin/bash
# Makes the profiles of procedures.json anew from simulated experts: the shipped ones, and two of
# each kind who are brisker and calmer. What the library says in words, its cues and the rules for
# labels are kept.
#   PALPA=build/check/palpa bash assets/interactions/procedures.sh
set -euo pipefail
palpa=${PALPA:-palpa}
here=$(cd "$(dirname "$0")" && pwd)
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
common=(--fast --quiet --no-views --tracking model)
files=()

vary() {  # an operator's file, the new one, name=value ...
  cp "$here/../operators/$1.json" "$work/$2.json"
  for change in "${@:3}"; do
    sed -Ezi "s/(\"${change%%=*}\": *\{[^}]*\"value\": *)[-0-9.]+/\1${change#*=}/" "$work/$2.json"
  done
}
vary search_expert search_brisk scan_speed_mm_per_s=40 stroke_speed_mm_per_s=60 \
  settle_speed_mm_per_s=2.5 press_N=1.2 stroke_press_N=0.4 tremor_rms_mm=0.08 \
  grip_stiffness_N_per_m=750 stroke_s=0.6
vary search_expert search_calm scan_speed_mm_per_s=31 stroke_speed_mm_per_s=40 \
  settle_speed_mm_per_s=1.2 press_N=1.0 stroke_press_N=0.5 tremor_rms_mm=0.1 \
  grip_stiffness_N_per_m=500 grip_damping_Ns_per_m=6 stroke_s=1.2
vary palpation_expert palpation_brisk travel_speed_mm_per_s=130 press_speed_mm_per_s=22 \
  tremor_rms_mm=0.1 grip_stiffness_N_per_m=900 strip_mm=9 step_mm=9
vary palpation_expert palpation_calm travel_speed_mm_per_s=55 press_speed_mm_per_s=12 \
  tremor_rms_mm=0.1 grip_stiffness_N_per_m=600 strip_mm=10 step_mm=10
sed -Ezi 's/("pressures_N": *)\[[^]]*\]/\1[0.3, 0.6]/' "$work/palpation_calm.json"
vary expert needle_brisk travel_speed_mm_per_s=90 push_speed_mm_per_s=9 advance_speed_mm_per_s=8 \
  withdraw_speed_mm_per_s=14 turn_time_s=1.0 pause_s=0.3 tremor_rms_mm=0.09 \
  turn_tremor_rms_deg=0.2 entry_sd_mm=3 depth_sd_mm=1.5 direction_sd_deg=4
vary expert needle_calm travel_speed_mm_per_s=45 push_speed_mm_per_s=4.5 advance_speed_mm_per_s=4 \
  withdraw_speed_mm_per_s=8 turn_time_s=2.4 pause_s=1.2 tremor_rms_mm=0.1 turn_tremor_rms_deg=0.2 \
  entry_sd_mm=3 depth_sd_mm=2 normal_sd_deg=5 direction_sd_deg=4 guide_deg=1

record() {  # name, then the session's command
  "$palpa" "${@:2}" "${common[@]}" --out "$work/$1" >"$work/$1.txt"
  files+=("$work/$1/session.palpa")
}
i=0
for hand in expert "$work/search_brisk.json" "$work/search_calm.json"; do
  for mode in real augmented degraded; do
    i=$((i + 1))
    record "search-$i" search --operator "$hand" --mode $mode --trials 3 --seed $((1100 + i))
  done
done
i=0
for hand in expert "$work/palpation_brisk.json" "$work/palpation_calm.json"; do
  for preset in breast abdomen prostate; do
    i=$((i + 1))
    record "palpation-$i" palpation --preset $preset --operator "$hand" --trials 1 \
      --seed $((1200 + i))
  done
done
i=0
for hand in expert "$work/needle_brisk.json" "$work/needle_calm.json"; do
  for _ in 1 2 3; do
    i=$((i + 1))
    record "needle-$i" paracentesis --operator "$hand" --patient-seed $((1300 + i)) --trials 3 \
      --seed $((1300 + i))
  done
done
i=0
for hand in expert "$work/needle_brisk.json" "$work/needle_calm.json"; do
  i=$((i + 1))
  record "pin-$i" train --task "$here/../tasks/bone_pin.json" --operator "$hand" --trials 4 \
    --seed $((1400 + i))
done
"$palpa" calibrate procedures --library "$here/procedures.json" --from "${files[@]}" \
  --out "$here/procedures.json"
