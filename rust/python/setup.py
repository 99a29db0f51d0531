"""Puts libmsdd.so of this checkout into the package, after a look at its version; builds it if it is not there."""

import ctypes
import os
import re
import shutil
import subprocess
import sys
import sysconfig
from pathlib import Path

from setuptools import Distribution, setup
from setuptools.command.build_py import build_py

try:  # moved from wheel into setuptools
    from setuptools.command.bdist_wheel import bdist_wheel
except ImportError:
    from wheel.bdist_wheel import bdist_wheel

CHECKOUT = Path(__file__).resolve().parents[2]
MANIFEST = CHECKOUT / "Cargo.toml"
if not MANIFEST.is_file():
    sys.exit("msdd: the package is built in a checkout: pip install ./rust/python")
VERSION = re.search(r'^version = "(.+)"$', MANIFEST.read_text(encoding="utf-8"), re.MULTILINE)[1]


def library():
    """The library of this checkout and version."""
    target = CHECKOUT / os.environ.get("CARGO_TARGET_DIR", "target")
    path = Path(os.environ.get("MSDD_LIBRARY") or target / "release/libmsdd.so")
    if not path.is_file():
        subprocess.run(["cargo", "build", "--release", "--package", "msdd-capi"], cwd=CHECKOUT, check=True)
    found = ctypes.CDLL(str(path.resolve()))
    found.msdd_version.restype = ctypes.c_char_p
    if found.msdd_version().decode() != VERSION:
        sys.exit(f"msdd: {path} has version {found.msdd_version().decode()}, the checkout {VERSION}: cargo build --release")
    return path


class BuildWithLibrary(build_py):
    def run(self):
        super().run()
        shutil.copyfile(library(), Path(self.build_lib) / "msdd/libmsdd.so")


class WheelOfAnyPython(bdist_wheel):
    """The library is for one platform, and does not know Python."""

    def get_tag(self):
        return "py3", "none", re.sub(r"[^0-9a-zA-Z]", "_", sysconfig.get_platform())


class WithLibrary(Distribution):
    def has_ext_modules(self):
        return True


setup(
    version=VERSION,
    distclass=WithLibrary,
    cmdclass={"build_py": BuildWithLibrary, "bdist_wheel": WheelOfAnyPython},
)
