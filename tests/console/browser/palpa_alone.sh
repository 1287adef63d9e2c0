#!/usr/bin/env bash
# palpa_alone.sh PALPA WORK: the program without a word, where there is a display: it begins a
# console and opens its page in the browser, which is a script here.
set -euo pipefail
palpa=$(realpath "$1") work=$(realpath -m "$2")
rm -rf "$work" && mkdir -p "$work/bin" "$work/run" && chmod 700 "$work/run"
cat >"$work/bin/xdg-open" <<OPEN
#!/bin/sh
printf "%s\\n" "\$@" >"$work/opened.part" && mv "$work/opened.part" "$work/opened"
OPEN
chmod +x "$work/bin/xdg-open"
export HOME=$work XDG_RUNTIME_DIR=$work/run XDG_DATA_HOME=$work/data LC_ALL=C.UTF-8 DISPLAY=:77
unset PALPA_RECORDS XDG_STATE_HOME
PATH=$work/bin:$PATH "$palpa" >"$work/said.txt" 2>&1 &
console=$!
trap 'kill -KILL $console 2>/dev/null || true' EXIT
for _ in $(seq 300); do
  [ -f "$work/opened" ] && break
  kill -0 $console || {
    cat "$work/said.txt"
    exit 1
  }
  sleep 0.1
done
url=$(cat "$work/opened")
case $url in
  http://127.0.0.1:*/) ;;
  *)
    echo "opened: $url"
    exit 1
    ;;
esac
curl -fsS "$url" | grep -q '<title>' || {
  echo "no page at $url"
  exit 1
}
kill -INT $console
wait $console || {
  echo "exit code $?"
  cat "$work/said.txt"
  exit 1
}
grep -q 'The console has ended' "$work/said.txt"
