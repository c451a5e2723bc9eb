# The programs of the tutorial: `tutorial.bash NAME` runs one and looks at its answer.
source "${BASH_SOURCE%/*}/common.bash"
name=$1

# only_line WORDS: this is a line of $out.
only_line() {
  [[ $'\n'$out$'\n' == *$'\n'"$1"$'\n'* ]] || fail "no line \"$1\" in: $out"
}

case $name in
  01_files)  # as the command does it
    expect 0 simplify "$mesh" command.vtu --quiet --ratio 0.1
    example 0 $name "$mesh" small.vtu
    cmp small.vtu command.vtu || fail "command and program do not give the same"
    example 1 $name nothing.vtu out.vtu
    contains "$err" "nothing.vtu: cannot open"
    only_files small.vtu command.vtu
    ;;
  02_arrays)
    example 0 $name
    [[ $(line cells) =~ ^24576\ -\>\ ([0-9]+)$ ]] || fail "$out"
    near "${BASH_REMATCH[1]}" 2457 0.005
    near "$(line volume)" 1 1e-5
    only_line "error below 1e-9: yes"
    ;;
  03_options)
    example 0 $name
    only_line "memory is 67108864 bytes"
    only_line "ratio is still 0.25"
    contains "$out" 'refused: tetstream_options_set_double: option "ratio": 25 is outside'
    contains "$out" 'refused: tetstream_options_parse: there is no option "ration"'
    rows=$(grep -c '^OPTION_' "$TETSTREAM_SOURCE/lib/api/options.def")
    (($(grep -c '^  [1-9]' <<<"$out") == rows)) || fail "not $rows options"
    ;;
  04_reader)
    if is_slow; then length=48; else length=480; fi
    example 0 $name $length bar.vtu
    [[ $out =~ ^cells\ ([0-9]+)\ -\>\ ([0-9]+),\ front\ ([0-9]+)\ vertices ]] || fail "$out"
    ((BASH_REMATCH[1] == 384 * length)) || fail "$out"
    near "${BASH_REMATCH[2]}" "$((384 * length / 10))" 0.003
    ((BASH_REMATCH[3] <= 2 * 81)) || fail "the front is wider than two layers: $out"
    # x^2 at points an eighth apart: 1/3 + (1/8)^2 / 6 in the mean.
    example 0 05_writer bar.vtu
    near "$(line volume)" "$((length / 8))" 1e-4
    near "$(line heat)" "$(awk -v l=$length 'BEGIN { print l / 8 * (1 / 3 + 1 / 384) }')" 1e-3
    example 1 $name 30 nowhere/bar.vtu
    contains "$err" "nowhere/bar.vtu"
    ;;
  05_writer)
    expect 0 generate fluid box.tets --cells 3000
    example 0 $name box.tets
    near "$(line volume)" 4 1e-5
    if ! is_slow; then
      expect 0 generate ball ball.vtu --cells 3000
      expect 0 compare ball.vtu ball.vtu --samples 100 --report json
      volume=$(member "$out" volume)
      example 0 $name ball.vtu
      near "$(line volume)" "$volume" 1e-9
    fi
    example 1 $name nothing.tets
    contains "$err" "nothing.tets"
    ;;
  06_push)
    example 0 $name 40 pushed.tets
    example 0 04_reader 40 pulled.tets
    cmp pushed.tets pulled.tets || fail "pushing and pulling do not give the same"
    ;;
  07_progress)
    example 0 $name "$mesh" small.vtu
    [[ $out == complete ]] || fail "$out"
    contains "$err" "simplify"
    contains "$err" "100 %"
    example 1 $name "$mesh" out.vtu 0.5
    [[ $out == stopped ]] || fail "$out"
    only_files small.vtu
    # Ctrl-C, once it is under way.
    expect 0 generate fluid long.tets --cells "$(is_slow && echo 20000 || echo 400000)"
    $launcher "$EXAMPLES/$name" long.tets out.tets >"$logs/words" 2>"$logs/shown" &
    program=$!
    until [[ -s $logs/shown ]]; do sleep 0.01; done
    kill -INT $program
    wait $program && fail "it was not stopped"
    [[ $(<"$logs/words") == stopped ]] || fail "not stopped by Ctrl-C"
    only_files small.vtu long.tets
    ;;
  08_errors)
    example 0 $name
    statuses=$(sed 's/:.*//; s/^TETSTREAM_//' <<<"$out" | tr '\n' ' ')
    [[ $statuses == "IO BAD_DATA UNSUPPORTED BAD_STATE CALLBACK BAD_DATA " ]] || fail "$out"
    contains "$out" "no-such-mesh.vtu: cannot open"
    contains "$out" "callback returned 28"
    contains "$out" "cell 1: vertex 7"
    ;;
  09_report)
    example 0 $name "$mesh" out.vtu 1 100
    [[ $(line reached) == error ]] || fail "$out"
    near "$(line error | cut -d " " -f 1)" 0.87 0.03
    example 0 $name "$mesh" out.vtu 50 1500
    [[ $(line reached) == cells ]] || fail "$out"
    near "$(line cells | cut -d ' ' -f 3)" 1500 0.01
    example 1 $name "$mesh" out.vtu 500 20000
    contains "$err" '"error": 500 is outside'
    ;;
  10_compare)
    expect 0 generate ball ball.vtu --cells 2000
    expect 0 simplify ball.vtu small.vtu --quiet --ratio 0.1
    example 0 $name ball.vtu small.vtu
    [[ $(line topology) == kept ]] || fail "$out"
    if is_slow; then exit; fi
    mine=$(line density | sed 's/RMS \([^ ]*\) %.*/\1/')
    expect 0 compare ball.vtu small.vtu --report json
    theirs=$(sed -n '/"density"/,/}/s/.*"rms_percent": \([^,]*\).*/\1/p' <<<"$out")
    near "$mine" "$theirs" 1e-5
    example 0 $name small.vtu small.vtu
    awk '{ exit !($3 < 1e-9) }' <<<"RMS $(line density)" || fail "an error of a mesh against itself"
    ;;
  11_map)
    example 0 $name 20000
    [[ $out =~ ^([0-9]+)\ of\ ([0-9]+)\ vertices.*\ yes$ ]] || fail "$out"
    ((BASH_REMATCH[1] == BASH_REMATCH[2] && BASH_REMATCH[1] > 3000)) || fail "$out"
    ;;
  12_layout)
    example 0 $name "$mesh" ordered.tets hilbert ordered.svg
    [[ $out =~ ([0-9]+)\ vertices\ wait.*ordered.tets:\ ([0-9]+)\ vertices\ wait ]] || fail "$out"
    is_slow || ((BASH_REMATCH[1] > 10 * BASH_REMATCH[2])) || fail "not a much better order: $out"
    only_line "$(cells_in "$mesh") cells in the order hilbert"
    contains "$(<ordered.svg)" "<svg"
    example 1 $name "$mesh" out.tets nonsense
    contains "$err" '"nonsense" is none of'
    ;;
  *) fail "the tutorial has no test of $name" ;;
esac
