# What a collision and a ball cost, by the number of balls: the lines "plain" of density 0.5 in the file `csv`, drawn as
# `picture`.png and `picture`.svg.
set datafile separator ','
set key autotitle columnhead top left Left reverse
set title 'Balls in a room, e = 1, 0.5 balls per cubed diameter' font ',14'
set xlabel 'balls'
set ylabel 'CPU time per collision, µs'
set y2label 'peak memory per ball, bytes'
set logscale xy
set logscale y2
set xrange [0.7:1.5e6]
set yrange [0.1:10]
set y2range [100:1e7]
set ytics nomirror
set y2tics
set format x '10^{%L}'
set format y2 '10^{%L}'
set grid xtics ytics linecolor rgb '#dddddd'
plain(value) = strcol(1) eq 'plain' && column(3) == 0.5 ? value : NaN
do for [kind in 'png svg'] {
  if (kind eq 'png') { set terminal pngcairo size 1200,750 font 'DejaVu Sans,12' linewidth 2 }
  else { set terminal svg size 1200,750 font 'DejaVu Sans,12' linewidth 2 }
  set output picture.'.'.kind
  plot csv using (plain($2)):(plain($5)) with linespoints pointtype 7 linecolor rgb '#c0392b' title 'CPU time', \
       csv using (plain($2)):(plain($6)) axes x1y2 with linespoints pointtype 5 linecolor rgb '#2471a3' title 'memory'
}
