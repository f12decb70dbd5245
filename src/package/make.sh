#!/bin/sh
# make.sh TREE package|archive|meshes...: what can be installed of the program in the build tree TREE, written beside the tree.
#
# package  carom_VERSION_ARCHITECTURE.deb
# archive  carom-VERSION-PROCESSOR.tar.xz, for other systems too. It has all libraries, and the C library with its loader: the
#          program needs a newer one than Debian 11 and Ubuntu 22.04 have, and libraries by it do not run on an older one.
# meshes   carom-VERSION-PROCESSOR-meshes.tar.xz, to be unpacked in the same place: OSMesa, which is six times as large
#
# The same commit and packages give the same bytes. A tree for another processor has a system root (CMAKE_SYSROOT) with that
# processor's libraries and their packages.
set -eu
tree=$1
shift
out=$(cd "$(dirname "$tree")" && pwd)
here=$(cd "$(dirname "$0")" && pwd)

die() {
  echo "$0: $*" >&2
  exit 1
}

# value NAME: that of a variable of the build.
value() { sed -n "s/^set($1 \"\(.*\)\")$/\1/p" "$tree/CPackConfig.cmake"; }

version=$(value CPACK_PACKAGE_VERSION) processor=$(value CPACK_CAROM_PROCESSOR) root=$(value CPACK_CAROM_SYSROOT)
[ -n "$version$processor" ] || die "$tree is no build tree of carom"
triplet=$processor-linux-gnu
top=carom-$version-$processor
SOURCE_DATE_EPOCH=${SOURCE_DATE_EPOCH:-$(git -C "$here" log -1 --format=%ct)}
export SOURCE_DATE_EPOCH
umask 022
stage=$(mktemp -d)
trap 'rm -rf "$stage"' EXIT
trap 'exit 130' INT TERM

make_package() {
  gzip -9n > "$tree/changelog.gz" << END
carom ($version) unstable; urgency=medium

  * The changes are in output/README.md, beside this file.

 -- $(value CPACK_PACKAGE_CONTACT)  $(LC_ALL=C date -u -R -d "@$SOURCE_DATE_EPOCH")
END
  pack="cpack -G DEB --config $tree/CPackConfig.cmake -B $out"
  if [ -z "$root" ]; then
    $pack
    return
  fi
  # dpkg-shlibdeps finds libraries and their packages at their own places alone: here the root's are there.
  place=/usr/lib/$triplet
  [ -d "$place" ] || {
    mkdir "$place"
    trap 'rm -rf "$stage"; rmdir "$place"' EXIT
  }
  DPKG_ADMINDIR=$root/var/lib/dpkg DEB_HOST_ARCH=$(value CPACK_DEBIAN_PACKAGE_ARCHITECTURE) \
    unshare --mount sh -euc "mount --bind '$root/usr/lib/$triplet' $place; $pack"
}

# library NAME: its file.
library() {
  for folder in "$root/usr/lib/$triplet" "$root/lib/$triplet"; do
    if [ -e "$folder/$1" ]; then
      echo "$folder/$1"
      return
    fi
  done
  die "the library $1 is not installed${root:+ in $root}"
}

# libraries FILE: the names of all that it needs, what those need included.
libraries() {
  found=
  while [ $# -gt 0 ]; do
    for name in $(readelf -d "$1" | sed -n 's/.*(NEEDED).*\[\(.*\)\]$/\1/p'); do
      case " $found " in
        *" $name "*) ;;
        *)
          found="$found $name"
          set -- "$@" "$(library "$name")"
          ;;
      esac
    done
    shift
  done
  # shellcheck disable=SC2086  # a word each
  printf '%s\n' $found
}

# copy_terms: the terms of the packages whose names are read, the licenses that these refer to, and a list of their sources.
copy_terms() {
  at=$stage/$top/share
  mkdir -p "$at/doc/carom" "$at/common-licenses"
  sort -u | while read -r package; do
    mkdir -p "$at/doc/$package"
    cp -L "$root/usr/share/doc/$package/copyright" "$at/doc/$package/"
    # shellcheck disable=SC2016  # dpkg-query's own variables
    dpkg-query --admindir="$root/var/lib/dpkg" -W -f '${Package} ${Version}: source ${source:Package} ${source:Version}\n' "$package"
  done >> "$at/doc/carom/packages_of_debian${1:-}"
  grep -rhoE '/usr/share/common-licenses/[A-Za-z0-9.-]*[A-Za-z0-9]' "$at/doc" | sort -u | while read -r license; do
    [ ! -f "$license" ] || cp -L "$license" "$at/common-licenses/"
  done
}

# copy_libraries [PART]: those whose names are read, and their terms.
copy_libraries() {
  mkdir -p "$stage/$top/lib"
  while read -r name; do
    cp -L "$(library "$name")" "$stage/$top/lib/$name"
    dpkg-query --admindir="$root/var/lib/dpkg" -S "*/$triplet/$name" | sed 's/:.*//;q'
  done > "$stage/packages"
  copy_terms "$@" < "$stage/packages"
}

# pack NAME: the stage's folder, with nothing of this machine, of its user or of now.
pack() {
  tar -C "$stage" --sort=name --format=gnu --owner=0 --group=0 --numeric-owner --mode=u=rwX,go=rX \
    --mtime="@$SOURCE_DATE_EPOCH" -cf "$stage/tar" "$top"
  xz -9 --threads=2 < "$stage/tar" > "$stage/xz"
  mv "$stage/xz" "$out/$1.tar.xz"
  rm -r "${stage:?}/$top" "$stage/tar" "$stage/packages"
  echo "$out/$1.tar.xz"
}

make_archive() {
  cmake --install "$tree" --prefix "$stage/$top" --strip > "$stage/log" || die "$(cat "$stage/log")"
  mv "$stage/$top/bin/carom" "$stage/$top/lib.carom"
  mkdir "$stage/$top/lib"
  mv "$stage/$top/lib.carom" "$stage/$top/lib/carom"
  cp "$here/carom" "$stage/$top/bin/carom"
  rm -f "$stage/$top/share/doc/carom/changelog.gz"

  libraries "$stage/$top/lib/carom" | copy_libraries
  mkdir "$stage/$top/share/fonts"
  cp /usr/share/fonts/truetype/dejavu/DejaVuSans.ttf "$stage/$top/share/fonts/"
  (root='' && echo fonts-dejavu-core | copy_terms)
  pack "$top"
}

make_meshes() {
  osmesa=$(library libOSMesa.so.8)
  libraries "$tree/carom" > "$stage/others"
  { echo libOSMesa.so.8 && libraries "$osmesa"; } | grep -vxFf "$stage/others" | copy_libraries _for_meshes
  pack "$top-meshes"
}

for kind; do
  case $kind in
    package | archive | meshes) "make_$kind" ;;
    *) die "package, archive or meshes, not '$kind'" ;;
  esac
done
