# two_networks.sh, sourced by a test of two computers: a network and a folder of its own, and what
# is waited for.

# in_networks FLAGS "TOOL..." SCRIPT ARGUMENT...: the script goes on in namespaces of its own, made
# by unshare's FLAGS, where all tools are there.
in_networks() {
  local flags=$1 tools=$2
  shift 2
  [ -z "${PALPA_TWO_NETWORKS:-}" ] || return 0
  for tool in unshare ip curl $tools; do
    command -v $tool >/dev/null || [ -x /usr/sbin/$tool ] || {
      echo "Skipped: $tool is not installed"
      exit 77
    }
  done
  unshare "$flags" true 2>/dev/null || {
    echo "Skipped: no network of its own may be made here"
    exit 77
  }
  PALPA_TWO_NETWORKS=1 exec unshare "$flags" bash "$@"
}
fail() {
  echo "$1"
  tail -n 5 "$work"/*.log
  exit 1
}
# soon WORDS COMMAND...: within a minute
soon() {
  local words=$1
  shift
  for _ in $(seq 300); do
    "$@" >/dev/null 2>&1 && return
    sleep 0.2
  done
  fail "$words"
}
# In a folder that passes, which nothing of the user's is outside of.
enter_work() {
  PATH=$PATH:/usr/sbin:/sbin
  work=$(mktemp -d)
  trap 'kill $(jobs -p) 2>/dev/null; wait 2>/dev/null; rm -rf "$work"' EXIT
  trap 'exit 130' INT TERM
  export HOME=$work XDG_STATE_HOME=$work/state XDG_DATA_HOME=$work/data XDG_RUNTIME_DIR=$work/run
  # Nobody is announced on a real network.
  export DBUS_SYSTEM_BUS_ADDRESS=unix:path=$work/none
  mkdir -m 700 "$work/run"
  cd "$work" || exit 1
}
