# Plots the resources of driver and server over time: gnuplot -c resources.gp driver.csv robot.csv resources.png
set terminal pngcairo size 1200,700 font ",11"
set output ARG3
set datafile separator ","
set key outside right
set grid
set xlabel "minutes"
set yrange [0:*]
set multiplot layout 2,1
set title "Resident memory"
set ylabel "MB"
plot ARG1 using ($1/60):($2/1024) with lines lw 2 title "driver", \
     ARG2 using ($1/60):($2/1024) with lines lw 2 title "server"
set title "Descriptors and threads"
set ylabel ""
plot ARG1 using ($1/60):3 with lines lw 2 title "driver, descriptors", \
     ARG1 using ($1/60):4 with lines lw 2 title "driver, threads", \
     ARG2 using ($1/60):3 with lines lw 2 title "server, descriptors"
unset multiplot
