"""The same in Python: msdd.h by ctypes, numpy arrays passed as they are, without a copy.

    MSDD_LIBRARY=target/release/libmsdd.so python3 rust/capi/examples/advance.py [MODEL]
"""

import ctypes as c
import os
import sys

import numpy as np

Doubles = c.POINTER(c.c_double)


def struct(name, *fields):
    """A struct of the header: its size first; all else is 0 or NULL until set."""
    return type(name, (c.Structure,), {"_fields_": [("struct_size", c.c_size_t), *fields]})


def columns(*names):
    return [(name, Doubles) for name in names]


Material = struct("Material", *[(n, c.c_double) for n in ("thermal_conductivity", "young_modulus", "mean_radius")])
Initial = struct(
    "Initial",
    ("cells", c.c_size_t),
    *columns("porosity", "fabric_index", "fabric_conductivity", "stress_xx", "stress_yy"),
)
Batch = struct(
    "Batch",
    ("cells", c.c_size_t),
    ("state", c.POINTER(Doubles)),
    *columns("thermal_strain", "total_thermal_strain", "strain_xx", "strain_yy", "virgin_share"),
    ("next_state", c.POINTER(Doubles)),
    *columns("conductivity_xx", "conductivity_yy", "stress_xx", "stress_yy"),
    *columns("c11", "c22", "c12", "porosity_rate", "fabric_index_rate"),
    ("clamped", c.POINTER(c.c_uint8)),
    ("outside", c.POINTER(Doubles)),
    ("spread", Doubles),
    ("clamped_cells", c.c_size_t),
)

library = c.CDLL(os.environ.get("MSDD_LIBRARY", "target/release/libmsdd.so"))
library.msdd_last_error.restype = c.c_char_p
library.msdd_abi_version.restype = c.c_uint32
library.msdd_surrogate_state_size.restype = c.c_size_t
library.msdd_surrogate_state_size.argtypes = [c.c_void_p]
library.msdd_surrogate_free.argtypes = [c.c_void_p]
library.msdd_surrogate_free.restype = None


def check(status):
    if status != 0:
        sys.exit("advance: " + library.msdd_last_error().decode())


def column(array):
    """The array's own memory; numpy keeps it while the array lives."""
    assert array.dtype == np.float64 and array.flags.c_contiguous
    return array.ctypes.data_as(Doubles)


def table(array):
    """Pointers to the rows of a two-dimensional array."""
    return (Doubles * len(array))(*[column(row) for row in array])


def main():
    assert library.msdd_abi_version() == 2, "msdd.h of another version than this file"
    source = sys.argv[1].encode() if len(sys.argv) > 1 else None
    model = c.c_void_p()
    check(library.msdd_surrogate_load(source, c.byref(model)))
    material = Material(c.sizeof(Material), 100, 1e7, 5e-3)

    cells = 1000
    porosity, fabric_index = np.full(cells, 0.125), np.full(cells, 0.05)
    state = np.empty((library.msdd_surrogate_state_size(model), cells))
    initial = Initial(c.sizeof(Initial), cells, column(porosity), column(fabric_index))
    rows = table(state)
    check(library.msdd_surrogate_initial_state(model, c.byref(material), c.byref(initial), rows))

    strain, answers = np.full(cells, 0.01), np.empty((4, cells))
    batch = Batch(struct_size=c.sizeof(Batch), cells=cells, state=rows, next_state=rows)
    batch.thermal_strain = batch.total_thermal_strain = column(strain)
    for name, row in zip(("conductivity_xx", "conductivity_yy", "stress_xx", "stress_yy"), answers):
        setattr(batch, name, column(row))
    check(library.msdd_surrogate_advance(model, c.byref(material), c.byref(batch)))
    assert np.ptp(answers, axis=1).max() == 0, "equal cells, equal answers"

    kxx, kyy, sxx, syy = answers[:, -1]
    print(f"porosity {state[0, -1]:.5f}, K {kxx:.3f} {kyy:.3f} W/(m K), pressure {(sxx + syy) / 2:.1f} Pa")
    library.msdd_surrogate_free(model)


main()
