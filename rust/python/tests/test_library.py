"""The library is found, is of the right version, and is what _library.py says it is."""

import ctypes as c
import os
import re
import subprocess
import sys
import tempfile
import unittest
from pathlib import Path

import msdd
from msdd import _library

CHECKOUT = Path(__file__).resolve().parents[3]
HEADER = CHECKOUT / "rust/capi/include/msdd.h"


def importing(**environment: str) -> str:
    """What a new interpreter says when it imports msdd."""
    run = subprocess.run(
        [sys.executable, "-c", "import msdd; print(msdd.__version__)"],
        env={**os.environ, **environment},
        capture_output=True,
        text=True,
    )
    return run.stdout if run.returncode == 0 else run.stderr.splitlines()[-1]


def compiled(folder: str, text: str) -> str:
    """A shared library of a C source."""
    source, library = Path(folder) / "other.c", Path(folder) / "other.so"
    source.write_text(text)
    subprocess.run([os.environ.get("CC", "cc"), "-shared", "-fPIC", source, "-o", library], check=True)
    return str(library)


class Library(unittest.TestCase):
    def test_its_version_is_that_of_the_checkout(self) -> None:
        manifest = (CHECKOUT / "Cargo.toml").read_text()
        self.assertEqual(msdd.__version__, re.search(r'^version = "(.+)"', manifest, re.MULTILINE)[1])

    def test_it_is_the_one_that_the_environment_names(self) -> None:
        named = os.environ.get("MSDD_LIBRARY")
        if named:
            self.assertEqual(msdd.library_path, Path(named).resolve())
        self.assertIn("no library at /no/such.so", importing(MSDD_LIBRARY="/no/such.so"))

    def test_another_file_is_refused(self) -> None:
        self.assertIn("is not a libmsdd.so", importing(MSDD_LIBRARY=__file__))
        with tempfile.TemporaryDirectory() as folder:
            other = compiled(folder, "int something(void) { return 0; }\n")
            self.assertIn("is not a libmsdd.so", importing(MSDD_LIBRARY=other))

    def test_another_version_of_the_interface_is_refused(self) -> None:
        with tempfile.TemporaryDirectory() as folder:
            other = compiled(folder, "unsigned msdd_abi_version(void) { return 99; }\n")
            said = importing(MSDD_LIBRARY=other)
        self.assertIn("ImportError", said)
        self.assertIn(f"has version 99 of the C interface, this package needs {_library.ABI_VERSION}", said)


class Header(unittest.TestCase):
    """The header is the truth."""

    def setUp(self) -> None:
        text = re.sub(r"/\*.*?\*/", " ", interface(HEADER), flags=re.DOTALL)
        # Declarations of functions: what they return, their name, what they take.
        found = re.findall(r"^((?:const )?\w+ \*?)(msdd_\w+)\(([^()]*)\);", text, re.MULTILINE)
        self.functions = {name: (returns.strip(), takes) for returns, name, takes in found}

    def test_functions(self) -> None:
        self.assertEqual(set(self.functions), set(_library.SIGNATURES))
        for name, (returns, takes) in self.functions.items():
            result, arguments = _library.SIGNATURES[name]
            self.assertEqual(kind_of(returns), kind_of_ctypes(result), f"what {name} returns")
            declared = [] if takes == "void" else [kind_of(argument) for argument in takes.split(",")]
            self.assertEqual(declared, [kind_of_ctypes(argument) for argument in arguments], f"what {name} takes")

    def test_version_and_structs(self) -> None:
        lines = [f'#include "{HEADER}"', f'_Static_assert(MSDD_ABI_VERSION == {_library.ABI_VERSION}, "version");']
        structs = [getattr(_library, name) for name in dir(_library) if name.endswith("Struct")]
        # Those that callers fill or read, without the handles and what plug-ins get.
        declared = re.findall(r"^typedef struct (msdd_\w+) {", interface(HEADER), re.MULTILINE)
        wanted = {name for name in declared if not name.startswith("msdd_plugin")}
        columns = {"msdd_input", "msdd_output"}
        self.assertEqual({struct.__name__ for struct in structs} | columns, wanted)
        named = [(struct.__name__, struct) for struct in structs]
        for name, struct in named + [(name, _library.Column) for name in sorted(columns)]:
            lines.append(f'_Static_assert(sizeof({name}) == {c.sizeof(struct)}, "{name}");')
            for field, *_ in struct._fields_:
                place = getattr(struct, field)
                lines.append(f'_Static_assert(offsetof({name}, {field}) == {place.offset}, "{name}.{field}");')
                lines.append(f'_Static_assert(sizeof((({name} *)0)->{field}) == {place.size}, "{name}.{field}");')
        with tempfile.TemporaryDirectory() as folder:
            source = Path(folder) / "layout.c"
            source.write_text("\n".join(lines) + "\n")
            compiler = [os.environ.get("CC", "cc"), "-std=c11", "-fsyntax-only", source]
            run = subprocess.run(compiler, capture_output=True, text=True)
        self.assertEqual(run.returncode, 0, run.stderr)


def interface(header: Path) -> str:
    """The header without the inline functions of version 4."""
    return header.read_text().split("#ifndef MSDD_WITHOUT_V4\n\n")[0]


def kind_of(declaration: str) -> str:
    """pointer, or the name of a C type, of a declaration such as "const double *porosity"."""
    words = re.sub(r"\bconst\b", "", declaration).split()
    if "*" in declaration:
        return "pointer"
    # By value: a number, or the progress function.
    return "pointer" if words[0] == "msdd_progress" else words[0]


def kind_of_ctypes(kind: object) -> str:
    names = {None: "void", c.c_int32: "int32_t", c.c_uint32: "uint32_t", c.c_size_t: "size_t", c.c_double: "double"}
    return names.get(kind, "pointer")


if __name__ == "__main__":
    unittest.main()
