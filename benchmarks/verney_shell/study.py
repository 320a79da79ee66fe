"""Verney's shell: final radius for stated velocities, in one to three dimensions. See README.md."""
import sys
from pathlib import Path
sys.path.insert(0, str(Path(__file__).resolve().parents[1]))
import common, profiles
import numpy
from reference import BERYLLIUM

study = common.Study(__file__)
ELEMENTS = {"one point": {"Element/Type": "one-point hexahedron"},
            "mean dilatation": {"Element/Type": "hexahedron", "Element/Volumetric strain": "mean dilatation"},
            "pointwise": {"Element/Type": "hexahedron", "Element/Volumetric strain": "pointwise"}}
FORMS = {"radius": ({"Dimension": 1, "Symmetry": "spherical"}, "x", 1), "meridian plane": ({"Dimension": 2, "Symmetry": "axisymmetric"}, "sqrt(x^2+y^2)", 2),
         "octant": ({"Dimension": 3, "Symmetry": "none"}, "sqrt(x^2+y^2+z^2)", 3)}
WINDOW = 1.2e-4, 1.5e-4  # mean over the ringing [s]


def measure(element, form, layers, ri, refinement=0, stiffer=1.):
    """The final radius is the mean over the last fifth of the run."""
    settings, radius, dim = FORMS[form]
    u0 = BERYLLIUM.velocity(ri)
    velocity = "; ".join(f"-{u0:.9g}*{BERYLLIUM.Ri ** 2:.9g}*{x}/{radius}^3" for x in "xyz"[:dim])
    run = study.run("shell.prm", {**ELEMENTS[element], **settings, "Mesh/Radial layers": layers, "Mesh/Refinement": refinement,
                                  "Materials/metal/Bulk modulus": 160e9 * stiffer, "Materials/metal/Shear modulus": 150e9 * stiffer,
                                  "Initial conditions/metal/Velocity": velocity}, repeat=1)
    table = run.table("receivers-surfaces.csv")
    late = numpy.array(table["t [s]"]) > WINDOW[0]
    letter = "x" if dim == 3 else "r"
    inner = BERYLLIUM.Ri + numpy.array(table[f"p1.displacement_{letter} [m]"])[late].mean()
    outer = BERYLLIUM.Ro + numpy.array(table[f"p2.displacement_{letter} [m]"])[late].mean()
    return study.add(f"{form}, {element}" + (", 3-D" if dim == 3 else "") + (f", {stiffer:g} times stiffer" if stiffer != 1 else ""), run, abs(inner / ri - 1), layers=layers,
                     refinement=refinement, target=ri, ri=inner, ro=profiles.relative(outer, BERYLLIUM.outer(ri)), energy_error=run["energy_error"])


for element in ELEMENTS:
    for ri in study.choose((.05, .04, .03), quick=(.05,)):
        for layers in study.choose((25, 50, 100, 200), quick=(25, 50)):
            measure(element, "radius", layers, ri)
measure("one point", "radius", study.choose((100,), quick=(25,))[0], .05, stiffer=10)
for element in ELEMENTS:
    for form in FORMS:  # the radius again, on as few layers
        for refinement in study.choose((1, 2, 3), quick=(1,)):
            measure(element, form, 3, .05, refinement)
study.finish("Final inner radius of the shell, mean over 120 to 150 us. The stiffer solid is closer to the incompressible one of the closed form.",
             ylabel="relative error of the final radius")
