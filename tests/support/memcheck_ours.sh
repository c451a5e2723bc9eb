#!/usr/bin/env bash
# Runs an interpreter under Valgrind's memcheck and fails where anything of ours, by a function's or
# a file's name, stands in what memcheck reports: errors, and blocks that are lost. What the
# interpreter keeps until its end, or loses itself, is not told.
#   memcheck_ours.sh SUPPRESSIONS PROGRAM [ARGUMENT...]
set -uo pipefail

suppressions=$1
log=$(mktemp) || exit 1
trap 'rm -f "$log"' EXIT
PYTHONMALLOC=malloc valgrind -q --leak-check=full --show-leak-kinds=definite,indirect \
  --num-callers=40 --suppressions="$suppressions" --log-file="$log" "${@:2}" || exit
# One report to a paragraph.
sed 's/^==[0-9]*== *//' "$log" | awk -v RS= '/tetstream/ { print; print ""; found = 1 } END { exit found }'
