#!/usr/bin/python3
"""A picture of one state, without ParaView and without a screen.

    render.py output/cavity/solution.pvd cavity.png --field velocity --component magnitude --warp 50 --edges

    render.py output/buried_cavity/solution.pvd surface.png --time 3e-3 --mirror --edges

    render.py output/following_the_front/solution.pvd strip.png --time 6e-4 1.2e-3 1.8e-3 --edges --range 0 1    side by side

    render.py output/bar/solution.pvd bar.png --warp --mirror --edges         large strain: the body as it is now

FILE is a .pvtu, a .vtu, or the solution.pvd of a run (its last picture, or --time T). Surfaces and edges are those of the
high-order cells themselves, not of their corners. Needs python3-vtk9 and, where no display is, xvfb.
"""
import argparse, os, shutil, sys
import xml.etree.ElementTree as ElementTree
from pathlib import Path

UNITS = {"displacement": "m", "velocity": "m/s", "stress": "Pa", "pressure": "Pa", "von_mises_stress": "Pa", "density": "kg/m³"}
HEAT = ["f2f2f0", "fee8a0", "fec44f", "fe9929", "ec7014", "cc4c02", "8c2d04", "4a1502"]  # light: edges stay visible
COOL_WARM = ["3b4cc0", "6788ee", "9abbff", "c9d7f0", "edd1c2", "f7a889", "e26952", "b40426"]


def stop(message):
    print(f"render: {message}", file=sys.stderr)
    sys.exit(2)


def arguments():
    parser = argparse.ArgumentParser(description=__doc__.split("\n")[0])
    parser.add_argument("file", type=Path, help=".pvtu, .vtu or .pvd")
    parser.add_argument("picture", type=Path, help="PNG to write")
    parser.add_argument("--field", default="velocity", help="name of a field (default: %(default)s)")
    parser.add_argument("--component", default="magnitude",
                        help="magnitude, x, y, z, xx, xy, ... or radial, seen from the origin (default: %(default)s)")
    parser.add_argument("--warp", type=float, nargs="?", const=1., default=0., metavar="FACTOR",
                        help="show the displaced body, the displacement this many times enlarged (no number: as it is)")
    parser.add_argument("--mirror", action="store_true", help="show a meridian plane (x = r, y = z) on both sides of the axis")
    parser.add_argument("--edges", action="store_true", help="draw the edges of the cells")
    parser.add_argument("--range", type=float, nargs=2, metavar=("MIN", "MAX"), help="ends of the colour scale")
    parser.add_argument("--view", type=float, nargs=3, metavar=("X", "Y", "Z"), help="direction from the body to the eye")
    parser.add_argument("--size", type=int, nargs=2, default=(1200, 900), metavar=("WIDTH", "HEIGHT"), help="pixels")
    parser.add_argument("--time", type=float, nargs="+", help="with a .pvd: the picture nearest to this time [s]; several side by side")
    parser.add_argument("--label", help="text of the colour scale (default: field, component and unit)")
    parser.add_argument("--small", action="store_true", help="store 256 colours only, a third of the file (needs python3-pil)")
    return parser.parse_args()


options = arguments()
try:
    import numpy as np
    import vtk
    from vtk.util.numpy_support import numpy_to_vtk, numpy_to_vtkIdTypeArray, vtk_to_numpy
    if options.small:
        from PIL import Image
except ImportError as error:
    stop(f"needs the Python module '{error.name}' (Debian: apt-get install python3-vtk9 python3-numpy python3-pil, run with /usr/bin/python3)")

if not os.environ.get("DISPLAY"):
    if not shutil.which("xvfb-run"):
        stop("there is no display (Debian: apt-get install xvfb)")
    os.execvp("xvfb-run", ["xvfb-run", "-a", sys.executable, *sys.argv])


