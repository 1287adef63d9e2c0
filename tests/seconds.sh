#!/usr/bin/env bash
# What the tests of each program took together when ctest last ran them, the longest first.
#   tests/seconds.sh [build/check/Testing/Temporary]
set -euo pipefail
results=${1:-$(dirname "$0")/../build/check/Testing/Temporary}
awk '
  / Test: / { name = $3; sub(/\..*/, "", name) }
  /^Test time = / { seconds[name] += $4 }
  END { for (name in seconds) printf "%s %.0f\n", name, seconds[name] }
' "$results/LastTest.log" | sort -k2,2nr -k1,1
