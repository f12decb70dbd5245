#!/bin/sh
# in_roots.sh TREE [SYSTEM...]: what src/package/make.sh made of a build tree, installed and run in bare systems, each made from nothing
# in a temporary folder. Prints seconds and megabytes. Tables must have the bytes of build/release/carom, and pictures too: for
# another processor their pixels.
#
# debian12         the package: lists of apt, install with what it recommends and first runs within 20 s and 100 MB, without a
#                  compiler; and the errors where something is missing that is only suggested
# busybox          the archive where there is busybox and nothing else, not even a C library
# lib64            the archive with libraries in /usr/lib64 as on Fedora, and none in /lib/x86_64-linux-gnu
# bullseye trixie  the archive in that Debian
#
# Needs root, debootstrap, busybox-static, and the Debian mirror of the host's apt. Systems for another processor need binfmt_misc
# with qemu-user-static, and no time limit holds in them; busybox and lib64 are of the host's programs.
set -eu

fail() {
  echo "$0: $*" >&2
  exit 1
}

[ "$(id -u)" -eq 0 ] || fail "needs root to create and enter another system's tree"
cd "$(dirname "$0")/../.."
config=$1/CPackConfig.cmake
shift
value() { sed -n "s/^set($1 \"\(.*\)\")$/\1/p" "$config"; }
architecture=$(value CPACK_DEBIAN_PACKAGE_ARCHITECTURE) name=carom-$(value CPACK_PACKAGE_VERSION)-$(value CPACK_CAROM_PROCESSOR)
package=build/carom_$(value CPACK_PACKAGE_VERSION)_$architecture.deb
archive=build/$name.tar.xz
native=no
[ "$architecture" != "$(dpkg --print-architecture)" ] || native=yes
if [ $# -eq 0 ]; then
  set -- debian12 bullseye
  [ $native = no ] || set -- debian12 busybox lib64
fi
# shellcheck disable=SC2016  # apt-get's own variable
mirror=$(apt-get indextargets --format '$(REPO_URI)' 'Created-By: Packages' 'Codename: bookworm' 'Component: main' | head -n 1)

bare=$(mktemp -d)
trap 'rm -rf --one-file-system "$bare"' EXIT
trap 'exit 130' INT TERM

# within ROOT SCRIPT: mounts and processes end with the namespaces, even if the script fails.
within() {
  unshare --mount --pid --fork --kill-child env -i PATH=/usr/local/sbin:/usr/local/bin:/usr/sbin:/usr/bin:/sbin:/bin \
    TERM=dumb HOME=/root DEBIAN_FRONTEND=noninteractive ${http_proxy:+http_proxy="$http_proxy"} \
    chroot "$bare/$1" /bin/sh -euc "mount -t proc proc /proc; cd /srv; $2"
}

debian() {
  [ -n "$mirror" ] || fail 'apt has no mirror of Debian 12 (bookworm)'
  debootstrap --variant=minbase --arch="$architecture" "$1" "$bare/$1" "$mirror" > "$bare/log" 2>&1 || fail "$(cat "$bare/log")"
  cp /etc/resolv.conf /etc/hosts "$bare/$1/etc/"
}

# now: milliseconds.
now() { echo $(($(date +%s%N) / 1000000)); }

# timed NAME COMMAND...: prints the duration, and leaves it in `took`.
timed() {
  what=$1 start=$(now)
  shift
  "$@" || return
  took=$(($(now) - start))
  echo "$system, $what: $((took / 1000)).$((took / 100 % 10)) s"
}

# The first scene without its film, and one with texts.
scenes='two_bowling_balls cars'
runs() {
  for scene in $scenes; do
    echo "$1 run $2/$scene.yaml --quiet --only trajectory,collisions,energy,frames -o $3/$scene --set 'output.frames={fps: 2, size: [320, 180]}';"
  done
}

# hashes FOLDER: of tables and pictures. On another processor the same pixels may be packed to other bytes of a PNG.
hashes() { (cd "$1" && find . -name '*.csv' -o -name '*.png' | LC_ALL=C sort | xargs sha256sum) | if [ $native = yes ]; then cat; else grep -v 'png$'; fi; }

same_bytes() {
  hashes "$bare/$1/srv/out" > "$bare/hashes"
  cmp "$bare/hashes" "$bare/reference" || fail "$system: other bytes than those of build/release/carom"
  echo "$system: $(wc -l < "$bare/hashes") files have the bytes of build/release/carom"
  [ $native = no ] || return 0
  (cd "$bare/host" && find . -name '*.png') | while read -r picture; do
    tests/compilers/same_pixels.py "$bare/host/$picture" "$bare/$1/srv/out/$picture" || fail "$system: other pixels in $picture"
  done
}

# refused ROOT WORD COMMAND: it fails, names the remedy WORD, and writes nothing.
refused() {
  ! within "$1" "rm -rf none; $3 -o none" > "$bare/log" 2>&1 || fail "$system: $3 does not fail"
  grep -q -- "$2" "$bare/log" || fail "$system: $3 does not name '$2': $(cat "$bare/log")"
  [ ! -e "$bare/$1/srv/none/manifest.json" ] || fail "$system: $3 writes a run"
  echo "$system: without it, the error names $2"
}

installs() {
  timed 'apt update' within bookworm 'apt-get -q update' > "$bare/log"
  grep '^Fetched' "$bare/log"
  tail -n 1 "$bare/log"
  all=$took
  cp "$package" "$bare/bookworm/srv/carom.deb"
  suggested='ffmpeg gnuplot-nox libosmesa6'
  for how in '' --no-install-recommends "$suggested" "--no-install-recommends $suggested"; do
    within bookworm "apt-get install -q --print-uris $how ./carom.deb" > "$bare/log"
    bytes=$(awk -v bytes="$(stat -c %s "$package")" '/^.http/ { bytes += $3 } END { print bytes }' "$bare/log")
    echo "$system: apt install ./carom.deb $how: $((bytes / 1000000)).$((bytes / 100000 % 10)) MB to download, $(sed -n 's/^After this operation, //p' "$bare/log")"
    [ "$bytes" -le 100000000 ] || [ "${how%6}" != "$how" ] || fail "$system: more than 100 MB"
  done
  timed 'apt install ./carom.deb' within bookworm 'apt-get install -qq -y ./carom.deb' > "$bare/log" 2>&1 || fail "$(cat "$bare/log")"
  tail -n 1 "$bare/log"
}

try_debian12() {
  debian bookworm
  installs
  all=$((all + took))
  within bookworm '! command -v cc c++ ffmpeg gnuplot' > "$bare/log" || fail "$system: more is installed than was meant"
  timed 'two runs' within bookworm "$(runs carom /usr/share/carom/scenes out)"
  all=$((all + took))
  [ $all -le 20000 ] || [ $native = no ] || fail "$system: update, install and runs took $all ms, more than 20 s"
  same_bytes bookworm
  within bookworm 'test -s /usr/share/man/man1/carom.1.gz && test -e /usr/share/doc/carom/scenes/format.md && bash -n /usr/share/bash-completion/completions/carom'

  at=/usr/share/carom/scenes
  refused bookworm 'apt install ffmpeg' "carom run $at/two_bowling_balls.yaml"
  refused bookworm 'apt install gnuplot-nox' 'carom plot out/two_bowling_balls'
  refused bookworm 'apt install libosmesa6' "carom run $at/ten_pins.yaml --only frames"
  within bookworm 'dpkg --purge fonts-dejavu-core > /dev/null; rm -rf /usr/share/fonts'
  refused bookworm 'apt install fonts-dejavu-core' "carom run $at/cars.yaml --only frames"
}

# from_archive ROOT: unpacks it in a folder with a space, and runs it through a link from elsewhere.
from_archive() {
  mkdir -p "$bare/$1/srv" "$bare/$1/opt/a place" "$bare/$1/usr/local/bin" "$bare/$1/proc"
  tar -xf "$archive" -C "$bare/$1/opt/a place"
  ln -s "../../../opt/a place/$name/bin/carom" "$bare/$1/usr/local/bin/carom"
  timed 'two runs' within "$1" "$(runs carom "'/opt/a place/$name/share/carom/scenes'" out)"
  same_bytes "$1"
  # What it starts has none of the archive's libraries.
  printf '#!/bin/sh\nenv >> /srv/environment\nexit 1\n' > "$bare/$1/usr/local/bin/gnuplot"
  chmod +x "$bare/$1/usr/local/bin/gnuplot"
  within "$1" '! carom plot out/two_bowling_balls -o none' > "$bare/log" 2>&1 || fail "$(cat "$bare/log")"
  [ -s "$bare/$1/srv/environment" ] || fail "$system: gnuplot was not started: $(cat "$bare/log")"
  ! grep -e '^LD_' -e "a place" "$bare/$1/srv/environment" || fail "$system: gnuplot gets this of the archive"
}

try_busybox() {
  [ $native = yes ] || fail 'busybox is of the host'
  mkdir -p "$bare/busybox/bin"
  cp "$(command -v busybox)" "$bare/busybox/bin/busybox"
  for applet in sh readlink mount env; do ln -s busybox "$bare/busybox/bin/$applet"; done
  from_archive busybox
}

try_lib64() {
  [ $native = yes ] || fail 'lib64 is of the host'
  mkdir -p "$bare/lib64/usr/bin" "$bare/lib64/usr/lib64" "$bare/lib64/etc"
  ln -s usr/bin "$bare/lib64/bin"
  ln -s usr/lib64 "$bare/lib64/lib64"
  echo /usr/lib64 > "$bare/lib64/etc/ld.so.conf"
  cp -L /bin/sh /usr/bin/readlink /usr/bin/env /bin/mount "$bare/lib64/usr/bin/"
  ldd /bin/sh /usr/bin/readlink /usr/bin/env /bin/mount | grep -o '/[^ ]*\.so[^ ]*' | sort -u | xargs -I '{}' cp -L '{}' "$bare/lib64/usr/lib64/"
  ldconfig -r "$bare/lib64"
  from_archive lib64
}

mkdir "$bare/host"
eval "$(runs build/release/carom scenes "$bare/host")"
hashes "$bare/host" > "$bare/reference"
for system; do
  case $system in
    debian12 | busybox | lib64) "try_$system" ;;
    *)
      debian "$system"
      from_archive "$system"
      ;;
  esac
done