# --- reading ------------------------------------------------------------------------------------------------------------
def chosen_file(time):
    file = options.file
    if file.suffix == ".pvd" and file.is_file():
        sets = ElementTree.parse(file).getroot().findall(".//DataSet")
        if not sets:
            stop(f"{file} lists no picture")
        at = (lambda s: float(s.get("timestep")))
        best = max(sets, key=at) if time is None else min(sets, key=lambda s: abs(at(s) - time))
        file = file.parent / best.get("file")
    if not file.is_file():
        stop(f"{file} is not there")
    return file


def read(file):
    reader = {".pvtu": vtk.vtkXMLPUnstructuredGridReader, ".vtu": vtk.vtkXMLUnstructuredGridReader}.get(file.suffix)
    if reader is None:
        stop(f"{file} is not a .pvtu, .vtu or .pvd")
    reader = reader()
    reader.SetFileName(str(file))
    reader.Update()
    if reader.GetOutput().GetNumberOfCells() == 0:
        stop(f"{file} has no cells")
    return reader.GetOutput()


def cells_by_order(grid):
    """Yields (order, ids): point ids of all cells of one order, ids[cell, i, j] or [cell, i, j, k] along the reference directions."""
    connectivity = vtk_to_numpy(grid.GetCells().GetConnectivityArray())
    offsets = vtk_to_numpy(grid.GetCells().GetOffsetsArray())
    sizes = np.diff(offsets)
    types = vtk_to_numpy(grid.GetCellTypesArray())
    for kind, size in sorted(set(zip(types.tolist(), sizes.tolist()))):
        if kind in (vtk.VTK_QUAD, vtk.VTK_LAGRANGE_QUADRILATERAL):
            dim, number = 2, vtk.vtkLagrangeQuadrilateral.PointIndexFromIJK
        elif kind in (vtk.VTK_HEXAHEDRON, vtk.VTK_LAGRANGE_HEXAHEDRON):
            dim, number = 3, vtk.vtkLagrangeHexahedron.PointIndexFromIJK
        else:
            stop("only hexahedra and quadrilaterals can be shown")
        order = round(size ** (1 / dim)) - 1
        ids = connectivity[offsets[:-1][(types == kind) & (sizes == size)][:, None] + np.arange(size)]
        block = (order + 1,) * dim
        local = np.array([number(*place, (order,) * dim) for place in np.ndindex(block)]).reshape(block)
        yield order, ids[:, local]


def field(grid):
    """The chosen field at the points, one row of components per point, and a function that reduces such rows to a number."""
    name, component = options.field, options.component
    array = grid.GetPointData().GetArray(name)
    if array is None:
        names = [grid.GetPointData().GetArrayName(i) for i in range(grid.GetPointData().GetNumberOfArrays())]
        stop(f"there is no field '{name}'. Known: {', '.join(names)}.")
    data = vtk_to_numpy(array).astype(float)
    if not np.isfinite(data).all():
        stop(f"'{name}' has values that are not numbers")
    axes = {axis: i for i, axis in enumerate("xyz")}

    def radial(rows, x):
        normal = x / np.maximum(np.linalg.norm(x, axis=1, keepdims=True), 1e-300)
        if rows.shape[1] == 3:
            return np.einsum("ni,ni->n", rows, normal)
        return np.einsum("nij,ni,nj->n", rows.reshape(-1, 3, 3), normal, normal)

    if data.ndim == 1:
        return data[:, None], lambda rows, x: rows[:, 0]
    if component == "magnitude":
        return data, lambda rows, x: np.linalg.norm(rows, axis=1)
    if component == "radial":
        return data, radial
    if data.shape[1] == 3 and component in axes:
        return data, lambda rows, x: rows[:, axes[component]]
    if data.shape[1] == 9 and len(component) == 2 and all(c in axes for c in component):
        return data, lambda rows, x: rows[:, 3 * axes[component[0]] + axes[component[1]]]
    stop(f"'{component}' is not a component of '{name}'")


