#!/usr/bin/env bash
# Writes the drawing of docs/architecture.md, an SVG, to standard output: how data flow from a
# picture to an overlay, from a reading to a force, and from a trial to a report. Needs only bash.
#   assets/pictures/data_flow.sh >assets/pictures/guide/data-flow.svg
# tests/guide compares the drawing in the tree with what this writes, and looks for the folders that
# it names. Colours: Okabe and Ito's; line styles say the same without colour.
set -euo pipefail

columns=(40 210 380 550 720)  # left edges, px
width=148                     # of a box
tall=78                       # of a box
green='#009E73' blue='#0072B2' red='#D55E00' gray='#555555'

escaped() {
  local text=${1//&/&amp;}
  text=${text//</&lt;}
  printf '%s' "${text//>/&gt;}"
}

# words CLASS X Y TEXT
words() { printf '<text class="%s" x="%d" y="%d">%s</text>\n' "$1" "$2" "$3" "$(escaped "$4")"; }

# lane Y HEIGHT COLOUR TITLE RATES
lane() {
  printf '<rect x="10" y="%d" width="880" height="%d" rx="8" fill="%s" fill-opacity=".09"/>\n' \
    "$1" "$2" "$3"
  printf '<rect x="10" y="%d" width="880" height="4" fill="%s"/>\n' "$1" "$3"
  printf '<text class="title" x="868" y="%d">%s<tspan class="rates" dx="10">%s</tspan></text>\n' \
    $(($1 + 26)) "$(escaped "$4")" "$(escaped "$5")"
}

# lines X Y LINE...: the words in a box; its first line is the name, lines with a slash are folders
lines() {
  local x=$(($1 + width / 2)) y=$(($2 + 20)) line
  words name "$x" "$y" "$3"
  shift 3
  for line in "$@"; do
    y=$((y + 16))
    case $line in
      '') ;;
      */*) words folder "$x" "$y" "$line" ;;
      *) words note "$x" "$y" "$line" ;;
    esac
  done
}

# box COLUMN Y HEIGHT COLOUR LINE...
box() {
  local x=${columns[$1]} y=$2 height=$3 colour=$4
  shift 4
  printf '<rect x="%d" y="%d" width="%d" height="%d" rx="5" fill="#fff" stroke="%s"/>\n' \
    "$x" "$y" "$width" "$height" "$colour"
  lines "$x" "$y" "$@"
}

# file COLUMN Y COLOUR LINE...: a sheet with a folded corner
file() {
  local x=${columns[$1]} y=$2 colour=$3 fold=14
  shift 3
  printf '<path d="M%d,%d h%d l%d,%d v%d h-%d z" fill="#fff" stroke="%s"/>\n' \
    "$x" "$y" $((width - fold)) "$fold" "$fold" $((tall - fold)) "$width" "$colour"
  printf '<path d="M%d,%d v%d h%d" fill="none" stroke="%s"/>\n' \
    $((x + width - fold)) "$y" "$fold" "$fold" "$colour"
  lines "$x" "$y" "$@"
}

# arrow CLASS PATH: call (one step after the other), latest or queue (between threads)
arrow() { printf '<path class="%s" d="%s" marker-end="url(#head)"/>\n' "$1" "$2"; }

# next CLASS COLUMN Y [left]: from a box's side to its neighbour's
next() {
  local from=$((columns[$2] + width + 2)) to=$((columns[$2 + 1] - 3))
  [ "${4:-}" = left ] && arrow "$1" "M$((to + 1)),$3 H$((from + 1))" || arrow "$1" "M$from,$3 H$to"
}

picture_to_overlay() {
  lane 10 134 "$green" 'From a picture to an overlay' 'camera 15 Hz, scene 30 Hz'
  box 0 50 $tall "$green" Camera 'webcam, recording' 'or virtual bench' ar/cameras
  box 1 50 $tall "$green" Board 'its tags or corners,' 'found in the picture' ar/boards
  box 2 50 $tall "$green" "Camera's pose" 'solved, filtered,' 'predicted: X_CW' ar/tracking
  box 3 50 $tall "$green" Frame 'picture, pose, tool' 'and words, at one time' apps/trial
  box 4 50 $tall "$green" Overlay 'patient and needle' 'over the picture' scene/view
  next call 0 89
  next call 1 89
  next latest 2 89
  next call 3 89
}

patient() {
  box 2 186 62 "$gray" 'Geometry, 60 Hz' 'shapes near the tool' anatomy/query
  box 4 186 62 "$gray" Patient 'meshes, landmarks' anatomy/patient
  arrow call 'M718,217 H531'
  arrow call 'M794,184 V131'
  arrow latest 'M454,250 V315'
  words label 462 268 'snapshot'
  arrow latest 'M284,274 V168 H624 V131'
  words label 292 162 'the tool: pose and forces'
}

reading_to_force() {
  lane 278 230 "$blue" 'From a reading to a force' 'haptic loop, 1 to 4 kHz'
  box 0 318 174 "$blue" Device "the hand's position" 'and buttons' '' haptics/devices \
    'or, simulated,' apps/twin '' 'a force to the hand'
  box 1 318 $tall "$blue" Reading 'plausible, or no force' 'in the same tick' haptics/safety
  box 2 318 $tall "$blue" Contact 'needle, probe, real thing' haptics/contact haptics/modulation
  box 3 318 $tall "$blue" Blend 'a new snapshot takes' 'over in 10 ms' haptics/loop
  box 4 318 $tall "$blue" Cues 'what the task adds to' 'make things felt' haptics/augmentation
  box 4 414 $tall "$blue" Passivity 'no energy is made' 'at the hand' haptics/safety
  box 3 414 $tall "$blue" 'Safety limiter' 'last stage,' 'always on' haptics/safety
  next latest 0 357
  next call 1 357
  next call 2 357
  next call 3 357
  arrow call 'M794,398 V411'
  next call 3 453 left
  arrow latest 'M548,453 H191'
  words label 300 446 'command: a force, in N'
}

trial_to_report() {
  lane 554 242 "$red" 'From a trial to a report' 'task 60 Hz, recorder 10 Hz'
  box 0 594 $tall "$red" Task 'leads through trials' apps/trial apps/task_needle
  box 1 594 $tall "$red" Assessment 'phases, errors, score' 'and its reasons' apps/assess
  box 2 594 $tall "$red" Report 'what happened, what' 'it cost, and why' apps/report
  file 3 594 "$red" report.html 'one page, without' 'a network'
  file 4 594 "$red" trials.csv 'a row for each' 'scored trial'
  box 0 702 $tall "$red" Recorder 'empties the queues' 'every 100 ticks' apps/runtime
  file 1 702 "$red" session.palpa 'every tick, event' 'and trial' apps/record
  box 2 702 $tall "$red" Evidence 'judged again by' 'the same rules' apps/evidence
  box 3 702 $tall "$red" Records 'of many sessions,' 'by pseudonym' apps/record/store
  box 4 702 $tall "$red" Pages 'trainee, group, study' apps/report/practice apps/report/study
  for column in 0 1 2; do next call $column 633; done
  for column in 0 1 2 3; do next call $column 741; done
  arrow queue 'M114,674 V699'
  arrow call 'M454,700 V675'
  arrow call 'M500,674 V688 H794 V675'
}

between_loop_and_task() {
  arrow queue 'M24,508 V633 H37'
  arrow queue 'M24,632 V741 H37'
  words label 32 530 'flight records'
  arrow latest 'M160,592 V511'
  words label 168 530 'commands: armed, force feedback, cues'
}

legend() {
  local y=818
  arrow call "M40,$y H78"
  words label 86 $((y + 4)) 'directly'
  arrow latest "M200,$y H238"
  words label 246 $((y + 4)) 'between threads: the latest value'
  arrow queue "M510,$y H548"
  words label 556 $((y + 4)) 'between threads: a queue, nothing overwritten'
}

cat <<'SVG'
<svg xmlns="http://www.w3.org/2000/svg" width="900" height="838" viewBox="0 0 900 838">
<title>How data flow in a needle session</title>
<style>
text { font-family: "DejaVu Sans", Verdana, Arial, sans-serif; font-size: 11px; fill: #222; }
.name, .note, .folder { text-anchor: middle; }
.name { font-size: 13px; font-weight: bold; }
.folder { font-family: "DejaVu Sans Mono", Menlo, Consolas, monospace; fill: #444; }
.title { font-size: 15px; font-weight: bold; text-anchor: end; }
.rates { font-size: 12px; font-weight: normal; fill: #444; }
rect, path { stroke-width: 1.5; }
.call, .latest, .queue { fill: none; stroke: #333; }
.latest { stroke-dasharray: 5 3; }
.queue { stroke-width: 3; }
</style>
<defs><marker id="head" viewBox="0 0 10 10" refX="8" refY="5" markerWidth="9" markerHeight="9"
markerUnits="userSpaceOnUse" orient="auto"><path d="M0,0 L10,5 L0,10 z" fill="#333"/></marker>
</defs>
<rect width="900" height="838" fill="#fff"/>
SVG
picture_to_overlay
reading_to_force
trial_to_report
patient
between_loop_and_task
legend
echo '</svg>'
