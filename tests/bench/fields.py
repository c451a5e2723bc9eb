#!/usr/bin/python3
"""Several fields at once: what they cost, and what each loses.

Cost: one mesh of jittered cubes with 1 to 125 components of waves, all of them measured, or the
first alone and the others carried; `.tets` file to `.tets` file, medians of --rounds rounds in
which all counts run in turn. `ns / cell` is user time over cells of the input; the ratio is to one
component that is alone on the mesh.

Errors (with the judge): fields of one mesh simplified together, against each simplified alone
(`--field NAME` once), the window four fronts. RMS in percent of the field's range; beside it that
of VTK's run for that field alone, where one is recorded in vtk_runs.csv.
"""
import math
import os
import random
import statistics
import sys

import compare

sys.path.insert(0, os.path.join(os.path.dirname(os.path.abspath(__file__)), "..", "support"))
import harness  # noqa: E402

SETS = (("fluidity_seamount", ("Velocity", "Pressure")),
        ("chaste_twin_flow", ("Pressure", "temperature", "Velocity")),
        ("fluid+stress", ("density", "velocity", "stress")),
        ("fluidity_seamount", ("Velocity", "Pressure", "Temperature")),
        ("vampy_artery_cfd", ("p_t200", "u_t200")),
        ("cylflow", ("Temperature", "Rho", "Velocity")),
        ("bluntfin", ("Density", "Momentum", "Pressure", "Temperature")),
        ("bracket", ("xdsp", "ydsp", "zdsp")))
COST_HEAD = ("components", "measured", "user s", "ns / cell", "to one", "peak MB")
ERROR_HEAD = ("mesh", "field", "ratio", "RMS % together", "alone", "VTK alone", "together / alone",
              "together / VTK")


def mesh_and_fields(word):
    mesh, fields = harness.mesh_and_field(word)
    return mesh, tuple(fields.split(","))


def arguments():
    parser = harness.bench_parser(__doc__)
    parser.add_argument("--side", type=int, default=32, help="cubes along a side, of six cells")
    parser.add_argument("--components", nargs="+", type=int, metavar="K",
                        default=[1, 2, 3, 4, 6, 7, 9, 20, 40, 125])
    parser.add_argument("--sets", nargs="+", type=mesh_and_fields, default=SETS,
                        metavar="MESH:FIELD,FIELD", help="of the errors")
    parser.add_argument("--cells", type=int, default=300000, help="of generated meshes")
    parser.add_argument("--ratio", type=float, default=0.1)
    parser.add_argument("--rounds", type=int, default=5)
    parser.add_argument("--fronts", type=float, default=4)
    parser.add_argument("--samples", type=int, default=200000, help="of the judge")
    parser.add_argument("--no-cost", action="store_true", help="errors only")
    parser.add_argument("--no-errors", action="store_true", help="cost only: needs no judge")
    return parser.parse_args()


# ----------------------------------------------------------------------------------------- cost
def numbers(name, kind, components, values):
    """A DataArray of a .vtu file."""
    text = " ".join(values)
    return (f'<DataArray type="{kind}" Name="{name}" NumberOfComponents="{components}" '
            f'format="ascii">{text}</DataArray>')


def jittered_cubes(side):
    """Points in the unit cube, and cells: each cube is cut along its diagonal."""
    chance = random.Random(1)
    at = range(side + 1)
    points = [tuple((x + (chance.uniform(-0.2, 0.2) if 0 < x < side else 0)) / side
                    for x in (i, j, k)) for k in at for j in at for i in at]
    step = (1, side + 1, (side + 1) ** 2)
    walks = ((0, 1), (1, 2), (2, 0), (1, 0), (2, 1), (0, 2))  # the last step is the third one
    cells = []
    for origin in (i * step[0] + j * step[1] + k * step[2]
                   for k in range(side) for j in range(side) for i in range(side)):
        for number, (first, second) in enumerate(walks):
            a, b = origin + step[first], origin + step[first] + step[second]
            cell = (origin, a, b, origin + sum(step))
            cells.append(cell if number < 3 else (cell[0], cell[2], cell[1], cell[3]))
    return points, cells


def write_waves(path, points, cells, components):
    """The mesh with that many fields, wave0, wave1 ..., of one component each."""
    fields = []
    for wave in range(components):
        chance = random.Random(100 + wave)
        turns = [chance.uniform(-9, 9) for _ in range(3)]
        values = (f"{math.sin(turns[0] * x + turns[1] * y + turns[2] * z + wave):.6g}"
                  for x, y, z in points)
        fields.append(numbers(f"wave{wave}", "Float32", 1, values))
    with open(path, "w", encoding="ascii") as file:
        file.write('<VTKFile type="UnstructuredGrid" version="1.0" byte_order="LittleEndian" '
                   f'header_type="UInt64"><UnstructuredGrid><Piece NumberOfPoints="{len(points)}" '
                   f'NumberOfCells="{len(cells)}"><PointData>' + "\n".join(fields)
                   + "</PointData><Points>"
                   + numbers("Points", "Float32", 3, (f"{x:.7g}" for p in points for x in p))
                   + "</Points><Cells>"
                   + numbers("connectivity", "Int64", 1, (str(v) for c in cells for v in c))
                   + numbers("offsets", "Int64", 1, map(str, range(4, 4 * len(cells) + 1, 4)))
                   + numbers("types", "UInt8", 1, ("10" for _ in cells))
                   + "</Cells></Piece></UnstructuredGrid></VTKFile>")


