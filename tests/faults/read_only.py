"""The formats that the command reads and does not write: files of them, made of a MEDIT text."""
import os


def read_mesh(path):
    with open(path) as file:
        words = file.read().split()

    def table(name, width, kind):
        at = words.index(name)
        count = int(words[at + 1])
        values = list(map(kind, words[at + 2:at + 2 + count * width]))
        return [values[i * width:(i + 1) * width] for i in range(count)]
    return [row[:3] for row in table("Vertices", 4, float)], \
        [[corner - 1 for corner in row[:4]] for row in table("Tetrahedra", 5, int)]


def text_of(rows):
    return "".join(" ".join(map(repr, row)) + "\n" for row in rows)


def numbered(rows):
    return [[i + 1, *row] for i, row in enumerate(rows)]


def write_tetgen(path, points, cells):
    with open(path.replace(".node", ".ele"), "w") as file:
        ones = [[corner + 1 for corner in row] for row in cells]
        file.write(f"{len(cells)} 4 0\n" + text_of(numbered(ones)))
    return f"{len(points)} 3 0 0\n" + text_of(numbered(points))


def write_su2(path, points, cells):
    return f"NDIME= 3\nNELEM= {len(cells)}\n" + text_of([[10, *row] for row in cells]) + \
        f"NPOIN= {len(points)}\n" + text_of(points)


def write_xdmf(path, points, cells):
    def item(rows, kind):
        return f'<DataItem Dimensions="{len(rows)} {len(rows[0])}" NumberType="{kind}" ' \
            f'Precision="8" Format="XML">\n{text_of(rows)}</DataItem>'
    return '<Xdmf><Domain><Grid><Topology TopologyType="Tetrahedron">' + item(cells, "Int") + \
        "</Topology><Geometry>" + item(points, "Float") + "</Geometry></Grid></Domain></Xdmf>"


def write_pvtu(path, points, cells):
    return '<VTKFile type="PUnstructuredGrid"><PUnstructuredGrid><Piece Source="in.vtu"/>' \
        "</PUnstructuredGrid></VTKFile>"


def write_pvd(path, points, cells):
    return '<VTKFile type="Collection"><Collection><DataSet timestep="0" file="in.vtu"/>' \
        "</Collection></VTKFile>"


# By the name of the input.
WRITERS = {"in.node": write_tetgen, "in.su2": write_su2, "in.xdmf": write_xdmf,
           "in.pvtu": write_pvtu, "in.pvd": write_pvd}


def make(folder):
    """Beside in.mesh and in.vtu."""
    points, cells = read_mesh(os.path.join(folder, "in.mesh"))
    for source, write in WRITERS.items():
        path = os.path.join(folder, source)
        content = write(path, points, cells)
        with open(path, "wb") as file:
            file.write(content.encode())
