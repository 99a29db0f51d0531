"""Results of cases: files as OpenFOAM writes them, restarts, and files that are cut short or are something else."""

import json
import os
import random
import tempfile
import unittest
from pathlib import Path

import numpy as np
from foam_files import head, store, two_cells, write_field, write_mesh

import msdd

PROBES = """# Probe 0 (0.25 0.5 1)
# Probe 1 (1e-3 -2 3)
#       Probe                        0                        1
#        Time
"""


class WithCase(unittest.TestCase):
    def setUp(self) -> None:
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.case = Path(folder.name)

    def refused(self, pattern: str, *call: object) -> None:
        with self.assertRaisesRegex(msdd.CaseError, pattern):
            call[0](*call[1:])


class Fields(WithCase):
    def test_all_kinds_and_formats(self) -> None:
        random_numbers = np.random.default_rng(1)
        for cells in (0, 1, 3, 10, 11, 200):
            for shape in ((cells,), (cells, 3), (cells, 6), (cells, 9)):
                values = random_numbers.normal(size=shape) * 10.0 ** random_numbers.integers(-300, 300, shape)
                for binary in (False, True):
                    for compressed in (False, True):
                        folder = self.case / f"{cells}.{len(shape)}{binary:d}{compressed:d}{shape[-1]}"
                        write_field(folder / "T", values, binary, compressed)
                        found = msdd.read_field(self.case, folder.name)
                        np.testing.assert_array_equal(found, values, f"{shape} {binary} {compressed}")
                        self.assertEqual(found.dtype, np.float64)

    def test_uniform_fields_fill_the_mesh(self) -> None:
        T = self.case / "0/T"
        store(T, head(T, "volScalarField") + b"internalField   uniform 50;\nboundaryField {}\n")
        U = self.case / "0/U"
        store(U, head(U, "volVectorField") + b"internalField uniform (1 2e-3 -3);\nboundaryField {}\n")
        self.refused("polyMesh/owner", msdd.read_field, self.case, 0)
        write_mesh(self.case, *two_cells())
        np.testing.assert_array_equal(msdd.read_field(self.case, 0), [50, 50])
        np.testing.assert_array_equal(msdd.read_field(self.case, "0", "U"), [[1, 2e-3, -3]] * 2)
        store(T, head(T, "volScalarField") + b"internalField nonuniform List<scalar> 4{7.5};\n")
        np.testing.assert_array_equal(msdd.read_field(self.case, 0), [7.5] * 4)

    def test_times(self) -> None:
        for name in ("0", "0.5", "10", "1e-05", "2", "constant", "system", "0.orig", "processor0"):
            (self.case / name).mkdir()
        self.assertEqual(msdd.time_folders(self.case), ["0", "1e-05", "0.5", "2", "10"])
        for name in ("0.5", "10"):
            write_field(self.case / name / "T", np.array([float(name)]))
        for time, expected in ((0.5, 0.5), ("0.50", 0.5), ("latest", 10), (10, 10), (np.float64(10), 10)):
            self.assertEqual(msdd.read_field(self.case, time)[0], expected)
        self.refused(r"no time 3; there are 0, 1e-05", msdd.read_field, self.case, 3)
        self.refused(r"no time soon", msdd.read_field, self.case, "soon")
        self.refused(r"2/T: ", msdd.read_field, self.case, 2)
        self.refused(r"no folder of a time", msdd.read_field, self.case / "system")
        self.refused(r"/no/such", msdd.time_folders, "/no/such")

    def test_files_that_are_damaged(self) -> None:
        T = self.case / "1/T"
        for text in ("", "no field", "internalField nonuniform List<word> 1(a);", "internalField uniform a;",
                     "internalField nonuniform List<scalar> 3(1 2);", "internalField nonuniform List<scalar> 2(1 b);",
                     "internalField nonuniform List<vector> 2((1 2 3) (4 5));", '#include "other"'):  # fmt: skip
            store(T, head(T, "volScalarField") + text.encode())
            self.refused("1/T", msdd.read_field, self.case)
        # Cut anywhere: read right or refused, and nothing else.
        chance = random.Random(1)
        for binary in (False, True):
            values = np.arange(60.0).reshape(20, 3)
            write_field(T, values, binary)
            whole = T.read_bytes()
            for _ in range(300):
                store(T, whole[: chance.randrange(len(whole))])
                try:
                    np.testing.assert_array_equal(msdd.read_field(self.case), values)
                except msdd.CaseError:
                    pass
        (self.case / "1/K.gz").write_bytes(b"\x1f\x8bnot gzip")
        self.refused("1/K", msdd.read_field, self.case, 1, "K")


