#!/bin/bash
# Run as root in a fresh Debian with /opt/palpa_*.deb and /opt/expect.sh: installs, uses and
# removes the package.
. /opt/expect.sh
export DEBIAN_FRONTEND=noninteractive LC_ALL=C.UTF-8
mountpoint -q /proc || mount -t proc proc /proc
answer=

# Everything but what apt and dpkg keep for themselves, what lives in memory, and what belongs to a
# user: results, records, the graphics library's cache.
files() {
  find / -xdev \( -path /home -o -path /proc -o -path /sys -o -path /dev -o -path /run \
    -o -path /tmp -o -path /opt -o -path /var/cache -o -path /var/log \
    -o -path /var/lib/apt -o -path /var/lib/dpkg \) -prune -o -print |
    sort
}
as_user() {
  (
    cd /home/teacher &&
      setpriv --reuid=teacher --regid=teacher --init-groups --reset-env env LC_ALL=C.UTF-8 "$@"
  )
}

useradd --create-home teacher
apt-get update -qq
files >/opt/before
packages() { dpkg-query -W -f '${Package}\n' | sort; }
packages >/opt/packages_before
deb=$(ls /opt/palpa_*.deb)
# Without recommendations: what this bare system's own packages recommend as
# well, autoremove would keep.
timed "apt install ./$(basename "$deb")" apt-get install -y -q --no-install-recommends "$deb"
[ "$failures" = 0 ] || finish
packages_came=$(($(packages | wc -l) - $(wc -l </opt/packages_before)))
files_came=$(($(files | wc -l) - $(wc -l </opt/before)))
echo "      $packages_came packages came with it, $files_came files"
expect "no package is broken" bash -c '[ -z "$(dpkg --audit)" ]'
expect "no library is missing" bash -c \
  '! ldd /usr/bin/palpa /usr/lib/palpa/*.so | grep "not found"'

timed "palpa --version" as_user palpa --version
expect "  says the package's version" [ "$answer" = "palpa $(dpkg-deb -f "$deb" Version)" ]
timed "palpa doctor --json" as_user palpa doctor --json
expect "  a session can start" grep -q '"can_start": true' <<<"$answer"
expect "  its data are the package's" grep -q '"/usr/share/palpa/assets"' <<<"$answer"
expect "  pictures are drawn by OpenGL" grep -q 'by OpenGL (' <<<"$answer"
sed -n 's/^ *"verdict": "\(.*\)"$/      \1/p' <<<"$answer"
timed "a demonstration without pictures" as_user \
  palpa subclavian --operator expert --fast --no-views --trials 1 --quiet --out /tmp/x
expect "  left its report, its table and its evidence" \
  test -s /tmp/x/report.html -a -s /tmp/x/trials.csv -a -s /tmp/x/session.palpa
timed "  and gives the same forces when it is replayed" as_user palpa replay /tmp/x/session.palpa
timed "a demonstration with pictures" as_user \
  palpa subclavian --operator expert --fast --trials 1 --quiet --out /tmp/y
expect "  left pictures" bash -c 'ls /tmp/y/view-*.png'
as_user timeout --signal=INT 12 palpa console --no-open --port 8765 >/tmp/console.txt 2>&1 &
for _ in $(seq 50); do
  grep -q 'The console: ' /tmp/console.txt && break
  sleep 0.2
done
page() {
  exec 3<>/dev/tcp/127.0.0.1/8765 &&
    printf 'GET / HTTP/1.1\r\nHost: 127.0.0.1:8765\r\nConnection: close\r\n\r\n' >&3 &&
    timeout 5 cat <&3
}
timed "palpa console gives its page" page
expect "  which is HTML" grep -qi '<html' <<<"$answer"
wait   # until its time is over
expect "manual page" test -s /usr/share/man/man1/palpa.1.gz
expect "completion" \
  bash -c '. /usr/share/bash-completion/completions/palpa && complete -p palpa'
expect "desktop entry, icon, udev rule, licence" \
  test -s /usr/share/applications/palpa.desktop \
  -a -s /usr/share/icons/hicolor/scalable/apps/palpa.svg \
  -a -s /usr/lib/udev/rules.d/60-palpa-falcon.rules \
  -a -s /usr/share/doc/palpa/copyright
expect "all files as they were packed" dpkg --verify palpa

dpkg -L palpa | sort >/opt/listed
# Else apt keeps what the bare system's packages recommend or suggest and a library of palpa's
# brought along: on Debian 13, gnupg.
timed "apt purge and autoremove" \
  bash -c 'apt-get purge -y -q palpa && apt-get autoremove --purge -y -q \
    -o APT::AutoRemove::RecommendsImportant=false -o APT::AutoRemove::SuggestsImportant=false'
files >/opt/after
# What a package of before depends on, if only as one of several, apt keeps: on Debian 13, adduser.
stays_for_palpa() {
  packages | comm -13 /opt/packages_before - | while read -r stayed; do
    apt-cache rdepends --installed --important "$stayed" | tail -n +3 | tr -d ' |' | sort -u |
      comm -12 - /opt/packages_before | grep -q . || echo "$stayed"
  done
}
stayed=$(stays_for_palpa)
expect "  no package stays but what those of before depend on" [ -z "$stayed" ]
[ -z "$stayed" ] || sed 's/^/        /' <<<"$stayed"
comm -13 /opt/before /opt/after >/opt/left
expect "  no file of the package is left" \
  bash -c '[ -z "$(comm -12 /opt/left /opt/listed)" ] && ! grep -i palpa /opt/left'
echo "      left by other packages: $(wc -l </opt/left) files"
sed 's/^/        /' /opt/left | head -n 20
expect "  no file went that was there before" bash -c '[ -z "$(comm -23 /opt/before /opt/after)" ]'
finish
