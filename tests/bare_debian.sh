#!/bin/sh
# The README's two commands with only git installed: in a bare Debian 12 in a temporary folder as root, and in a second one as a user
# with sudo. Each clones HEAD. Needs root, debootstrap, and the Debian mirror of the host's apt.
set -eu

[ "$(id -u)" -eq 0 ] || {
  echo "$0: needs root to create and enter another system's tree" >&2
  exit 1
}
root=$(cd "$(dirname "$0")/.." && pwd)
# shellcheck disable=SC2016  # apt-get's own variable
mirror=$(apt-get indextargets --format '$(REPO_URI)' 'Created-By: Packages' 'Codename: bookworm' 'Component: main' | head -n 1)
[ -n "$mirror" ] || {
  echo "$0: apt has no mirror of Debian 12 (bookworm)" >&2
  exit 1
}

bare=$(mktemp -d)
trap 'rm -rf --one-file-system "$bare"' EXIT
trap 'exit 130' INT TERM

# in_tree USER SCRIPT: mounts and processes end with the namespaces, even if the script fails.
in_tree() {
  unshare --mount --pid --fork --kill-child chroot "$bare/$1" /usr/bin/env -i \
    PATH=/usr/local/sbin:/usr/local/bin:/usr/sbin:/usr/bin:/sbin:/bin TERM=dumb HOME=/root ${http_proxy:+http_proxy="$http_proxy"} \
    sh -euc "mount -t proc proc /proc; mount -t devpts -o newinstance,ptmxmode=666 devpts /dev/pts; $2"
}

# timed NAME COMMAND...: prints the duration on stdout.
timed() {
  name=$1
  shift
  start=$(date +%s)
  "$@"
  echo "bare Debian 12, $name: $(($(date +%s) - start)) s"
}

git -c safe.directory='*' -C "$root" bundle create -q "$bare/carom.bundle" HEAD
debootstrap --variant=minbase bookworm "$bare/root" "$mirror" > "$bare/log" || {
  cat "$bare/log" >&2
  exit 1
}
cp /etc/resolv.conf "$bare/root/etc/resolv.conf"
cp /etc/hosts "$bare/root/etc/hosts"
cp "$bare/carom.bundle" "$bare/root/srv"
get='DEBIAN_FRONTEND=noninteractive apt-get -q install -y --no-install-recommends'
in_tree root "apt-get -q update; $get git" > "$bare/log"
cp -a "$bare/root" "$bare/user"

for who in root user; do
  if [ $who = user ]; then
    in_tree user "$get sudo; useradd --create-home user; echo 'user ALL=(ALL) NOPASSWD: ALL' > /etc/sudoers.d/user" > "$bare/log"
    enter='su user -c'
  else
    enter='sh -c'
  fi
  in_tree $who "$enter 'cd && git -c advice.detachedHead=false clone -q /srv/carom.bundle carom'"
  timed "$who: ./dev run scenes/two_bowling_balls.yaml" in_tree $who "$enter 'cd && cd carom && ./dev run scenes/two_bowling_balls.yaml'"
  timed "$who: ./dev test" in_tree $who "$enter 'cd && cd carom && ./dev test'"
  timed "$who: ./dev run once more" in_tree $who "$enter 'cd && cd carom && ./dev run scenes/two_bowling_balls.yaml'"
done