class Meshes(WithCase):
    def test_centres_and_volumes(self) -> None:
        for binary in (False, True):
            write_mesh(self.case, *two_cells(), binary)
            mesh = msdd.read_mesh(self.case)
            np.testing.assert_allclose(mesh.volumes, [1, 1], rtol=1e-14)
            # Centroid of a triangle is the mean of its corners.
            np.testing.assert_allclose(mesh.centres, [[0.5, 0.5, 0.5], [5 / 3, 1 / 3, 0.5]], rtol=1e-14)

    def test_a_frustum(self) -> None:
        # Of a square pyramid, 2 wide at the bottom, 1 at the top, 1 high: its sides are trapezoids, and their centres are
        # not the means of their corners.
        points = [[x, y, 0] for y in (0, 2) for x in (0, 2)] + [[x, y, 1] for y in (0.5, 1.5) for x in (0.5, 1.5)]
        faces = [[0, 2, 3, 1], [4, 5, 7, 6], [0, 1, 5, 4], [2, 6, 7, 3], [0, 4, 6, 2], [1, 3, 7, 5]]
        write_mesh(self.case, np.array(points, np.float64), faces, [0] * 6, [])
        mesh = msdd.read_mesh(self.case)
        np.testing.assert_allclose(mesh.volumes, [7 / 3], rtol=1e-14)
        np.testing.assert_allclose(mesh.centres, [[1, 1, 11 / 28]], rtol=1e-14)

    def test_meshes_that_are_none(self) -> None:
        self.refused("points", msdd.read_mesh, self.case)
        points, faces, owner, neighbour = two_cells()
        for wrong in (
            (points[:5], faces, owner, neighbour),
            (points, faces[:-1], owner, neighbour),
            (points, faces, owner, [-1]),
            (points[:, [1, 0, 2]], faces, owner, neighbour),  # inside out
        ):
            write_mesh(self.case, *wrong)
            self.refused("polyMesh", msdd.read_mesh, self.case)


