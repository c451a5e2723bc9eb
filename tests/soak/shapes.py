"""Random meshes of every kind that users have and nobody wants: as arrays, from one seed."""
import numpy

# A cube of six tetrahedra round its diagonal.
CORNERS = numpy.array([[0, 0, 0], [1, 0, 0], [0, 1, 0], [1, 1, 0],
                       [0, 0, 1], [1, 0, 1], [0, 1, 1], [1, 1, 1]])
SIX = numpy.array([[0, 1, 3, 7], [0, 1, 5, 7], [0, 2, 3, 7], [0, 2, 6, 7], [0, 4, 5, 7],
                   [0, 4, 6, 7]])


class Mesh:
    def __init__(self, points, cells):
        self.points, self.cells = points, cells
        self.fields, self.cell_data = {}, {}
        self.story = []


def cubes(there):
    """The cells of those cubes of a grid that are there, on the points that they use."""
    sizes = numpy.array(there.shape) + 1
    at = numpy.argwhere(there)
    corners = (at[:, None, :] + CORNERS[None, :, :]).reshape(-1, 3)
    ids = numpy.ravel_multi_index(corners.T, sizes).reshape(-1, 8)
    cells = ids[:, SIX].reshape(-1, 4)
    used, cells = numpy.unique(cells, return_inverse=True)
    points = numpy.stack(numpy.unravel_index(used, sizes), axis=1).astype(float)
    return Mesh(points, cells.reshape(-1, 4))


def box(random):
    size = random.integers(1, 9, 3)
    return cubes(numpy.ones(size, bool)), f"box {size}"


def one_cell_thick(random):
    size = random.integers(2, 20, 3)
    size[random.integers(3)] = 1
    return cubes(numpy.ones(size, bool)), f"sheet {size}"


def porous(random):
    """Components that touch in faces, edges, vertices or not at all; tunnels and voids."""
    size, share = random.integers(2, 9, 3), random.uniform(0.3, 0.95)
    there = random.random(size) < share
    there.flat[random.integers(there.size)] = True
    return cubes(there), f"porous {size}, {share:.2f} full"


def shells(random):
    """Nested boxes with nothing between."""
    n = int(random.integers(5, 12))
    depth = numpy.minimum.reduce([numpy.minimum(i, n - 1 - i)
                                  for i in numpy.indices((n, n, n))])
    return cubes(depth % 2 == 0), f"shells {n}"


def two_that_touch(random):
    """Two boxes that share one vertex, or one edge."""
    n = int(random.integers(2, 5))
    there = numpy.zeros((2 * n, 2 * n, 2 * n), bool)
    there[:n, :n, :n] = True
    if random.integers(2):
        there[n:, n:, n:] = True
        return cubes(there), "two boxes, one vertex"
    there[n:, n:, :n] = True
    return cubes(there), "two boxes, one edge"


def soup(random):
    """Cells that share nothing."""
    count = int(random.integers(1, 60))
    points = random.random((4 * count, 3)) * 0.2 + numpy.repeat(random.random((count, 3)) * 9, 4, 0)
    return Mesh(points, numpy.arange(4 * count).reshape(-1, 4)), f"soup of {count}"


def fan(random):
    """Cells round one edge, closed or open: every vertex is on the boundary."""
    count = int(random.integers(3, 40))
    closed = bool(random.integers(2))
    angles = numpy.linspace(0, 2 * numpy.pi, count, endpoint=False)
    ring = numpy.stack([numpy.cos(angles), numpy.sin(angles), 0 * angles], 1)
    points = numpy.concatenate([[[0, 0, -1], [0, 0, 1]], ring])
    cells = [[0, 1, 2 + i, 2 + (i + 1) % count] for i in range(count if closed else count - 1)]
    return Mesh(points, numpy.array(cells)), f"fan of {count}"


KINDS = [box, one_cell_thick, porous, shells, two_that_touch, soup, fan]


# ------------------------------------------------------------------------- what is done to them

def jitter(mesh, random):
    share = random.uniform(0, 0.22)
    mesh.points = mesh.points + random.uniform(-share, share, mesh.points.shape)
    return f"jitter {share:.2f}"


