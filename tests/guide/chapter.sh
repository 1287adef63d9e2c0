# Sourced by what chapter.cpp makes of a page: its commands, one after the other, in one shell, as a
# reader types them. Told on standard output; the first that goes wrong ends it.
# Wants: work (an empty folder), source, build, program.
set -u
home=$work/home here=$work/here said=$work/said skipped=$work/skipped
mkdir -p "$home" "$here" "$work/bin" "$work/runtime"
chmod 700 "$work/runtime"
ln -s "$program" "$work/bin/palpa"
# As in the source tree, or with `ln -s /usr/share/palpa/assets assets`.
ln -s "$source/assets" "$here/assets"
: >"$skipped"
export HOME=$home LC_ALL=C.UTF-8 XDG_RUNTIME_DIR=$work/runtime XDG_CONFIG_HOME=$home/.config
export XDG_DATA_HOME=$home/.local/share XDG_STATE_HOME=$home/.local/state
export PATH=$work/bin:$PATH PALPA_SOURCE=$source PALPA_BUILD=$build
unset DISPLAY WAYLAND_DISPLAY PALPA_RECORDS PALPA_ASSETS XR_RUNTIME_JSON
cd "$here" || exit 1
console= port=

# Root's Chromium refuses its sandbox, and no run may touch another's
# profile. A reader needs neither.
chromium() {
  local root=()
  [ "$(id -u)" = 0 ] && root=(--no-sandbox)
  command chromium "${root[@]}" --disable-gpu --no-first-run --disable-background-networking \
    --user-data-dir="$work/profile" "$@"
}

fail() {   # LINE WORDS
  printf 'FAIL  line %s: %s\n' "$1" "$2"
  [ -s "$said" ] && tail -n 20 "$said"
  close_console quietly
  exit 1
}

answers() { (exec 3<>"/dev/tcp/127.0.0.1/$1") 2>/dev/null; }

free_port() {
  local p
  for p in $(seq $((20000 + RANDOM % 10000)) 32000); do
    answers "$p" && continue
    echo "$p"
    return
  done
}

# The console ends with Ctrl-C, which a page cannot type: it is started, must answer, and goes on
# until the chapter's end, as in a terminal of its own.
open_console() {   # LINE COMMAND
  close_console
  eval "exec $2" >"$work/console" 2>&1 </dev/null &
  console=$!
  for _ in $(seq 100); do
    grep -q 'The console: ' "$work/console" && break
    kill -0 "$console" 2>/dev/null || break
    sleep 0.1
  done
  local address
  address=$(sed -n 's,^The console: http://[^:]*:\([0-9]*\)/.*,\1,p' "$work/console")
  [ -n "$address" ] && answers "$address" || {
    cat "$work/console"
    fail "$1" "the console does not answer"
  }
  exec 4<>"/dev/tcp/127.0.0.1/$address"
  printf 'GET / HTTP/1.1\r\nHost: 127.0.0.1:%s\r\nConnection: close\r\n\r\n' "$address" >&4
  timeout 5 cat <&4 >"$said"
  exec 4>&-
  grep -qi '<html' "$said" || fail "$1" "the console gives no page"
  sleep 6   # until it has asked whether the station is well: a picture of that page should say so
}

close_console() {
  [ -n "$console" ] || return 0
  kill -TERM "$console"
  wait "$console"
  local code=$?
  console=
  [ "${1:-}" = quietly ] || [ "$code" = 0 ] || {
    cat "$work/console"
    fail end "the console exits with $code"
  }
}

command_of() {   # LINE WANTED TEXT
  local line=$1 wanted=$2 text=$3 begun=$SECONDS got
  if [[ $text == *8765* ]]; then
    port=${port:-$(free_port)}
    text=${text//8765/$port}
  fi
  printf 'line %s: %s\n' "$line" "$text"
  case $text in
    'palpa console pair'* | 'palpa console learning'*) ;;  # end by themselves
    'palpa console'*)
      open_console "$line" "$text"
      return
      ;;
    chromium*)
      if ! type -P chromium >/dev/null; then
        echo "      skipped: chromium is not installed"
        echo "$line" >>"$skipped"
        return
      fi
      ;;
  esac
  eval "$text" >"$said" 2>&1 </dev/null
  got=$?
  [ "$got" = "$wanted" ] || fail "$line" "exits with $got, not with $wanted"
  [ $((SECONDS - begun)) -lt 3 ] || printf '      %d s\n' $((SECONDS - begun))
}
