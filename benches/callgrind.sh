#!/bin/sh
# Instructions a step, counted by callgrind: the same on a busy machine as on an idle one.
#
# Each kernel runs twice, and the longer run less the shorter one, over the steps between them,
# leaves out what it takes to start.
set -eu
cd "$(dirname "$0")/.."

few=10000
many=110000

for tool in cargo valgrind; do
    if ! command -v "$tool" >/dev/null; then
        echo "callgrind.sh needs $tool, which is not installed" >&2
        exit 1
    fi
done

program=$(cargo bench -p pendula-benches --bench instructions --no-run --message-format=json |
    sed -n 's/.*"executable":"\([^"]*\)".*/\1/p' | tail -n 1)
if [ ! -x "$program" ]; then
    echo "callgrind.sh found no program that cargo built for the bench 'instructions'" >&2
    exit 1
fi

# instructions KERNEL STEPS
instructions() {
    counted=$(valgrind --tool=callgrind --callgrind-out-file=/dev/null \
        "$program" count "$1" "$2" 2>&1 | sed -n 's/.*Collected *: *\([0-9]*\).*/\1/p')
    if [ -z "$counted" ]; then
        echo "callgrind counted nothing for $1" >&2
        exit 1
    fi
    echo "$counted"
}

printf '%-24s | %s\n' kernel 'instructions a step'
"$program" | while read -r kernel; do
    short=$(instructions "$kernel" "$few")
    long=$(instructions "$kernel" "$many")
    echo "$kernel $short $long" | awk -v steps=$((many - few)) \
        '{ printf "%-24s | %19.1f\n", $1, ($3 - $2) / steps }'
done
