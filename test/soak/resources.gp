# Plots the resources of driver and server over time: gnuplot -c resources.gp resources.csv resources.png
set terminal pngcairo size 1200,1000 font ",11"
set output ARG2
set datafile separator ","
set key outside right
set grid
set lmargin 10
set rmargin 26
set xlabel "minutes"
set yrange [0:*]
set multiplot layout 3,1
set title "Resident memory"
set ylabel "MB"
plot ARG1 using ($1/60):($2/1024) with lines lw 2 title "driver", \
     ARG1 using ($1/60):($5/1024) with lines lw 2 title "server"
set title "Descriptors and threads"
set ylabel ""
plot ARG1 using ($1/60):3 with lines lw 2 title "driver, descriptors", \
     ARG1 using ($1/60):4 with lines lw 2 title "driver, threads", \
     ARG1 using ($1/60):6 with lines lw 2 title "server, descriptors", \
     ARG1 using ($1/60):7 with lines lw 2 title "server, threads"
set title "Pictures and faults so far"
plot ARG1 using ($1/60):8 with lines lw 2 title "pictures", \
     ARG1 using ($1/60):($9*100) with lines lw 2 title "faults x 100"
unset multiplot
