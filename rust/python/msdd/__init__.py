"""MSDD: multiscale data-driven simulation of heat conduction with thermal expansion in granular media.

    import msdd
    model = msdd.load_model()                                     # model of boxes of discs
    glass = msdd.Material(thermal_conductivity=1.0, young_modulus=70e9, mean_radius=1e-3)
    state = model.initial_state(glass, porosity=[0.12, 0.14])     # arrays of any shape
    step = model.advance(glass, state, thermal_strain=0.01)       # step.conductivity_xx, step.stress_xx, ...

    steel = msdd.SphereMaterial(diameter=6e-3, young_modulus=2e11, poisson_ratio=0.3, conductivity=40, gas="air")
    bed = msdd.load_model("builtin:spheres")                      # packings of spheres with gas
    step = bed.advance(steel, bed.initial_state(steel, porosity=0.4, stress=1e4), thermal_strain=1e-4)

    box = msdd.pack(discs=500, porosity=0.13)                     # DEM
    box.strain(thermal=0.01)
    box.average().conductivity_network_xx

    msdd.read_database("cases/database/periodic.csv.gz")          # a pandas data frame
    msdd.read_probes("cases/H"), msdd.read_field("cases/H", 20, "porosity")

SI units. Strain: extension and growth positive. Stress: compression positive, but OpenFOAM's field "stress".
Failures are exceptions derived from `MsddError`.
"""

from ._case import Probes, read_field, read_probes, read_summary, read_table, time_folders
from ._database import export_database, generate_database, read_database
from ._errors import (
    CaseError,
    FileError,
    InternalError,
    InvalidArgument,
    ModelError,
    MsddError,
    NonFinite,
    PluginError,
    RveError,
)
from ._library import library_path
from ._library import version as __version__
from ._material import Material, SphereMaterial, SphereWall, wall_resistance
from ._mesh import Mesh, read_mesh
from ._model import Model, Step, WallFriction, load_model
from ._rve import Averages, Contacts, Grains, Rve, pack
from ._training import train

__all__ = [
    "Averages",
    "CaseError",
    "Contacts",
    "FileError",
    "Grains",
    "InternalError",
    "InvalidArgument",
    "Material",
    "Mesh",
    "Model",
    "ModelError",
    "MsddError",
    "NonFinite",
    "PluginError",
    "Probes",
    "Rve",
    "RveError",
    "SphereMaterial",
    "SphereWall",
    "Step",
    "WallFriction",
    "__version__",
    "export_database",
    "generate_database",
    "library_path",
    "load_model",
    "pack",
    "read_database",
    "read_field",
    "read_mesh",
    "read_probes",
    "read_summary",
    "read_table",
    "time_folders",
    "train",
    "wall_resistance",
]


def __dir__() -> list[str]:
    return __all__