class Outputs(WithCase):
    def test_summary(self) -> None:
        self.refused("summary.json", msdd.read_summary, self.case)
        file = self.case / "postProcessing/msddFoam/summary.json"
        store(file, json.dumps({"steps": 20, "final": {"porosity": 0.1}}).encode())
        self.assertEqual(msdd.read_summary(self.case), msdd.read_summary(str(file)))
        self.assertEqual(msdd.read_summary(self.case)["final"]["porosity"], 0.1)
        for text in (b"", b"{", b"[1]", b"\xff"):
            store(file, text)
            self.refused("summary.json", msdd.read_summary, self.case)

    def test_probes_of_a_restarted_run(self) -> None:
        folder = self.case / "postProcessing/probes"
        store(folder / "0/T", (PROBES + "  0.5  1 2\n  1  3 4\n  1.5  5 6\n").encode())
        store(folder / "1/T", (PROBES + "  1.25  7 8\n  2  9 10\n").encode())
        probes = msdd.read_probes(self.case)
        np.testing.assert_array_equal(probes.times, [0.5, 1, 1.25, 2])
        np.testing.assert_array_equal(probes.values, [[1, 2], [3, 4], [7, 8], [9, 10]])
        np.testing.assert_array_equal(probes.positions, [[0.25, 0.5, 1], [1e-3, -2, 3]])
        store(folder / "0/U", (PROBES + "  0.5  (1 2 3) (4 5 6)\n").encode())
        np.testing.assert_array_equal(msdd.read_probes(self.case, "U").values, [[[1, 2, 3], [4, 5, 6]]])
        store(folder / "0/p", PROBES.encode())
        self.assertEqual(msdd.read_probes(self.case, "p").values.shape, (0, 2))
        store(folder / "1/U", (PROBES + "  1.5  1 4\n").encode())
        self.refused("other points or columns", msdd.read_probes, self.case, "U")
        self.refused("no q in it", msdd.read_probes, self.case, "q")
        self.refused("no T in it", msdd.read_probes, self.case, "T", "others")
        for rows in ("0.5 1\n", "0.5 1 2\n1 2\n", "0.5 a 2\n"):
            store(folder / "0/T", (PROBES + rows).encode())
            self.refused("0/T", msdd.read_probes, self.case)

    def test_tables(self) -> None:
        file = self.case / "postProcessing/massAudit/0/massAudit.dat"
        store(file, b"# Something else\n# Time mass relative_change\n0.05\t3.5\t0\n0.1\t3.5\t1e-17\n")
        store(file.parents[1] / "0.05/massAudit.dat", b"# Time mass relative_change\n0.075\t4\t0\n")
        table = msdd.read_table(self.case, "massAudit")
        self.assertEqual(list(table), ["Time", "mass", "relative_change"])
        np.testing.assert_array_equal(table["Time"], [0.05, 0.075])
        np.testing.assert_array_equal(table["mass"], [3.5, 4])
        store(file.parents[1] / "0.05/massAudit.dat", b"# Time other\n0.075\t4\n")
        self.refused("other points or columns", msdd.read_table, self.case, "massAudit")
        (file.parents[1] / "0.05/massAudit.dat").unlink()
        store(file, b"0.05 3.5\n")
        self.refused("names of columns", msdd.read_table, self.case, "massAudit")

    def test_tables_of_function_objects_with_a_name_of_their_own(self) -> None:
        folder = self.case / "postProcessing/sp"
        self.refused("no table in it", msdd.read_table, self.case, "sp")
        store(folder / "0/spaceProbes.dat", b"# Time T_0\n0.5\t300\n1\t301\n")
        store(folder / "0/spaceProbes_0.dat", b"# Time T_0\n0.5\t7\n")
        store(folder / "1/spaceProbes.dat", b"# Time T_0\n1.5\t302\n")
        table = msdd.read_table(self.case, "sp")
        self.assertEqual(list(table), ["Time", "T_0"])
        # Of the two files of the first start that which was written last.
        np.testing.assert_array_equal(table["Time"], [0.5, 1.5])
        np.testing.assert_array_equal(table["T_0"], [7, 302])
        store(folder / "0/other.dat", b"# Time T_0\n0.5\t300\n")
        self.refused("several tables: other.dat, spaceProbes.dat", msdd.read_table, self.case, "sp")


    def test_the_list_of_the_solver_says_which_files_belong_to_the_run(self) -> None:
        folder = self.case / "postProcessing/p"
        store(folder / "0/p.dat", b"# Time a\n0 1\n1 1\n")
        store(folder / "0/p_0.dat", b"# Time a\n0 5\n0.5 5\n0.6 5\n")
        store(folder / "0.5/p.dat", b"# Time a\n0.6 7\n")
        store(folder / "0.5/p_0.5.dat", b"# note\n# Time a\n0.6 8\n0.7 8\n")
        store(folder / "1/p.dat", b"# Time a\n0.5 9\n")  # by postProcess
        listed = self.case / "postProcessing/msddFoam/tables.json"
        runs = [{"start": 0, "files": ["p/0/p_0.dat"]}, {"start": 0.5, "files": ["p/0.5/p_0.5.dat"]}]
        store(listed, json.dumps({"schema": "msdd-tables-1", "runs": runs}).encode())
        table = msdd.read_table(self.case, "p")
        np.testing.assert_array_equal(table["Time"], [0, 0.5, 0.6, 0.7])
        np.testing.assert_array_equal(table["a"], [5, 5, 8, 8])
        store(self.case / "postProcessing/q/bed/0/T", (PROBES + "  0.5  1 2\n").encode())
        np.testing.assert_array_equal(msdd.read_probes(self.case, "T", "q", region="bed").values, [[1, 2]])
        store(self.case / "postProcessing/bed/r/0/r.dat", b"# Time a\n1 2\n")
        np.testing.assert_array_equal(msdd.read_table(self.case, "r", region="bed")["a"], [2])
        for text in (b"{", b'{"schema": "other", "runs": []}', b'{"schema": "msdd-tables-1", "runs": [{}]}'):
            store(listed, text)
            self.refused("tables.json", msdd.read_table, self.case, "p")

    def test_without_a_list_the_newest_file_of_each_start_counts(self) -> None:
        folder = self.case / "postProcessing/p"
        store(folder / "10/p.dat", b"# Time a\n10 3\n11 3\n")
        store(folder / "2/p_2.dat", b"# Time a\n2 1\n3 1\n12 1\n")
        store(folder / "2/p.dat", b"# Time a\n2 0\n")
        os.utime(folder / "2/p.dat", (0, 0))
        np.testing.assert_array_equal(msdd.read_table(self.case, "p")["Time"], [2, 3, 10, 11])
        np.testing.assert_array_equal(msdd.read_table(self.case, "p")["a"], [1, 1, 3, 3])


