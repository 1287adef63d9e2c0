#!/usr/bin/env bash
# What the tests of each program took together when ctest last ran them, the longest first.
#   tests/seconds.sh [build/check/Testing/Temporary]
set -euo pipefail
results=${1:-$(dirname "$0")/../build/check/Testing/Temporary}
awk '
  $1 == "---" { exit }
  { sub(/\..*/, "", $1); seconds[$1] += $3 }
  END { for (name in seconds) printf "%s %.0f\n", name, seconds[name] }
' "$results/CTestCostData.txt" | sort -k2,2nr -k1,1
