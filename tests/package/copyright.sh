#!/bin/sh
# copyright.sh PROGRAM: src/package/copyright names each library that the program loads and each package of ./dev that it is built with.
set -eu
top=$(cd "$(dirname "$0")/../.." && pwd)
terms=$top/src/package/copyright
loaded=$(readelf -d "$1" | sed -n 's/.*(NEEDED).*\[\(.*\)\]$/\1/p')
built=$(sed -n "/^packages='/,/'$/p" "$top/dev" | grep -oE '[a-z0-9+.-]+-dev' | grep -v libgtest-dev)
[ -n "$loaded" ] && [ -n "$built" ]
missing=
for name in $loaded $built; do
  grep -qwF -e "$name" "$terms" || missing="$missing $name"
done
[ -z "$missing" ] || {
  echo "src/package/copyright does not name$missing" >&2
  exit 1
}