class Regions(WithCase):
    def test_fields_and_meshes_of_regions(self) -> None:
        points, faces, owner, neighbour = two_cells()
        write_mesh(self.case, points, faces, owner, neighbour)
        (self.case / "constant/bed").mkdir()
        (self.case / "constant/polyMesh").rename(self.case / "constant/bed/polyMesh")
        p = self.case / "0/bed/p"
        store(p, head(p, "volScalarField") + b"internalField   uniform 50;\n")
        write_field(self.case / "0/bed/T", np.array([1.0, 2.0]))
        for field, region in (("p", "bed"), ("bed/p", None)):
            np.testing.assert_array_equal(msdd.read_field(self.case, "latest", field, region), [50, 50])
        np.testing.assert_array_equal(msdd.read_field(self.case, region="bed"), [1, 2])
        np.testing.assert_allclose(msdd.read_mesh(self.case, region="bed").volumes, [1, 1], rtol=1e-14)
        for call in (lambda: msdd.read_field(self.case), lambda: msdd.read_mesh(self.case),
                     lambda: msdd.read_field(self.case, region="wall"), lambda: msdd.read_mesh(self.case, "wall")):  # fmt: skip
            self.refused("regions of the case, to be named by region=: bed", call)

    def test_latest_passes_over_what_function_objects_left(self) -> None:
        write_field(self.case / "8/T", np.array([3.0]))
        store(self.case / "8.35/uniform/functionObjects/functionObjectProperties", b"")
        np.testing.assert_array_equal(msdd.read_field(self.case), [3])

    def test_a_macro_is_named(self) -> None:
        T = self.case / "1/T"
        for text in (b"internalField uniform $T0;", b"internalField $T0;", b"internalField nonuniform List<scalar> 2(1 $T0);"):
            store(T, head(T, "volScalarField") + b"T0 300;\n" + text)
            self.refused(r"1/T: \$T0.* is a macro.*foamDictionary -expand", msdd.read_field, self.case)


if __name__ == "__main__":
    unittest.main()
