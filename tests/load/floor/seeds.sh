#!/bin/sh
# Runs floor_load with 100 seeds, up to a vehicle on each parking position. Usage: seeds.sh PATH_OF_FLOOR_LOAD
for seed in $(seq 1 100); do
    "$1" --seed "$seed" --density 30,60,100 || exit 1
done
