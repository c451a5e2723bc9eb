"""What is embedded in a labelled tetrahedral mesh, found anew from its cells: parts of regions and
their boundaries, interfaces, and the graph of the curves where interfaces meet. Shares no code
with the library."""
from collections import Counter

import numpy as np
from scipy.sparse import coo_matrix
from scipy.sparse.csgraph import connected_components

OUTSIDE = -1  # as a region, by its place


def components(count, pairs):
    graph = coo_matrix((np.ones(len(pairs)), (pairs[:, 0], pairs[:, 1])), (count, count))
    return connected_components(graph, directed=False)[1]


def euler_of(cells):
    """Vertices minus edges plus faces (minus cells) of the complex of these simplices."""
    rows = [cells]
    while rows[-1].shape[1] > 1:
        s = rows[-1]
        rows.append(np.unique(np.concatenate([np.delete(s, j, 1) for j in range(s.shape[1])]),
                              axis=0))
    return sum((-1) ** (s.shape[1] - 1) * len(np.unique(s, axis=0)) for s in rows)


class Strata:
    """points (n, 3), cells (m, 4), and a label to each cell."""

    def __init__(self, points, cells, labels):
        self.points = points
        self.values, region = np.unique(labels, return_inverse=True)
        self.cells, self.region = np.sort(cells, 1), region.ravel()
        self.find_sheets()
        self.find_curves()

    def find_sheets(self):
        faces = self.cells[:, [[1, 2, 3], [0, 2, 3], [0, 1, 3], [0, 1, 2]]].reshape(-1, 3)
        order = np.lexsort(faces.T[::-1])
        faces, owner = faces[order], order // 4
        first = np.ones(len(faces), bool)
        first[1:] = (faces[1:] != faces[:-1]).any(1)
        start = np.flatnonzero(first)
        count = np.diff(np.append(start, len(faces)))
        one, two = start[count == 1], start[count == 2]
        self.joined = np.stack([owner[two], owner[two + 1]], 1)
        sides = self.region[self.joined]
        differ = sides[:, 0] != sides[:, 1]
        self.interface, self.outer = faces[two[differ]], faces[one]
        self.sheets = np.concatenate([self.interface, self.outer])
        self.sides = np.concatenate([np.sort(sides[differ], 1), np.stack(
            [np.full(len(one), OUTSIDE), self.region[owner[one]]], 1)])

    def find_curves(self):
        """Edges at which other than two faces of sheets meet, each with the regions round it."""
        edges = self.sheets[:, [[0, 1], [0, 2], [1, 2]]].reshape(-1, 2)
        around = np.repeat(self.sides, 3, axis=0)
        unique, back, count = np.unique(edges, axis=0, return_inverse=True, return_counts=True)
        back = back.ravel()
        number = np.full(len(unique), -1)
        number[count != 2] = np.arange((count != 2).sum())
        self.curves = unique[count != 2]
        regions = [set() for _ in self.curves]
        chosen = number[back] >= 0
        for edge, pair in zip(number[back[chosen]], around[chosen]):
            regions[edge].update(pair)
        self.curve_regions = [tuple(sorted(r)) for r in regions]

    def regions(self):
        """Of each label: sizes do not count, parts and Euler characteristics do."""
        same = self.region[self.joined[:, 0]] == self.region[self.joined[:, 1]]
        part = components(len(self.cells), self.joined[same])
        found = {}
        for r, label in enumerate(self.values):
            mine = (self.sides == r).any(1)
            found[int(label)] = {"parts": len(np.unique(part[self.region == r])),
                                 "euler": int(euler_of(self.cells[self.region == r])),
                                 "euler_boundary": int(euler_of(self.sheets[mine]))}
        return found

    def contacts(self):
        """Of each pair of regions that touch: parts of their common sheet, joined by edges."""
        found = {}
        for pair in np.unique(self.sides, axis=0):
            faces = self.sheets[(self.sides == pair).all(1)]
            edges = np.sort(faces[:, [[0, 1], [0, 2], [1, 2]]].reshape(-1, 2), 1)
            order = np.lexsort(edges.T[::-1])
            equal = (edges[order][1:] == edges[order][:-1]).all(1)
            links = np.stack([order[:-1][equal] // 3, order[1:][equal] // 3], 1)
            found[tuple(int(r) for r in pair)] = (
                len(np.unique(components(len(faces), links))), int(euler_of(faces)))
        return found

    def graph(self):
        """The branches of the curves: their ends, as places, and the regions round them; closed
        ones have none. Corners do not move, so that places tell which is which."""
        at = {}
        for i, (a, b) in enumerate(self.curves):
            at.setdefault(int(a), []).append(i)
            at.setdefault(int(b), []).append(i)
        is_corner = {v: len(e) != 2 or self.curve_regions[e[0]] != self.curve_regions[e[1]]
                     for v, e in at.items()}
        seen = np.zeros(len(self.curves), bool)
        branches = Counter()

        def follow(vertex, edge):
            while True:
                seen[edge] = True
                a, b = self.curves[edge]
                vertex = int(b if vertex == a else a)
                if is_corner[vertex]:
                    return vertex
                ahead = [e for e in at[vertex] if not seen[e]]
                if not ahead:
                    return None
                edge = ahead[0]

        for vertex in at:
            for edge in at[vertex] if is_corner[vertex] else []:
                if not seen[edge]:
                    ends = [self.place(vertex), self.place(follow(vertex, edge))]
                    branches[tuple(sorted(ends)), self.curve_regions[edge]] += 1
        for edge, (a, _) in enumerate(self.curves):
            if not seen[edge]:
                follow(int(a), edge)
                branches["closed", self.curve_regions[edge]] += 1
        return branches

    def place(self, vertex):
        return tuple(float(x) for x in self.points[vertex])


def differences(before, after):
    """What of two meshes' strata differs, as sentences."""
    found = []
    for what in ("regions", "contacts", "graph"):
        a, b = getattr(before, what)(), getattr(after, what)()
        wrong = [key for key in set(a) | set(b) if a.get(key) != b.get(key)]
        for key in wrong[:5]:
            found.append(f"{what} {key}: {a.get(key)} before, {b.get(key)} after")
        if len(wrong) > 5:
            found.append(f"{what}: {len(wrong)} in all")
    return found
