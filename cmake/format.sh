#!/usr/bin/env bash
# Holds the style of the sources: C++ as clang-format 14 writes it (.clang-format), the console's
# pages as prettier does (.prettierrc.json), no line of code longer than 100 columns.
#   cmake/format.sh              formats every file that git tracks
#   cmake/format.sh --check      changes nothing; tells what differs, and then exits with 1
#   cmake/format.sh --list-long  the lines that may be longer, and why: a raw string, an address
# A tool that is not there is told and left out.
set -euo pipefail
top=$(cd "$(dirname "$0")/.." && pwd)
. "$top/cmake/prepare.sh"
. "$top/cmake/npm_package.sh"
cd "$top"

columns=100
clang_format_major=14
prettier_version=3.10.1
prettier_sum=\
70vp3ZUYoPlFbF9uiTdXHUUCGEIp7d4+6p+8DYbkm2jP7x/3i/paXVF6dopSI3zd/CEitrZN1rc4i85xWmmXlg==
prettier_place=build/tools/prettier-$prettier_version
prettier=$prettier_place/bin/prettier.cjs

# tracked PATTERN...: files that git tracks and that are there, each ended by a zero byte
tracked() {
  local file
  git ls-files -z -- "$@" |
    while IFS= read -r -d '' file; do
      [ ! -f "$file" ] || printf '%s\0' "$file"
    done
}

cpp_files() { tracked '*.cpp' '*.h'; }
page_files() {
  tracked 'assets/*.js' 'assets/*.css' 'assets/*.html'
  tracked 'cmake/*.mjs' 'tests/*.mjs' 'tests/*.js' 'tests/*.css'
}
script_files() {
  local file
  tracked '*.sh'
  # And those whose name has no ending.
  tracked |
    grep -zv '\.[^/]*$' |
    while IFS= read -r -d '' file; do
      [ "$(head -c 2 "$file" | tr -d '\0')" != '#!' ] || printf '%s\0' "$file"
    done
}
code_files() {
  cpp_files
  page_files
  script_files
  tracked '*CMakeLists.txt' '*.cmake'
}

# The name of the program of the wanted version; says so where there is none.
find_clang_format() {
  local name
  for name in "clang-format-$clang_format_major" clang-format; do
    if "$name" --version 2>/dev/null | grep -q "version $clang_format_major\."; then
      echo "$name"
      return
    fi
  done
  say "C++ is left out: clang-format $clang_format_major is not installed."
  return 1
}

# Fetches prettier the first time; says so where that cannot be.
find_prettier() {
  local name needed=(node)
  [ -f "$prettier" ] || needed+=(curl openssl)
  for name in "${needed[@]}"; do
    command -v "$name" >/dev/null && continue
    say "The pages are left out: $name is not installed."
    return 1
  done
  [ ! -f "$prettier" ] || return 0
  mkdir -p build/tools
  fetch_npm_package prettier "$prettier_version" "$prettier_place.tgz" || {
    say "The pages are left out: prettier could not be fetched from registry.npmjs.org."
    return 1
  }
  is_npm_package "$prettier_place.tgz" "$prettier_sum" ||
    fail "prettier $prettier_version is not what it should be: $prettier_place.tgz"
  rm -rf "$prettier_place.part"
  unpack_npm_package "$prettier_place.tgz" "$prettier_place.part"
  mv "$prettier_place.part" "$prettier_place"
}

format() {
  local clang_format
  if clang_format=$(find_clang_format); then
    cpp_files | xargs -0r -n 32 -P 2 "$clang_format" -i
  fi
  if find_prettier; then
    page_files | xargs -0r node "$prettier" --log-level warn --write
  fi
}

# The files that `format` would change.
differing() {
  local clang_format pages
  if clang_format=$(find_clang_format); then
    cpp_files | xargs -0r -n 32 -P 2 bash -o pipefail -c '
      "$0" --dry-run "$@" 2>&1 |
        sed -n "s/:[0-9]*:[0-9]*: warning: code should be clang-formatted.*//p" |
        uniq' "$clang_format"
  fi
  if find_prettier; then
    mapfile -d '' pages < <(page_files)
    node "$prettier" --list-different "${pages[@]}" || [ $? = 1 ] ||
      fail "prettier cannot read a page; the lines above say why"
  fi
}

# long_lines KIND: FILE:LINE of what is longer; KIND is may (with the reason) or must_not. Columns
# are characters: the bytes that go on with a character are not counted.
long_lines() {
  code_files | LC_ALL=C xargs -0r awk -v kind="$1" -v columns="$columns" '
    # Follows raw strings through a line: true where it touches one. `raw` ends the open one.
    function in_raw(line,  touched, at) {
      touched = raw != ""
      while (1) {
        if (raw != "") {
          at = index(line, raw)
          if (!at) return 1
          line = substr(line, at + length(raw))
          raw = ""
        }
        if (line ~ /^ *\/\// || !match(line, /(^|[^A-Za-z0-9_])(u8|u|U|L)?R"[^ ()\\"]*\(/))
          return touched
        touched = 1
        raw = substr(line, RSTART, RLENGTH - 1)
        sub(/^.*"/, "", raw)
        raw = ")" raw "\""
        line = substr(line, RSTART + RLENGTH)
      }
    }
    FNR == 1 { raw = "" }
    {
      reason = FILENAME ~ /\.(cpp|h)$/ && in_raw($0) ? "a raw string" : ""
      if ($0 ~ /https?:\/\//) reason = "an address"
      gsub(/[\200-\277]/, "")
      if (length($0) <= columns) next
      if (kind == "may" && reason != "") print FILENAME ":" FNR ": " reason
      if (kind == "must_not" && reason == "") print FILENAME ":" FNR
    }'
}

# FILE:LINE where C++ switches the formatter off without a reason in cmake/format_exceptions.txt.
switched_off() {
  local file line
  { git grep -n 'clang-format off' -- '*.cpp' '*.h' || true; } |
    while IFS=: read -r file line _; do
      grep -q "^$file: *[^ ]" cmake/format_exceptions.txt || echo "$file:$line"
    done
}

# tell WORDS LINES: the lines and what is wrong with them, where there are any
tell() {
  [ -n "$2" ] || return 0
  printf '%s\n' "$2"
  say "$1"
  status=1
}

status=0
case "${1:-}" in
  "") format ;;
  --check)
    found=$(differing)
    tell "These files differ. This mends them: cmake/format.sh" "$found"
    ;;
  --list-long)
    long_lines may
    exit
    ;;
  *)
    sed -n '2,7s/^# \{0,1\}//p' "$0"
    exit 2
    ;;
esac
found=$(long_lines must_not)
tell "These lines have more than $columns columns." "$found"
found=$(switched_off)
tell "clang-format is switched off here; cmake/format_exceptions.txt does not say why." "$found"
exit $status