# --- surfaces -------------------------------------------------------------------------------------------------------------
def lagrange(order, t):
    """Values and derivatives at t of the polynomials on order + 1 points of equal distance: [point, node]."""
    nodes = np.linspace(0., 1., order + 1)
    basis = [np.poly1d(np.delete(nodes, j), r=True) for j in range(order + 1)]
    basis = [p / p(x) for p, x in zip(basis, nodes)]
    return np.array([p(t) for p in basis]).T, np.array([p.deriv()(t) for p in basis]).T


def outer_faces(ids, x):
    """Faces [face, a, b] that only one cell has, first normal direction outwards or inwards alike; plane cells themselves."""
    if ids.ndim == 3:
        return ids
    faces = np.concatenate([ids[:, 0], ids[:, -1], ids[:, :, 0], ids[:, :, -1], ids[:, :, :, 0], ids[:, :, :, -1]])
    corners = faces[:, [0, 0, -1, -1], [0, -1, 0, -1]]
    centre = x[corners].mean(axis=1)
    key = np.round(centre / (np.ptp(x, axis=0).max() * 1e-5)).astype(np.int64)
    _, index, count = np.unique(key, axis=0, return_inverse=True, return_counts=True)
    return faces[count[np.ravel(index)] == 1]


def surface(grid):
    """Fine quadrilaterals on the outer faces, the edges of these faces, and whether no node has a negative value."""
    x = vtk_to_numpy(grid.GetPoints().GetData()).astype(float)
    moved = x
    if options.warp != 0.:
        displacement = grid.GetPointData().GetArray("displacement")
        if displacement is None:
            stop("--warp needs the field 'displacement'")
        moved = x + options.warp * vtk_to_numpy(displacement)
    data, reduce_to_number = field(grid)
    points, normals, colours, quads, lines, n = [], [], [], [], [], 0
    for order, ids in cells_by_order(grid):
        faces = outer_faces(ids, x)
        fine = int(np.clip(np.sqrt(4e5 / max(len(faces), 1)), order, 12))
        # Pieces of edges: short ones lose pixels where they meet.
        piece = fine if order == 1 else fine // 4 if len(faces) > 200 and fine % 4 == 0 else 1
        value, slope = lagrange(order, np.linspace(0., 1., fine + 1))
        p = moved[faces]
        points.append(np.einsum("ai,bj,fijc->fabc", value, value, p).reshape(-1, 3))
        normal = np.cross(np.einsum("ai,bj,fijc->fabc", slope, value, p), np.einsum("ai,bj,fijc->fabc", value, slope, p))
        normals.append((normal / np.maximum(np.linalg.norm(normal, axis=-1, keepdims=True), 1e-300)).reshape(-1, 3))
        # first the polynomial, then its magnitude: the other way round shows negative magnitudes
        rows = np.einsum("ai,bj,fijc->fabc", value, value, data[faces]).reshape(-1, data.shape[1])
        colours.append(reduce_to_number(rows, np.einsum("ai,bj,fijc->fabc", value, value, x[faces]).reshape(-1, 3)))
        number = n + np.arange(len(faces) * (fine + 1) ** 2).reshape(len(faces), fine + 1, fine + 1)
        n += number.size
        quads.append(np.stack([number[:, :-1, :-1], number[:, 1:, :-1], number[:, 1:, 1:], number[:, :-1, 1:]], -1).reshape(-1, 4))
        for side in (number[:, 0], number[:, -1], number[:, :, 0], number[:, :, -1]):
            side = side[:, ::piece]
            lines.append(np.stack([side[:, :-1], side[:, 1:]], -1).reshape(-1, 2))

    def poly_data(cells):
        cells = np.concatenate(cells)
        array = vtk.vtkCellArray()
        array.SetData(numpy_to_vtkIdTypeArray(np.arange(len(cells) + 1, dtype=np.int64) * cells.shape[1], deep=True),
                      numpy_to_vtkIdTypeArray(cells.ravel().astype(np.int64), deep=True))
        data, vtk_points = vtk.vtkPolyData(), vtk.vtkPoints()
        vtk_points.SetData(numpy_to_vtk(np.concatenate(points), deep=True))
        data.SetPoints(vtk_points)
        return data, array

    body, array = poly_data(quads)
    body.SetPolys(array)
    body.GetPointData().SetScalars(numpy_to_vtk(np.concatenate(colours), deep=True))
    body.GetPointData().SetNormals(numpy_to_vtk(np.concatenate(normals), deep=True))
    edges, array = poly_data(lines)
    edges.SetLines(array)
    return body, edges, reduce_to_number(data, x).min() >= 0.


