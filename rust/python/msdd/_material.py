"""Grains, the gas between them, and walls."""

from __future__ import annotations

import ctypes as c
from dataclasses import dataclass
from typing import Any, Union

import numpy as np
from numpy.typing import ArrayLike

from ._columns import Array, address, aligned, count
from ._library import GrainsStruct, SphereWallStruct, check, encoded, library


@dataclass(frozen=True)
class Material:
    """Discs: what turns a model's dimensionless answers into SI units."""

    thermal_conductivity: float
    """k of the grains [W/(m K)], 1e-12 to 1e12"""
    young_modulus: float
    """E of the grains [Pa], 1e-9 to 1e15"""
    mean_radius: float
    """mean radius of the grains in the initial state [m], 1e-12 to 1e6"""

    def _struct(self) -> c.Structure:
        values = (self.thermal_conductivity, self.young_modulus, self.mean_radius)
        return GrainsStruct(c.sizeof(GrainsStruct), *map(float, values))


@dataclass(frozen=True)
class SphereMaterial:
    """Spheres and the gas between them."""

    diameter: float
    """of unequal spheres the Sauter mean, sum d^3/sum d^2 [m], 1e-9 to 1e3"""
    young_modulus: float
    """E of the spheres [Pa], 1e-9 to 1e15"""
    poisson_ratio: float
    """of the spheres, -0.99 to 0.5"""
    conductivity: float
    """k_s of the spheres [W/(m K)], 1e-12 to 1e12"""
    roughness: float = 0.0
    """height of the asperities (root mean square) over their slope [m], 0 to 1; 0: smooth"""
    hardness: float = 1e9
    """of the rough surface [Pa], 1 to 1e15; not used when smooth"""
    gas: str = "vacuum"
    """"air", "nitrogen", "helium", "argon" or "vacuum\""""
    gas_pressure: float = 101325.0
    """pressure of the gas [Pa], 1e-3 to 1e9; not used in a vacuum"""
    accommodation: float = 0.9
    """accommodation coefficient of the gas at the spheres, 0.01 to 1; not used in a vacuum"""
    emissivity: float = 0.0
    """of the spheres, opaque, grey and diffuse, 0 to 1; 0: without radiation"""
    size_spread: float = 0.0
    """standard deviation of the diameters over their mean, both weighted by surface, 0 to 0.25; 0: equal spheres"""

    def _struct(self) -> c.Structure:
        return GrainsStruct(
            c.sizeof(GrainsStruct),
            *map(float, (self.conductivity, self.young_modulus, 0.5 * float(self.diameter))),
            *map(float, (self.poisson_ratio, self.roughness, self.hardness)),
            encoded("gas", self.gas),
            *map(float, (self.gas_pressure, self.accommodation, self.emissivity, self.size_spread)),
        )


@dataclass(frozen=True)
class SphereWall:
    """The surface of a wall next to a bed of spheres."""

    conductivity: float
    """of the wall [W/(m K)], 1e-12 to 1e12"""
    young_modulus: float
    """of the wall [Pa], 1e-9 to 1e15"""
    poisson_ratio: float
    """of the wall, -0.99 to 0.5"""
    roughness: float = 0.0
    """of sphere and wall together: height of the asperities (root mean square) over their slope [m], 0 to 1; 0: smooth"""
    hardness: float = 1e9
    """of the softer of both [Pa], 1 to 1e15; not used when smooth"""
    spheres: float = 0.87
    """spheres at the wall on the square of a diameter, 0.01 to 1.16"""
    emissivity: float = 0.0
    """of the wall, 0 to 1; it exchanges radiation with spheres whose emissivity is above 0"""

    def _struct(self) -> c.Structure:
        return SphereWallStruct(
            c.sizeof(SphereWallStruct),
            *map(float, (self.conductivity, self.young_modulus, self.poisson_ratio)),
            *map(float, (self.roughness, self.hardness, self.spheres, self.emissivity)),
        )


AnyMaterial = Union[Material, SphereMaterial]


def scales(material: AnyMaterial, kind: type) -> Any:
    """The struct of a material of the kind that a model needs."""
    if not isinstance(material, kind):
        raise TypeError(f"material is a msdd.{kind.__name__}, not {type(material).__name__}")
    return c.byref(material._struct())


def wall_resistance(
    material: SphereMaterial,
    wall: SphereWall,
    stress: ArrayLike,
    conductivity: ArrayLike,
    temperature: ArrayLike = 293.15,
) -> Array:
    """What a wall adds to the resistance of a bed that has one conductivity up to its surface [m2 K/W], 0 to 1e9. Arrays of any
    shapes that broadcast to one; the answer has that shape.

    Parameters
    ----------
    material
        spheres and gas
    wall
        the surface of the wall
    stress
        normal to the wall [Pa], compression positive; where it is 0 or less, gas alone conducts
    conductivity
        of the bed across the wall [W/(m K)], 0 and above
    temperature
        of the gas [K], 0 to 1e5

    Raises
    ------
    InvalidArgument
        for a value out of range,
    NonFinite
        for NaN and infinity.
    """
    if not isinstance(wall, SphereWall):
        raise TypeError(f"wall is a msdd.SphereWall, not {type(wall).__name__}")
    shape, columns = aligned({"stress": stress, "temperature": temperature, "conductivity": conductivity}, {})
    found = np.empty(shape)
    given = [address(column) for column in columns.values()]
    surface = c.byref(wall._struct())
    check(library.msdd_wall_resistance(scales(material, SphereMaterial), surface, count(shape), *given, address(found)))
    return found
