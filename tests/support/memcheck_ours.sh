#!/usr/bin/env bash
# Runs an interpreter under Valgrind's memcheck and fails where anything of ours, by a function's or
# a file's name, stands in what memcheck reports: errors, and blocks that are lost. What the
# interpreter keeps until its end, or loses itself, is not told. Where the interpreter does not even
# start under Valgrind, by an instruction that Valgrind has not on this processor (RDTSCP in one of
# Octave's libraries, on a virtual machine without it), the test is skipped and says so.
#   memcheck_ours.sh SUPPRESSIONS PROGRAM [ARGUMENT...]
set -uo pipefail

suppressions=$1
log=$(mktemp) || exit 1
trap 'rm -f "$log" "$log.version"' EXIT
illegal_instruction=132 not_run=77
PYTHONMALLOC=malloc valgrind -q --leak-check=full --show-leak-kinds=definite,indirect \
  --num-callers=40 --suppressions="$suppressions" --log-file="$log" "${@:2}"
status=$?
if ((status == illegal_instruction)); then
  valgrind -q --log-file="$log.version" "$2" --version >/dev/null 2>&1
  if (($? == illegal_instruction)); then
    echo "$2 does not start under Valgrind on this machine:"
    cat "$log.version"
    exit "$not_run"
  fi
fi
if ((status)); then
  cat "$log"
  exit "$status"
fi
# One report to a paragraph.
sed 's/^==[0-9]*== *//' "$log" | awk -v RS= '/tetstream/ { print; print ""; found = 1 } END { exit found }'
