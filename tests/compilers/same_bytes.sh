#!/bin/sh
# same_bytes.sh PROGRAM OTHER SCENE...: runs each scene by two programs and compares every byte of their tables (manifests have wall
# times and are left out), and, with PICTURES set, the pixels of their sheets, except where they have meshes: Mesa draws these, with
# other roundings on other processors. A program is a command with its first arguments, such as qemu's. Scenes that take PROGRAM
# longer than PATIENCE seconds are listed and left out.
set -eu

here=$(dirname "$0")
program=$1 other=$2
shift 2
patience=${PATIENCE:-10}
outputs=trajectory,collisions,energy${PICTURES:+,sheet}
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT

has_own_pixels() { [ -n "${PICTURES:-}" ] && ! grep -q 'mesh:' "$scene"; }

scenes=0 files=0 slow=0 wrong=0
for scene; do
  name=$(basename "$scene" .yaml)
  # shellcheck disable=SC2086  # a command's words
  run() { timeout "$3" $1 run "$scene" --only "$outputs" --quiet -o "$folder/$2/$name" > "$folder/$2.log" 2>&1; }
  status=0
  run "$program" one "$patience" || status=$?
  if [ "$status" = 124 ]; then
    echo "$scene: takes longer than $patience s, left out"
    slow=$((slow + 1))
    continue
  fi
  same=0
  run "$other" other $((100 * patience)) || same=$?
  scenes=$((scenes + 1))
  if [ "$status" != "$same" ] || ! diff -r -q --exclude=manifest.json --exclude='*.png' "$folder/one" "$folder/other" \
    || { has_own_pixels && ! "$here/same_pixels.py" "$folder/one/$name/sheet.png" "$folder/other/$name/sheet.png"; }; then
    echo "$scene: differs (exit codes $status and $same)"
    wrong=$((wrong + 1))
  fi
  files=$((files + $(find "$folder/one" -type f ! -name manifest.json | wc -l)))
  rm -rf "$folder/one" "$folder/other"
done
echo "$scenes scenes, $files files, $wrong scenes differ, $slow left out"
[ "$wrong" = 0 ] && [ "$scenes" -gt 0 ]
