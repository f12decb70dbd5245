# The benchmarks: sourced by `./dev bench`, whose functions install and build it uses.
# shellcheck shell=sh disable=SC2154

bench_packages=libbenchmark-dev
count_packages=valgrind
peer_packages='libbullet-dev libode-dev libmujoco-dev liblammps-dev libbox2d-dev'
picture_packages='povray python3-vtk9 python3-numpy xvfb xauth libgl1-mesa-dri'

bench_usage() {
  cat << 'END'
usage: ./dev bench [WHAT]

  [OPTIONS]           the benchmarks of kernels and whole scenes; OPTIONS: those of Google Benchmark
  gas                 time of a collision and memory of a ball, from one ball to a million, as CSV and plots in build/
  contacts [FAMILY]   the contact solver alone: certificates, errors and times, as CSV; FAMILY: small, medium,
                      hard, large
  tolerances          the effect of each constant of src/simulate/tolerances.h, 4 times as large and as small
  peers [CASE]        carom beside other libraries: tables, and build/peers.csv; CASE: bounce, cradle, gas, settling
  pictures [PART...]  a picture's CPU time beside VTK's and POV-Ray's, a film's rate beside x264's, start and
                      memory: tables, and build/pictures.csv; PART: frames, film, start, memory
  pictures look [SCENE...]
                      ten scenes beside POV-Ray's pictures of them, in build/pictures/
  instructions        instructions of a collision, counted by callgrind
  all                 all of these
END
}

bench_kernels_and_scenes() {
  cmake --preset release -DCAROM_BENCHMARKS=ON > /dev/null
  build release carom_benchmarks
  build/release/tests/carom_benchmarks "$@"
}

bench_gas() {
  build release carom_gas
  build/release/tests/carom_gas | tee build/gas.csv
  gnuplot -e "csv='build/gas.csv'; picture='build/gas'" tests/benchmark/gas/gas.gp
  say 'plots of build/gas.csv: build/gas.png and build/gas.svg'
}

bench_contacts() {
  build release carom_contacts
  build/release/tests/carom_contacts "$@" | tee build/contacts.csv
}

bench_tolerances() {
  build release carom_tolerances
  build/release/tests/carom_tolerances
}

# Instructions for 10,976 balls: the difference of two runs, so that start and end cancel.
bench_instructions() {
  # shellcheck disable=SC2086
  install $count_packages
  build release carom_gas
  for collisions in 2 6; do
    valgrind --tool=callgrind --callgrind-out-file=/dev/null build/release/tests/carom_gas 14 "$collisions" \
      > "build/gas.$collisions" 2> "build/instructions.$collisions"
  done
  of() { sed -n "$1" "$2"; }
  less=$(of 's/.*Collected : //p' build/instructions.2) more=$(of 's/.*Collected : //p' build/instructions.6)
  few=$(of 's/.*; \([0-9]*\) in all.*/\1/p' build/gas.2) many=$(of 's/.*; \([0-9]*\) in all.*/\1/p' build/gas.6)
  echo "$(((more - less) / (many - few))) instructions a collision (valgrind has no AVX-512)"
}

bench_peers() {
  # A package that is not available is left out.
  for package in $peer_packages; do (install "$package") || say "continuing without $package"; done
  cmake --preset release -DCAROM_PEERS=ON > /dev/null
  build release carom_peers
  build/release/tests/benchmark/peers/carom_peers "$1"
}

bench_pictures() {
  # A package that is not available is left out.
  for package in $picture_packages; do (install "$package") || say "continuing without $package"; done
  build release carom carom_pictures
  mkdir -p build/pictures
  if [ "${1:-}" = look ]; then
    shift
    tests/benchmark/pictures/look.py build/release/carom scenes build/pictures "$@"
    say 'all pictures: build/pictures/sheet.png'
  else
    tests/benchmark/pictures/bench.py build/release/carom build/release/tests/carom_pictures build "$@"
  fi
}

if [ "${1:-}" = help ]; then
  bench_usage
  exit
fi

cd "$root" || exit
# shellcheck disable=SC2086
install $packages $bench_packages
case ${1:-} in
  gas) bench_gas ;;
  contacts)
    shift
    bench_contacts "$@"
    ;;
  instructions) bench_instructions ;;
  tolerances) bench_tolerances ;;
  peers) bench_peers "${2:-}" ;;
  pictures)
    shift
    bench_pictures "$@"
    ;;
  all)
    bench_kernels_and_scenes
    bench_gas
    bench_contacts
    bench_instructions
    bench_tolerances
    bench_peers ''
    bench_pictures
    ;;
  *) bench_kernels_and_scenes "$@" ;;
esac
