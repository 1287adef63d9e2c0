# Sourced by `run` and `check`: installs what is missing, builds. Needs: $top (the checkout).

say() { printf '\033[1m%s\033[0m\n' "$*" >&2; }
fail() {
  printf 'palpa: %s\n' "$*" >&2
  exit 1
}

# packages KIND...: names of the packages of these kinds
packages() {
  local kind
  for kind in "$@"; do
    sed -n "s/^$kind  *//p" "$top/cmake/packages.txt"
  done |
    tr ' ' '\n' |
    sed '/^$/d'
}

missing() {
  local name
  for name in "$@"; do
    [ "$(dpkg-query -W -f='${db:Status-Status}' "$name" 2>/dev/null)" = installed ] || echo "$name"
  done
}

as_root() {
  if [ "$(id -u)" = 0 ]; then
    "$@"
  elif command -v sudo >/dev/null; then
    sudo "$@"
  else
    fail "installing packages needs root: run as root, or install sudo," \
      "or install these yourself: ${want[*]}"
  fi
}

# install_missing YES KIND...: asks unless root or YES is 1
install_missing() {
  local yes=$1
  shift
  command -v dpkg-query >/dev/null && command -v apt-get >/dev/null ||
    fail "this script installs Debian packages; on another system install the counterparts of" \
      "cmake/packages.txt and use cmake"
  local want
  mapfile -t want < <(missing $(packages "$@"))
  [ ${#want[@]} -eq 0 ] && return
  say "To install with apt-get (${#want[@]} packages and what they need," \
    "about 2 GB the first time):"
  printf '  %s\n' "${want[*]}" >&2
  if [ "$(id -u)" != 0 ] && [ "$yes" != 1 ]; then
    read -r -p "Install them now? [y/N] " answer || true
    case "$answer" in
      y|Y|yes) ;;
      *) fail "nothing was installed" ;;
    esac
  fi
  as_root apt-get update -qq || fail "apt-get update failed: is there a network?"
  as_root env DEBIAN_FRONTEND=noninteractive \
    apt-get install -y -qq --no-install-recommends "${want[@]}" >/dev/null ||
    fail "apt-get could not install the packages; the lines above say why"
}

# As many as there are processors, and as 2.5 GB of memory for each allow: many
# files are compiled at once.
compile_jobs() {
  local available fit processors
  available=$(sed -n 's/^MemAvailable: *\([0-9]*\) kB/\1/p' /proc/meminfo)
  fit=$((available / 2500000))
  processors=$(nproc)
  [ "$fit" -lt 1 ] && fit=1
  echo $((fit < processors ? fit : processors))
}

# build PRESET [cmake options...] -- [targets...]
build() {
  local preset=$1
  shift
  local options=()
  while [ $# -gt 0 ] && [ "$1" != -- ]; do
    options+=("$1")
    shift
  done
  [ $# -gt 0 ] && shift
  mkdir -p "$top/build"
  local log="$top/build/configure-$preset.log" stamp="$top/build/$preset/.configured-with"
  if [ ! -f "$top/build/$preset/build.ninja" ] ||
    [ "$(cat "$stamp" 2>/dev/null)" != "${options[*]}" ]; then
    say "Configuring ($preset) ..."
    (cd "$top" && cmake --preset "$preset" "${options[@]}" >"$log" 2>&1) || {
      tail -n 20 "$log" >&2
      fail "configuring failed; see $log"
    }
    echo "${options[*]}" >"$stamp"
  fi
  (
    cd "$top" &&
      cmake --build "build/$preset" --parallel "$(compile_jobs)" ${1:+--target "$@"} >&2
  ) || fail "the build failed; the lines above say why"
}
