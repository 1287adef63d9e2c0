#!/usr/bin/env bash
# nearby.sh PROGRAM: two computers, each a namespace with a D-Bus and an avahi-daemon of its own: a
#   console that others can reach is found by the console that watches a room, is told as paired
#   once it is, is gone when it is killed; the daemon is gone and back.
set -uo pipefail
palpa=$1
. "$(dirname "$0")/two_networks.sh"
in_networks -rnm "avahi-daemon dbus-daemon" "$0" "$@"
enter_work

# Only one user is known here: the daemon's folder is given to whom it runs as usually.
printf 'root:x:0:0::/:/bin/sh\navahi:x:0:0::/:/bin/sh\n' >passwd
printf 'root:x:0:\navahi:x:0:\n' >group
mount --bind passwd /etc/passwd && mount --bind group /etc/group || fail "no users of its own"
mount -t tmpfs none /run || fail "no folder of its own for what runs"
unshare -nm sleep 600 &
there=$!
sleep 0.2
there() { nsenter -t $there -n -m "$@"; }
begin_there() { exec nsenter -t $there -n -m "$@"; }  # in the background: the program itself
there mount -t tmpfs none /run
ip link set lo up
ip link add wire type veth peer name wire-there
ip link set wire-there netns $there
there ip link set lo up
ip addr add 10.78.0.1/24 dev wire && ip link set wire up
there ip addr add 10.78.0.2/24 dev wire-there && there ip link set wire-there up

# bus_of NAME INTERFACE: what a D-Bus and an avahi-daemon of one computer are told
bus_of() {
  cat >"$1.bus" <<BUS
<busconfig><type>system</type><listen>unix:path=$work/$1.socket</listen><auth>EXTERNAL</auth>
<policy context="default"><allow user="*"/><allow own="*"/><allow send_destination="*"/>
<allow receive_sender="*"/></policy></busconfig>
BUS
  printf '[server]\nhost-name=%s\nuse-ipv6=no\nallow-interfaces=%s\nratelimit-burst=1000\n' \
    "$1" "$2" >"$1.avahi"
}
bus_of desk wire
bus_of bench wire-there
dbus-daemon --config-file="$work/desk.bus" --nofork 2>desk-bus.log &
begin_there dbus-daemon --config-file="$work/bench.bus" --nofork 2>bench-bus.log &
soon "no D-Bus" test -S desk.socket -a -S bench.socket
kOwn="--no-drop-root --no-chroot --no-rlimits"
begin_avahi() {
  DBUS_SYSTEM_BUS_ADDRESS=unix:path=$work/desk.socket exec avahi-daemon $kOwn -f desk.avahi
}
begin_avahi >desk-avahi.log 2>&1 &
avahi=$!
DBUS_SYSTEM_BUS_ADDRESS=unix:path=$work/bench.socket begin_there \
  avahi-daemon $kOwn -f "$work/bench.avahi" >bench-avahi.log 2>&1 &

"$palpa" console pair other --broker 10.78.0.1 --room "$work/room" >/dev/null || fail "no room"
head -c 24 /dev/urandom | base64 >token
chmod 600 token
DBUS_SYSTEM_BUS_ADDRESS=unix:path=$work/desk.socket "$palpa" console --no-open \
  --home "$work/watch" --port 8090 --room "$work/room" >watch.log 2>&1 &
station() {
  DBUS_SYSTEM_BUS_ADDRESS=unix:path=$work/bench.socket begin_there "$palpa" console --no-open \
    --home "$work/station" --listen 10.78.0.2 --port 8443 --token-file "$work/token" "$@" \
    >station.log 2>&1
}
station &
at_bench=$!
room() { curl -sf http://127.0.0.1:8090/api/room; }
shows() { room | grep -q "$1"; }
hides() { room >/dev/null && ! room | grep -q "$1"; }
found='"host":"bench.local","name":"Palpa on bench","port":8443,"station":""'
soon "the console there was not found" shows "$found"
shows '"nearby_trouble":""' || fail "something is wrong: $(room)"

kill -KILL $at_bench
soon "who is gone is still told" hides "Palpa on bench"
"$palpa" console pair one --room "$work/room" >/dev/null || fail "no pairing"
station --room "$work/one.palpa-pairing" &
at_bench=$!
soon "it does not stand for itself" there curl -skf https://10.78.0.2:8443/
sleep 2  # time to be told as a stranger, which it is not
hides "Palpa on bench" || fail "a paired station is told as a stranger: $(room)"
"$palpa" console pair one --forget --room "$work/room" >/dev/null || fail "not forgotten"
soon "one of another room is not told" shows '"station":"one"'

kill $avahi
soon "that the daemon is gone is not told" shows "avahi-daemon does not answer"
hides "Palpa on bench" || fail "who cannot be seen is still told"
begin_avahi >desk-avahi.log 2>&1 &
soon "nobody was found again" shows '"station":"one"'
soon "it is still told that the daemon is gone" shows '"nearby_trouble":""'
