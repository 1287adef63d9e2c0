# Sourced: one file of the npm registry, without further libraries, known by its SHA-512. For tools
# and tests only; the program needs nothing of it.

# fetch_npm_package NAME VERSION FILE
fetch_npm_package() {
  curl -fsS --retry 3 --max-time 120 -o "$3" "https://registry.npmjs.org/$1/-/$1-$2.tgz"
}

# is_npm_package FILE SUM: SUM is in base64, as the registry tells it
is_npm_package() { [ "$(openssl dgst -sha512 -binary "$1" | base64 -w0)" = "$2" ]; }

# unpack_npm_package FILE FOLDER
unpack_npm_package() { mkdir -p "$2" && tar xzf "$1" -C "$2" --strip-components=1; }
