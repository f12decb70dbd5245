#!/bin/sh
# arm64_root.sh FOLDER PACKAGE...: makes FOLDER a tree of Debian 12 for arm64 with these packages and all that they depend on, unpacked
# but not configured: enough to compile and link against, to find a program's packages, and for qemu to run programs in. Changes nothing else and needs no root.
# Packages come from the mirror of the host's apt; FOLDER.apt keeps them. A tree that has the packages stays as it is.
set -eu

root=$1
shift
wanted=$(printf '%s\n' "$@" | sort)
[ "$(cat "$root/packages" 2> /dev/null)" != "$wanted" ] || exit 0

mirror=$(apt-get indextargets --format '$(REPO_URI)' 'Created-By: Packages' 'Codename: bookworm' 'Component: main' | head -n 1)
[ -n "$mirror" ] || {
  echo "$0: apt has no mirror of Debian 12 (bookworm)" >&2
  exit 1
}

# An apt of its own, for which nothing is installed.
apt=$root.apt
mkdir -p "$apt/lists/partial" "$apt/archives/partial" "$apt/etc/preferences.d" "$apt/etc/apt.conf.d"
: > "$apt/status"
echo "deb [signed-by=/usr/share/keyrings/debian-archive-keyring.gpg] $mirror bookworm main" > "$apt/sources.list"
get() {
  apt-get -qq -o APT::Architecture=arm64 -o APT::Architectures=arm64 -o Dir::Etc="$apt/etc" -o Dir::Etc::SourceList="$apt/sources.list" \
    -o Dir::State="$apt" -o Dir::State::Lists="$apt/lists" -o Dir::State::Status="$apt/status" -o Dir::Cache="$apt" -o Dir::Cache::Archives="$apt/archives" \
    -o APT::Sandbox::User= -o Debug::NoLocking=true -o APT::Install-Recommends=false "$@"
}
get update
get install --download-only --yes "$@" > /dev/null

rm -rf "$root"
mkdir -p "$root/usr/lib" "$root/usr/bin" "$root/usr/sbin"
for folder in lib bin sbin; do ln -s usr/$folder "$root/$folder"; done
# With what dpkg knows of installed packages: which has which file, and which versions of it programs need.
known=$root/var/lib/dpkg
mkdir -p "$known/info"
echo 1 > "$known/info/format"
for package in "$apt"/archives/*.deb; do
  dpkg-deb --fsys-tarfile "$package" | tar -x -C "$root" --keep-directory-symlink --no-same-owner
  name=$(dpkg-deb -W --showformat='${Package}' "$package")
  [ "$(dpkg-deb -f "$package" Multi-Arch)" != same ] || name=$name:arm64
  dpkg-deb -e "$package" "$known/control"
  for file in symbols shlibs; do [ ! -f "$known/control/$file" ] || mv "$known/control/$file" "$known/info/$name.$file"; done
  dpkg-deb --fsys-tarfile "$package" | tar -t | sed 's|^\.||; s|/$||; s|^$|/.|' > "$known/info/$name.list"
  { echo 'Status: install ok installed' && cat "$known/control/control" && echo; } >> "$known/status"
  rm -r "$known/control"
done
# Absolute paths of links and of CMake's files.
find "$root/usr/lib" -type l -lname '/*' | while read -r link; do ln -sfn "$root$(readlink "$link")" "$link"; done
grep -rlZ '[";:]/usr' "$root/usr/lib" --include='*.cmake' | xargs -0r sed -i "s|\([\";:]\)/usr|\1$root/usr|g"
echo "$wanted" > "$root/packages"
