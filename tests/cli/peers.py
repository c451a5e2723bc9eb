"""Reads a file with meshio, and with Gmsh where that is asked for, and compares it with the same mesh
as .vtu: points, cells, fields and regions; or (xdmf FILE MESH) writes MESH with meshio as XDMF, with
values in each way that it has. Exit code 77: the module is not there."""

import sys

try:
    import numpy
    import meshio
except ImportError as error:
    print("not run:", error)
    sys.exit(77)


def tetrahedra(mesh):
    """Corners, and the rows of cell data in all blocks of them."""
    cells, rows = [], []
    for index, block in enumerate(mesh.cells):
        if block.type == "tetra":
            cells.append(block.data)
            rows.append(index)
    return numpy.concatenate(cells), rows


def check(what, a, b):
    a, b = numpy.asarray(a), numpy.asarray(b)
    if a.shape != b.shape or not (a == b).all():
        sys.exit(f"{what} differ: {a.shape} {b.shape}")


def with_meshio(path, wanted):
    mesh = meshio.read(path)
    check("points", mesh.points, wanted.points)
    cells, rows = tetrahedra(mesh)
    check("cells", cells, tetrahedra(wanted)[0])
    for name, values in wanted.point_data.items():
        if name in mesh.point_data:
            check(name, numpy.squeeze(mesh.point_data[name]), values)
    for name in ("gmsh:physical", "medit:ref"):
        if name in mesh.cell_data:
            found = numpy.concatenate([mesh.cell_data[name][row] for row in rows])
            check(name, found, wanted.cell_data["region"][0])
            return
    sys.exit("there are no regions")


def with_gmsh(path, wanted):
    try:
        import gmsh
    except ImportError as error:
        print("not run:", error)
        sys.exit(77)
    gmsh.initialize()
    gmsh.option.setNumber("General.Terminal", 0)
    gmsh.open(path)
    tags, positions, _ = gmsh.model.mesh.getNodes()
    order = numpy.argsort(tags)
    check("points", positions.reshape(-1, 3)[order], wanted.points)
    cells = {}
    for _, entity in gmsh.model.getEntities(3):
        groups = gmsh.model.getPhysicalGroupsForEntity(3, entity)
        _, elements, nodes = gmsh.model.mesh.getElements(3, entity)
        for element, corners in zip(elements[0], nodes[0].reshape(-1, 4)):
            cells[element] = (list(corners - 1), groups[0])
    found = [cells[element] for element in sorted(cells)]
    check("cells", [c for c, _ in found], tetrahedra(wanted)[0])
    check("regions", [g for _, g in found], wanted.cell_data["region"][0])
    if "2.2" not in path:
        views = {gmsh.option.getString(f"View[{gmsh.view.getIndex(t)}].Name"): t
                 for t in gmsh.view.getTags()}
        for name, values in wanted.point_data.items():
            _, _, data, _, _ = gmsh.view.getModelData(views[name], 0)
            check(name, numpy.squeeze(numpy.array(data)), values)
    gmsh.finalize()


def write_xdmf(name, mesh):
    """name-XML.xdmf, name-Binary.xdmf and, where h5py is there, name-HDF.xdmf."""
    for way in ("XML", "Binary", "HDF"):
        try:
            meshio.xdmf.write(f"{name}-{way}.xdmf", mesh, data_format=way)
        except ImportError:
            print("not written:", way)


def same(path, wanted):
    """All arrays, by name; those of points cell by cell, as the points may come in another order."""
    mesh = meshio.read(path)
    mine, theirs = tetrahedra(mesh)[0], tetrahedra(wanted)[0]
    check("points of cells", mesh.points[mine], wanted.points[theirs])
    for name, values in wanted.point_data.items():
        check(name, numpy.squeeze(mesh.point_data[name])[mine], numpy.squeeze(values)[theirs])
    for name, values in wanted.cell_data.items():
        check(name, numpy.squeeze(mesh.cell_data[name][0]), numpy.squeeze(values[0]))


if __name__ == "__main__":
    reference = meshio.read(sys.argv[3])
    {"meshio": with_meshio, "gmsh": with_gmsh, "xdmf": write_xdmf, "same": same}[sys.argv[1]](sys.argv[2], reference)
