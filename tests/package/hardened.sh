#!/usr/bin/env bash
# hardened.sh BUILD: the program is built so that a fault in parsing stays a crash: by what the
# linker noted in it, and by hardening-check (package devscripts) where that is installed.
set -euo pipefail
build=$1
here=$(cd "$(dirname "$0")" && pwd)
. "$here/expect.sh"
program=$build/palpa codecs=$build/lib/libpalpa_opencv_codecs.so

has() { grep -q "$2" <<<"$(readelf -W $1 "$3" 2>/dev/null)"; }   # has WHAT PATTERN FILE
for file in "$program" "$codecs"; do
  name=$(basename "$file")
  expect "$name: addresses are bound at the start" has -d 'BIND_NOW\|Flags:.*NOW' "$file"
  expect "$name: and cannot be rewritten then" has -l 'GNU_RELRO' "$file"
  expect "$name: no stack can be run" bash -c "! readelf -Wl '$file' | grep GNU_STACK | grep -q RWE"
done
expect "palpa lies at another address each time" has -h 'DYN' "$program"
expect "palpa notices a smashed stack" has --dyn-syms '__stack_chk_fail' "$program"
expect "palpa calls checked functions" has --dyn-syms '_chk@' "$program"
# Debian 12's Scrt1.o does not promise landing pads, so the linker leaves the note out of the
# program; our own code has them.
if [ "$(uname -m)" = x86_64 ]; then
  object=$(find "$build/apps/cli" -name '*.o' | head -n 1)
  expect "our code has landing pads" has -n 'IBT, SHSTK' "$object"
fi
if command -v hardening-check >/dev/null; then
  expect "hardening-check finds nothing" hardening-check --nocfprotection "$program"
fi
finish
