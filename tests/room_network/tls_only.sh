#!/usr/bin/env bash
# tls_only.sh PROGRAM TAP: a station in one network namespace, its room (broker, console that
#   watches, records on PostgreSQL where that is installed) in another; a session is prepared,
#   watched, stopped and ended from there, its trial goes into the records, while TAP listens in on
#   the wire between: TLS only. A plain word on that wire is found, too.
set -uo pipefail
palpa=$1 tap=$2
. "$(dirname "$0")/two_networks.sh"
in_networks -rn "mosquitto" "$0" "$@"
enter_work

unshare -n sleep 600 &
there=$!
sleep 0.2
ip link set lo up
ip link add wire type veth peer name wire-there
ip link set wire-there netns $there
room() { nsenter -t $there -n "$@"; }
begin_there() { exec nsenter -t $there -n "$@"; }  # in the background: the program itself
ip addr add 10.77.0.1/24 dev wire && ip link set wire up
room ip link set lo up
room ip addr add 10.77.0.2/24 dev wire-there && room ip link set wire-there up

# PostgreSQL refuses root, as whom we are here: it runs as another user of a namespace within.
postgres=$(ls -d /usr/lib/postgresql/*/bin 2>/dev/null | tail -n 1)
records=$work/records.sqlite
nobody() { room unshare -U --map-user=1000 --map-group=1000 "$@"; }
if [ -x "$postgres/postgres" ] && command -v openssl >/dev/null; then
  export PGPASSWORD=$(head -c 16 /dev/urandom | base64)
  printf '%s' "$PGPASSWORD" >password
  nobody "$postgres/initdb" -D "$work/data" -U palpa -A scram-sha-256 --pwfile password --no-sync \
    -E UTF8 --locale=C >postgres.log 2>&1 || fail "no database could be made"
  openssl req -x509 -newkey ec -pkeyopt ec_paramgen_curve:P-256 -nodes -days 2 -subj /CN=records \
    -addext subjectAltName=IP:10.77.0.2 -keyout data/server.key -out data/server.crt 2>/dev/null ||
    fail "no certificate for the records"
  chmod 600 data/server.key
  cp data/server.crt records.crt
  # No connection that is not encrypted.
  printf 'local all all scram-sha-256\nhostssl all all all scram-sha-256\n' >data/pg_hba.conf
  begin_there unshare -U --map-user=1000 --map-group=1000 "$postgres/postgres" -D "$work/data" \
    -h 10.77.0.2 -p 5432 -k "$work" -c ssl=on -c fsync=off >postgres.log 2>&1 &
  soon "PostgreSQL did not start" \
    psql -h "$work" -U palpa -d postgres -c 'CREATE DATABASE palpa'
  records="postgresql://palpa@10.77.0.2/palpa?sslmode=verify-full&sslrootcert=$work/records.crt"
fi
trials() { psql -h "$work" -U palpa -d palpa -Atc 'SELECT count(*) FROM trials'; }

"$palpa" console pair one --broker 10.77.0.2 --room "$work/room" >/dev/null || fail "no pairing"
"$tap" wire 5432 >tap.txt &
listens=$!
soon "the tap does not listen" grep -q listening tap.txt
begin_there mosquitto -c "$work/room/mosquitto.conf" >broker.log 2>&1 &
begin_there "$palpa" console --no-open --home "$work/watch" --port 8090 --room "$work/room" \
  >watch.log 2>&1 &
head -c 24 /dev/urandom | base64 >token
chmod 600 token
"$palpa" console --no-open --home "$work/station" --listen 10.77.0.1 --port 8443 \
  --token-file token --room one.palpa-pairing --records "$records" >station.log 2>&1 &
"$palpa" records trainee add --id T007 --consent --records "$records" >/dev/null ||
  fail "nobody came into the records"

at=http://127.0.0.1:8090
get() { room curl -sf "$at$1"; }
key() { get /api/me | sed 's/.*"page_key":"\([0-9a-f]*\)".*/\1/'; }
number() { head -c 16 /dev/urandom | od -An -tx1 | tr -d ' \n'; }
session() { get /api/room | sed 's/.*"session":"\([^"]*\)".*/\1/'; }
ask() {
  room curl -sf -X POST -H "Origin: $at" -H 'Content-Type: application/json' \
    -H "X-Palpa-Page: $(key)" -H "X-Palpa-Write: $(number)" -d "$1" "$at/api/room/one/ask"
}
stands() { get /api/room | grep -q "$1"; }
soon "the station did not come" stands '"present":true'
wish='{"task":"paracentesis","operator":"expert","trainee":"T007"}'
expert='{"ask":"prepare","session":"","wish":'$wish'}'
soon "no session was prepared" ask "$expert"
soon "no trial ran" stands '"state":"running"'
picture() { [ "$(get /api/room/one/picture | head -c 2 | od -An -tx1)" = " ff d8" ]; }
soon "no picture came" picture
ask "{\"ask\":\"pause\",\"session\":\"$(session)\"}" >/dev/null || fail "it was not paused"
ask "{\"ask\":\"stop\",\"session\":\"$(session)\"}" >/dev/null || fail "it was not stopped"
soon "the stop was not told" stands '"emergency_stop":true'
ask "{\"ask\":\"leave\",\"session\":\"$(session)\"}" >/dev/null || fail "it was not ended"
soon "it did not end" stands '"state":"free"'
events=$(get /api/room/one/events | grep -o '"number"' | wc -l)
[ "$events" -ge 5 ] || fail "only $events events came"

if [ "$records" != "$work/records.sqlite" ]; then
  arrived() { [ "$(trials)" -ge 1 ]; }
  soon "no trial came into the records" arrived
fi

kill $listens
wait $listens || {
  cat tap.txt
  fail "something went by that was no TLS"
}
tail -n 1 tap.txt

# The tap itself: a plain word, and it is told.
"$tap" wire 5432 >plain.txt &
listens=$!
soon "the tap does not listen" grep -q listening plain.txt
curl -s -m 5 http://10.77.0.1:8443/ >/dev/null
room curl -s -m 5 http://10.77.0.1:8443/ >/dev/null
kill $listens
wait $listens && fail "a plain word went by unheard"
grep -q 'plain: GET /' plain.txt || fail "a plain word was not shown"
[ "$records" = "$work/records.sqlite" ] && echo "Without records: PostgreSQL is not installed"
exit 0
