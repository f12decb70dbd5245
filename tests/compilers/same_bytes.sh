#!/bin/sh
# same_bytes.sh PROGRAM OTHER SCENE...: runs each scene by the programs of two compilers and compares every byte of their
# files (manifests have wall times and are left out). Scenes that take longer than PATIENCE seconds are listed and left
# out.
set -eu

program=$1 other=$2
shift 2
patience=${PATIENCE:-10}
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT

scenes=0 files=0 slow=0 wrong=0
for scene; do
  name=$(basename "$scene" .yaml)
  run() { timeout "$3" "$1" run "$scene" --only trajectory,collisions,energy --quiet -o "$folder/$2/$name" > "$folder/$2.log" 2>&1; }
  status=0
  run "$program" one "$patience" || status=$?
  if [ "$status" = 124 ]; then
    echo "$scene: takes longer than $patience s, left out"
    slow=$((slow + 1))
    continue
  fi
  same=0
  run "$other" other $((10 * patience)) || same=$?
  scenes=$((scenes + 1))
  if [ "$status" != "$same" ] || ! diff -r -q --exclude=manifest.json "$folder/one" "$folder/other"; then
    echo "$scene: differs (exit codes $status and $same)"
    wrong=$((wrong + 1))
  fi
  files=$((files + $(find "$folder/one" -type f ! -name manifest.json | wc -l)))
  rm -rf "$folder/one" "$folder/other"
done
echo "$scenes scenes, $files files, $wrong scenes differ, $slow left out"
[ "$wrong" = 0 ] && [ "$scenes" -gt 0 ]