# --- picture --------------------------------------------------------------------------------------------------------------
def colour_scale(low, high, colours):
    table = vtk.vtkColorTransferFunction()
    for position, colour in zip(np.linspace(low, high, len(colours)), colours):
        table.AddRGBPoint(position, *(int(colour[i:i + 2], 16) / 255 for i in (0, 2, 4)))
    return table


def draw(file):
    """The image of one state."""
    grid = read(file)
    body, edges, never_negative = surface(grid)
    if options.range:
        low, high = options.range
    else:
        shown = vtk_to_numpy(body.GetPointData().GetScalars())
        low, high = shown.min(), shown.max()
        if never_negative or 0. < low < 0.02 * high:
            low = 0.
        if low < 0. < high:  # signed fields: grey is zero
            high = max(-low, high)
            low = -high
    if not low < high:
        low, high = low - 0.5 * (abs(low) or 1.), high + 0.5 * (abs(high) or 1.)
    table = colour_scale(low, high, COOL_WARM if low < 0. < high else HEAT)

    # Look at the planes of symmetry of an octant from outside: they show what happens within the body.
    box = np.array(body.GetBounds()).reshape(3, 2)
    size = (box[:, 1] - box[:, 0]).max()
    flat = box[2, 0] == box[2, 1]
    if options.mirror and not (flat and box[0, 0] >= -1e-6 * size):
        stop("--mirror needs a meridian plane")
    at_planes = np.abs(box[:, 0]) < 0.05 * size
    usual = (0., 0., 1.) if flat else np.where(at_planes, -1., 1.) * ((1., 1.35, 0.8) if at_planes.all() else (0.8, -1.35, 0.7))
    view = np.array(usual if options.view is None else options.view)
    view /= np.linalg.norm(view)

    renderer = vtk.vtkRenderer()
    renderer.SetBackground(1., 1., 1.)
    mapper = vtk.vtkPolyDataMapper()
    mapper.SetInputData(body)
    mapper.SetLookupTable(table)
    mapper.SetScalarRange(low, high)
    mapper.InterpolateScalarsBeforeMappingOn()
    actor = vtk.vtkActor()
    actor.SetMapper(mapper)
    actor.GetProperty().SetAmbient(1. if flat else 0.4)  # no shades in a plane: the colours of the scale
    actor.GetProperty().SetDiffuse(0. if flat else 0.65)
    actors = [actor]
    if options.edges:
        line_mapper = vtk.vtkPolyDataMapper()
        line_mapper.SetInputData(edges)
        line_actor = vtk.vtkActor()
        line_actor.SetMapper(line_mapper)
        line_actor.SetPosition(*(2e-3 * size * view))  # before the faces
        line_actor.GetProperty().SetColor(0.12, 0.12, 0.12)
        line_actor.GetProperty().SetLineWidth(max(1., options.size[1] / 700))
        line_actor.GetProperty().LightingOff()
        actors.append(line_actor)
    for shown in actors:
        renderer.AddActor(shown)
        if options.mirror:
            mirrored = vtk.vtkActor()
            mirrored.ShallowCopy(shown)
            mirrored.SetScale(-1., 1., 1.)
            renderer.AddActor(mirrored)

    unit = UNITS.get(options.field)
    many = grid.GetPointData().GetArray(options.field).GetNumberOfComponents() > 1
    title = options.label or " ".join([options.field.replace("_", " ")] + [options.component] * many) + (f" [{unit}]" if unit else "")
    bar = vtk.vtkScalarBarActor()
    bar.SetLookupTable(table)
    bar.SetNumberOfLabels(5)
    bar.SetLabelFormat("%.3g")
    bar.SetOrientationToHorizontal()
    bar.SetMaximumNumberOfColors(256)
    bar.SetBarRatio(0.4)
    bar.SetTextPositionToPrecedeScalarBar()
    bar.SetPosition(0.2, 0.055)
    bar.SetWidth(0.6)
    bar.SetHeight(0.07)
    bar.UnconstrainedFontSizeOn()
    caption = vtk.vtkTextActor()  # the scale's own title overlaps its numbers
    caption.SetInput(title)
    caption.GetPositionCoordinate().SetCoordinateSystemToNormalizedViewport()
    caption.SetPosition(0.5, 0.015)
    caption.GetTextProperty().SetJustificationToCentered()
    for text, height in ((caption.GetTextProperty(), options.size[1] // 34), (bar.GetLabelTextProperty(), options.size[1] // 38)):
        text.SetFontSize(max(8, height))
        text.SetFontFamilyToArial()
        text.SetColor(0., 0., 0.)
        text.BoldOff()
        text.ItalicOff()
        text.ShadowOff()
    renderer.AddActor2D(bar)
    renderer.AddActor2D(caption)

    up = np.array((0., 0., 1.) if abs(view[2]) < 0.98 else (0., 1., 0.))
    right = np.cross(up, view)
    right /= np.linalg.norm(right)
    up = np.cross(view, right)
    # parallel projection that fills the window above the colour scale
    points = vtk_to_numpy(body.GetPoints().GetData())
    if options.mirror:
        points = np.concatenate([points, points * (-1., 1., 1.)])
    horizontal, vertical = points @ right, points @ up
    half = max(np.ptp(vertical) / 0.80, np.ptp(horizontal) * options.size[1] / options.size[0] / 0.94) / 2
    target = right * (horizontal.min() + horizontal.max()) / 2 + up * ((vertical.min() + vertical.max()) / 2 - 0.15 * half)
    target = target + view * (points @ view).mean()
    camera = renderer.GetActiveCamera()
    camera.ParallelProjectionOn()
    camera.SetParallelScale(half)
    camera.SetFocalPoint(*target)
    camera.SetPosition(*(target + 10. * size * view))
    camera.SetViewUp(*up)
    renderer.AutomaticLightCreationOff()
    for position, strength in (((-0.3, 0.4, 1.), 0.75), ((0.5, -0.6, 0.6), 0.4)):
        light = vtk.vtkLight()
        light.SetLightTypeToCameraLight()
        light.SetPosition(*position)
        light.SetIntensity(strength)
        renderer.AddLight(light)
    renderer.ResetCameraClippingRange()

    window = vtk.vtkRenderWindow()
    window.SetOffScreenRendering(1)
    window.SetMultiSamples(8)
    window.SetSize(*options.size)
    window.AddRenderer(renderer)
    window.Render()
    image = vtk.vtkWindowToImageFilter()
    image.SetInput(window)
    image.ReadFrontBufferOff()
    image.Update()
    return image.GetOutput()


def main():
    if not options.picture.resolve().parent.is_dir():
        stop(f"there is no directory for {options.picture}")
    row = vtk.vtkImageAppend()
    for time in options.time or [None]:
        row.AddInputData(draw(chosen_file(time)))
    writer = vtk.vtkPNGWriter()
    writer.SetFileName(str(options.picture))
    writer.SetInputConnection(row.GetOutputPort())
    writer.Write()
    if writer.GetErrorCode() or not options.picture.is_file():
        stop(f"{options.picture} cannot be written")
    if options.small:
        Image.open(options.picture).convert("RGB").quantize(256, dither=0).save(options.picture, optimize=True)


if __name__ == "__main__":
    main()
