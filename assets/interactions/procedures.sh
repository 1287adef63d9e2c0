#!/bin/bash
# Makes the profiles of procedures.json anew from simulated experts: the shipped ones, and two of
# each kind who are brisker and calmer. What the library says in words, its cues and the rules for
# labels are kept. Or judges the library by 30 recordings of others: the shipped novices, steady and
# hasty hands, other patients and seeds.
#   PALPA=build/check/palpa bash assets/interactions/procedures.sh learn
#   PALPA=build/check/palpa bash assets/interactions/procedures.sh judge FOLDER
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

pressures() {  # a palpation operator's file, its pressures in N
  sed -Ezi "s/(\"pressures_N\": *)\[[^]]*\]/\1[$2]/" "$work/$1.json"
}

learning_hands() {
  vary search_expert search_a scan_speed_mm_per_s=40 stroke_speed_mm_per_s=60 \
    settle_speed_mm_per_s=2.5 press_N=1.2 stroke_press_N=0.4 tremor_rms_mm=0.08 \
    grip_stiffness_N_per_m=750 stroke_s=0.6
  vary search_expert search_b scan_speed_mm_per_s=31 stroke_speed_mm_per_s=40 \
    settle_speed_mm_per_s=1.2 press_N=1.0 stroke_press_N=0.5 tremor_rms_mm=0.1 \
    grip_stiffness_N_per_m=500 grip_damping_Ns_per_m=6 stroke_s=1.2
  vary palpation_expert palpation_a travel_speed_mm_per_s=130 press_speed_mm_per_s=22 \
    tremor_rms_mm=0.1 grip_stiffness_N_per_m=900 strip_mm=9 step_mm=9
  vary palpation_expert palpation_b travel_speed_mm_per_s=55 press_speed_mm_per_s=12 \
    tremor_rms_mm=0.1 grip_stiffness_N_per_m=600 strip_mm=10 step_mm=10
  pressures palpation_b "0.3, 0.6"
  vary expert needle_a travel_speed_mm_per_s=90 push_speed_mm_per_s=9 advance_speed_mm_per_s=8 \
    withdraw_speed_mm_per_s=14 turn_time_s=1.0 pause_s=0.3 tremor_rms_mm=0.09 \
    turn_tremor_rms_deg=0.2 entry_sd_mm=3 depth_sd_mm=1.5 direction_sd_deg=4
  vary expert needle_b travel_speed_mm_per_s=45 push_speed_mm_per_s=4.5 \
    advance_speed_mm_per_s=4 withdraw_speed_mm_per_s=8 turn_time_s=2.4 pause_s=1.2 \
    tremor_rms_mm=0.1 turn_tremor_rms_deg=0.2 entry_sd_mm=3 depth_sd_mm=2 normal_sd_deg=5 \
    direction_sd_deg=4 guide_deg=1
}

judging_hands() {
  vary search_expert search_a scan_speed_mm_per_s=36 stroke_speed_mm_per_s=52 \
    settle_speed_mm_per_s=1.8 press_N=0.8 stroke_press_N=0.35 tremor_rms_mm=0.06 \
    grip_stiffness_N_per_m=680 stroke_s=1.0
  vary search_novice search_b scan_speed_mm_per_s=38 stroke_speed_mm_per_s=55 \
    settle_speed_mm_per_s=2 press_N=1.3 stroke_press_N=0.45 tremor_rms_mm=0.12 \
    grip_stiffness_N_per_m=550
  vary palpation_expert palpation_a travel_speed_mm_per_s=80 press_speed_mm_per_s=18 \
    tremor_rms_mm=0.08 grip_stiffness_N_per_m=700 strip_mm=8 step_mm=8
  vary palpation_novice palpation_b travel_speed_mm_per_s=110 press_speed_mm_per_s=20 \
    tremor_rms_mm=0.15
  pressures palpation_b 0.4
  vary expert needle_a travel_speed_mm_per_s=60 push_speed_mm_per_s=7 advance_speed_mm_per_s=6 \
    withdraw_speed_mm_per_s=12 turn_time_s=1.8 pause_s=0.8 tremor_rms_mm=0.08 \
    turn_tremor_rms_deg=0.15 entry_sd_mm=2 depth_sd_mm=1.2 direction_sd_deg=3
  vary novice needle_b travel_speed_mm_per_s=80 push_speed_mm_per_s=8 advance_speed_mm_per_s=9 \
    withdraw_speed_mm_per_s=13 turn_time_s=1.6 pause_s=0.6 tremor_rms_mm=0.14
}

record() {  # name, seed, then the session's command
  "$palpa" "${@:3}" --seed "$2" "${common[@]}" --out "$work/$1" >"$work/$1.txt"
  files+=("$work/$1/session.palpa")
}

sessions() {  # the shipped hand, the first seed
  local i=0 hand what
  for hand in "$1" "$work/search_a.json" "$work/search_b.json"; do
    for what in real augmented degraded; do
      i=$((i + 1))
      record "search-$i" $(($2 + 100 + i)) search --operator "$hand" --mode $what --trials 3
    done
  done
  i=0
  for hand in "$1" "$work/palpation_a.json" "$work/palpation_b.json"; do
    for what in breast abdomen prostate; do
      i=$((i + 1))
      record "palpation-$i" $(($2 + 200 + i)) palpation --preset $what --operator "$hand" \
        --trials 1
    done
  done
  i=0
  for hand in "$1" "$work/needle_a.json" "$work/needle_b.json"; do
    for _ in 1 2 3; do
      i=$((i + 1))
      record "needle-$i" $(($2 + 300 + i)) paracentesis --operator "$hand" \
        --patient-seed $(($2 + 300 + i)) --trials 3
    done
  done
  i=0
  for hand in "$1" "$work/needle_a.json" "$work/needle_b.json"; do
    i=$((i + 1))
    record "pin-$i" $(($2 + 400 + i)) train --task "$here/../tasks/bone_pin.json" \
      --operator "$hand" --trials 4
  done
}

case ${1:-} in
  learn)
    learning_hands
    sessions expert 1000
    "$palpa" calibrate procedures --library "$here/procedures.json" --from "${files[@]}" \
      --out "$here/procedures.json"
    ;;
  judge)
    judging_hands
    sessions novice 9000
    "$palpa" calibrate subtasks "${files[@]}" --library "$here/procedures.json" \
      --out "${2:?a folder}"
    ;;
  *)
    echo "usage: procedures.sh learn | judge FOLDER" >&2
    exit 2
    ;;
esac
