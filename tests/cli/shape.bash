# --shape solver: the example bracket without dihedral angles below 10 degrees, where the default
# mode makes some; at little cost in the error as the run estimates it.
source "${BASH_SOURCE%/*}/common.bash"

[[ -n $TETSTREAM_PYTHON ]] || not_run "no python3"

bracket=$TETSTREAM_SOURCE/tests/data/bracket/bracket.vtu
expect_error 6 '"paper" knows no shapes' simplify "$bracket" out.tets --ratio 0.1 --mode paper \
  --shape solver
expect_error 1 '"round" is none of: field solver' simplify "$bracket" out.tets --shape round

# below DEGREES FILE: cells with a smaller dihedral angle.
below() {
  tetstream convert "$2" out.sva --quiet
  "$TETSTREAM_PYTHON" - "$1" <<'END'
import math, sys

points, thin = [], 0
least = math.cos(math.radians(float(sys.argv[1])))


def minus(a, b):
    return [x - y for x, y in zip(a, b)]


def cross(a, b):
    return [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]]


def dot(a, b):
    return sum(x * y for x, y in zip(a, b))


def is_thin(p):
    normals = []
    for k in range(4):  # out of the cell
        a, b, c = (p[i] for i in range(4) if i != k)
        n = cross(minus(b, a), minus(c, a))
        if dot(n, minus(p[k], a)) > 0:
            n = [-x for x in n]
        normals.append([x / math.sqrt(dot(n, n)) for x in n])
    return any(-dot(normals[i], normals[j]) > least for i in range(4) for j in range(i))


for line in open("out.sva", encoding="ascii"):
    words = line.split()
    if words and words[0] == "v":
        points.append([float(x) for x in words[1:4]])
    elif words and words[0] == "c":
        corners = [int(i) for i in words[1:5]]
        thin += is_thin([points[i - 1] if i > 0 else points[len(points) + i] for i in corners])
print(thin)
END
}

# error_of NAME OPTIONS...: simplifies to NAME.tets and prints the estimated error.
error_of() {
  local name=$1
  shift
  tetstream simplify "$bracket" "$name.tets" --ratio 0.1 --field von_mises --quiet \
    --report json "$@" >"$logs/report" 2>&1
  member "$(<"$logs/report")" estimated_error
}
usual=$(error_of field --shape field)
[[ $usual == "$(error_of default)" ]] || fail "field is not the default"
[[ $(bytes_of field.tets) == "$(bytes_of default.tets)" ]] || fail "field is not the default"
solver=$(error_of solver --shape solver)
cells=$(cells_in solver.tets)
((cells <= 7523 && cells >= 7500)) || fail "$cells cells"
"$TETSTREAM_PYTHON" -c "import sys; sys.exit(not $solver <= 1.5 * $usual)" ||
  fail "the error is $solver, $usual in the default mode"
(($(below 10 field.tets) > 75)) || fail "the default mode has no thin cells: nothing is shown"
thin=$(below 9.99 solver.tets)
((thin == 0)) || fail "$thin of $cells cells are below 10 degrees"
error_of again --shape solver >"$logs/again"
[[ $(bytes_of solver.tets) == "$(bytes_of again.tets)" ]] || fail "two runs, different bytes"
