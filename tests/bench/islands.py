"""What an order leaves behind: the cells that are still to come, at every moment of a stream, as
parts that are connected through faces. All but the largest part are islands."""


def cells_of(path):
    """The cells of an .sva file in pre-order, as tuples of vertex numbers."""
    vertices, cells = 0, []
    with open(path, encoding="ascii") as file:
        for line in file:
            if line[:2] == "v ":
                vertices += 1
            elif line[:2] == "c ":
                numbers = map(int, line.split()[1:5])
                cells.append(tuple(n - 1 if n > 0 else vertices + n for n in numbers))
    return cells


class Parts:
    """Sets of cells that grow and unite."""

    def __init__(self, count):
        self.parent, self.size = list(range(count)), [0] * count
        self.count = self.largest = self.cells = 0

    def root(self, cell):
        while self.parent[cell] != cell:
            self.parent[cell] = cell = self.parent[self.parent[cell]]
        return cell

    def add(self, cell):
        self.size[cell] = 1
        self.count += 1
        self.cells += 1
        self.largest = max(self.largest, 1)

    def unite(self, a, b):
        a, b = self.root(a), self.root(b)
        if a == b:
            return
        if self.size[a] < self.size[b]:
            a, b = b, a
        self.parent[b] = a
        self.size[a] += self.size[b]
        self.count -= 1
        self.largest = max(self.largest, self.size[a])


def of(path):
    """The most islands at once, and the most cells in islands, in percent of all. From the end of
    the stream to its beginning, so that parts only grow."""
    cells = cells_of(path)
    parts, open_faces = Parts(len(cells)), {}
    most = most_cells = 0
    for cell in range(len(cells) - 1, -1, -1):
        parts.add(cell)
        corners = sorted(cells[cell])
        for left_out in range(4):
            face = tuple(corners[:left_out] + corners[left_out + 1:])
            other = open_faces.pop(face, None)
            if other is None:
                open_faces[face] = cell
            else:
                parts.unite(cell, other)
        most = max(most, parts.count - 1)
        most_cells = max(most_cells, parts.cells - parts.largest)
    return {"most": most, "most_cells_percent": 100 * most_cells / max(len(cells), 1)}