def cost_table(args, tetstream):
    points, cells = jittered_cubes(args.side)
    runs = {}
    for count in args.components:
        mesh = tetstream.path(f"waves{count}.vtu")
        write_waves(mesh, points, cells, count)
        stream = tetstream.convert(mesh, tetstream.path(f"waves{count}.tets"))
        os.remove(mesh)
        runs[count, "all"] = [stream]
        if count > 1:
            runs[count, "1"] = [stream, "--field", "wave0"]
    taken = {key: [] for key in runs}
    for _ in range(args.rounds):
        for key, (stream, *words) in runs.items():
            report = tetstream.simplify(stream, tetstream.path("out.tets"), "--ratio", args.ratio,
                                        *words, *args.options)
            taken[key].append(report["measured"])
    harness.print_head(COST_HEAD)
    one = statistics.median(m["user"] for m in taken[args.components[0], "all"])
    one = max(one, 0.001)  # a run that is too short for the clock
    for (count, measured), found in taken.items():
        user = statistics.median(m["user"] for m in found)
        peak = max(m["peak_bytes"] for m in found)
        harness.print_row([count, measured, f"{user:.3f}", f"{1e9 * user / len(cells):.0f}",
                           f"{user / one:.2f}", f"{harness.megabytes(peak):.1f}"])


# --------------------------------------------------------------------------------------- errors
class Errors:
    def __init__(self, args, tetstream):
        self.args, self.tetstream = args, tetstream
        self.judge = harness.Judge(args.samples)
        self.vtk = compare.recorded_runs()
        self.alone = {}

    def mesh(self, name):
        """As a .tets file and as a .vtu file."""
        stream = self.tetstream.path("in.tets")
        if not name.startswith(("fluid+", "ball+")):
            return self.tetstream.convert(harness.mesh_path(name), stream), harness.mesh_path(name)
        self.tetstream.run("generate", name, "--cells", self.args.cells, stream, "--quiet")
        return stream, self.tetstream.convert(stream, self.tetstream.path(name + ".vtu"))

    def simplified(self, stream, fields):
        out = self.tetstream.path("out.tets")
        window = compare.window_of(self.args.fronts, self.tetstream.info(stream))
        words = [word for field in fields for word in ("--field", field)]
        self.tetstream.simplify(stream, out, "--ratio", self.args.ratio, "--window", window, *words,
                                *self.args.options)
        return self.tetstream.convert(out, self.tetstream.path("out.vtu"))

    def rms(self, original, simplified, field):
        return self.judge(original, simplified, field)["field"]["rms"]

    def lines(self, name, fields):
        stream, original = self.mesh(name)
        for field in fields:
            if (name, field) not in self.alone:
                simplified = self.simplified(stream, [field])
                self.alone[name, field] = self.rms(original, simplified, field)
        together = self.simplified(stream, fields)
        ratios = []
        for field in fields:
            rms, alone = self.rms(original, together, field), self.alone[name, field]
            vtk = [run["rms"] for run in self.vtk.get((name, field, self.args.ratio), [])
                   if run["kept"] <= 1.05 * self.args.ratio]
            ratios.append(rms / alone)
            harness.print_row([name, field, f"{self.args.ratio:g}", f"{rms:.3g}", f"{alone:.3g}",
                               f"{min(vtk):.3g}" if vtk else "-", f"{ratios[-1]:.2f}",
                               f"{rms / min(vtk):.2f}" if vtk else "-"])
        harness.print_row([name, "**geometric mean**"] + [""] * 4
                          + [f"{statistics.geometric_mean(ratios):.2f}", ""])
        return ratios


def main():
    args = arguments()
    tetstream, _ = harness.bench_programs(args.build)
    if not args.no_cost:
        cost_table(args, tetstream)
        print()
    if args.no_errors:
        return
    errors = Errors(args, tetstream)
    harness.print_head(ERROR_HEAD)
    ratios = [ratio for name, fields in args.sets for ratio in errors.lines(name, fields)]
    harness.print_row(["**all**", "**geometric mean**"] + [""] * 4
                      + [f"{statistics.geometric_mean(ratios):.2f}", ""])


if __name__ == "__main__":
    main()
