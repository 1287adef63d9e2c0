# Sourced: expectations that are counted and told; the script ends with `finish`.
failures=0
expect() {   # WORDS COMMAND...: the command succeeds
  local words=$1
  shift
  if "$@" >/dev/null 2>&1; then
    printf 'ok    %s\n' "$words"
  else
    printf 'FAIL  %s\n' "$words"
    failures=$((failures + 1))
  fi
}

timed() {   # WORDS COMMAND...: the same, its output kept in $answer, its time told
  local words=$1 begun=$SECONDS
  shift
  if answer=$("$@" 2>&1); then
    printf 'ok    %s (%d s)\n' "$words" $((SECONDS - begun))
  else
    printf 'FAIL  %s\n%s\n' "$words" "$(tail -n 5 <<<"$answer")"
    failures=$((failures + 1))
  fi
}

finish() {
  if [ "$failures" = 0 ]; then
    echo "all as expected"
  else
    echo "$failures expectations failed"
    exit 1
  fi
}