def slit(mesh, random):
    """Part of a plane is cut open: its points are there twice."""
    axis = int(random.integers(3))
    middle = numpy.median(mesh.points[:, axis])
    other = (axis + 1) % 3
    on = (numpy.abs(mesh.points[:, axis] - middle) < 0.3) & (
        mesh.points[:, other] > numpy.median(mesh.points[:, other]))
    ids = numpy.flatnonzero(on)
    twin = numpy.arange(len(mesh.points))
    twin[ids] = len(mesh.points) + numpy.arange(len(ids))
    above = mesh.points[mesh.cells].mean(1)[:, axis] > middle
    mesh.cells[above] = twin[mesh.cells[above]]
    mesh.points = numpy.concatenate([mesh.points, mesh.points[ids]])
    return "slit"


def flatten(mesh, random):
    """Some points coincide with a neighbour: cells of no volume."""
    for _ in range(int(random.integers(1, 5))):
        cell = mesh.cells[random.integers(len(mesh.cells))]
        mesh.points[cell[0]] = mesh.points[cell[1]]
    return "flat cells"


def reorder(mesh, random):
    order = random.permutation(len(mesh.points))
    back = numpy.argsort(order)
    mesh.points, mesh.cells = mesh.points[order], back[mesh.cells]
    mesh.cells = mesh.cells[random.permutation(len(mesh.cells))]
    return "shuffled"


def turn_cells(mesh, random):
    columns = numpy.argsort(random.random(mesh.cells.shape), axis=1)
    mesh.cells = numpy.take_along_axis(mesh.cells, columns, axis=1)
    return "either orientation"


def add_unused(mesh, random):
    extra = random.random((int(random.integers(1, 30)), 3)) * 10
    mesh.points = numpy.concatenate([extra, mesh.points])
    mesh.cells = mesh.cells + len(extra)
    return "unused points"


def scale(mesh, random):
    factor, shift = 10.0 ** random.integers(-12, 12), random.uniform(-100, 100, 3)
    mesh.points = (mesh.points + shift * random.integers(2)) * factor
    return f"scale {factor:g}"


def stretch(mesh, random):
    mesh.points = mesh.points * 10.0 ** random.uniform(-3, 0, 3)
    return "stretched"


CHANGES = [jitter, slit, flatten, reorder, turn_cells, add_unused, scale, stretch]


# ----------------------------------------------------------------------------- fields and labels

def normal(points):
    span = numpy.ptp(points, axis=0)
    return (points - points.min(0)) / numpy.where(span > 0, span, 1)


FIELDS = {
    "constant": lambda x, random: numpy.full(len(x), random.normal() * 1e3),
    "linear": lambda x, random: x @ random.normal(size=3),
    "waves": lambda x, random: numpy.sin(x @ random.normal(size=3) * 9),
    "step": lambda x, random: (x[:, 0] > 0.5) * random.normal() * 1e6,
    "noise": lambda x, random: random.normal(size=len(x)),
    "peak": lambda x, random: (numpy.arange(len(x)) == random.integers(len(x))) * 1e30,
    "vector": lambda x, random: numpy.cross(x, random.normal(size=3)),
    "label": lambda x, random: (x[:, 1] * 4).astype("int32"),
}


def add_columns(mesh, random):
    x = normal(mesh.points)
    names = list(FIELDS)
    for name in random.permutation(names)[:random.integers(0, 4)]:
        values = FIELDS[name](x, random)
        if values.dtype.kind == "f":
            values = values.astype(random.choice(["f4", "f8"]))
        mesh.fields[name] = values
    middle = x[mesh.cells].mean(1)
    labels = {"none": None, "halves": middle[:, 0] > 0.5,
              "thirds": (middle[:, 1] * 3).astype(int),
              "random": random.integers(0, 3, len(middle))}
    kind = str(random.choice(list(labels)))
    if labels[kind] is not None:
        mesh.cell_data["region"] = labels[kind].astype("int32")
    if random.integers(3) == 0:
        mesh.cell_data["size"] = random.random(len(middle)).astype("f8")
    return f"fields {list(mesh.fields)}, regions {kind}"


def make(seed):
    random = numpy.random.default_rng(seed)
    mesh, story = KINDS[random.integers(len(KINDS))](random)
    mesh.story.append(story)
    for change in random.permutation(CHANGES)[:random.integers(0, 5)]:
        mesh.story.append(change(mesh, random))
    mesh.story.append(add_columns(mesh, random))
    return mesh
