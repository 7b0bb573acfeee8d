# SPDX-License-Identifier: BSD-3-Clause
"""Every error's text and exit code, and that nothing is written or overwritten by a run that fails."""
import os
import unittest

import program
from program import ARGUMENTS, FILES, PROCESSING, ProgramTest


class Errors(ProgramTest):
    SHAPE = "sphere"

    def fails(self, code, words, capture, *arguments):
        """A reconstruction that fails, over an old mesh that stays."""
        place = self.folder / "place"
        place.mkdir(exist_ok=True)
        mesh = place / "x.ply"
        mesh.write_text("old")
        self.bad(code, words, "reconstruct", capture, "-o", mesh, "--metrics", place / "x.json", "--depth", 4,
                 *arguments)
        self.assertEqual(mesh.read_text(), "old")
        self.assertEqual(sorted(os.listdir(place)), ["x.ply"])

    def edit_matrix(self, capture, row):
        """Replace the first view's 12 numbers."""
        file = capture / "projections.txt"
        lines = file.read_text().splitlines()
        lines[0] = lines[0].split()[0] + " " + row
        file.write_text("\n".join(lines) + "\n")

    def test_missing_capture(self):
        self.fails(FILES, ["nowhere", "no such folder or camera file"], self.folder / "nowhere")
        self.fails(FILES, ["empty", "projections.txt"], self.make("empty"))

    def make(self, name):
        folder = self.folder / name
        folder.mkdir()
        return folder

    def test_unreadable_image(self):
        capture = self.copy_of_capture()
        (capture / "masks" / "view_003.png").write_bytes(b"\x89PNG\r\n\x1a\nnothing")
        self.fails(FILES, ["cannot read image", "view_003.png"], capture)

    def test_little_memory(self):
        """However little there is, and whichever thread asks for more, an error says so; but where the C library itself gives up."""
        mesh = self.folder / "x.ply"

        def reconstruct(depth, memory_mib):
            return program.run("reconstruct", self.capture, "-o", mesh, "--depth", depth, "--threads", 2,
                               memory_mib=memory_mib, environment={"VTK_SMP_BACKEND_IN_USE": "STDThread"})

        enough = next(size for size in range(200, 3000, 20) if reconstruct(3, size).returncode == program.OK)
        mesh.write_text("old")
        codes = []
        for size in range(enough + 20, enough + 300, 20):
            done = reconstruct(8, size)
            codes.append(done.returncode)
            self.assertNotIn("bad_alloc", done.stderr)
            if "glibc" not in done.stderr:
                self.assertIn(done.returncode, (program.OK, PROCESSING), f"{size} MiB: {done.stderr}")
            if done.returncode == PROCESSING:
                self.assertIn("not enough memory", done.stderr)
                self.assertEqual(mesh.read_text(), "old")
        self.assertIn(PROCESSING, codes)

    def refuses(self, words, kept, *arguments):
        """Wrong arguments, which leave a file as it is."""
        before = kept.read_bytes()
        self.bad(program.ARGUMENTS, words, *arguments)
        self.assertEqual(kept.read_bytes(), before)

    def test_outputs_that_are_inputs(self):
        capture = self.copy_of_capture()
        truth, cameras, mask = capture / "truth.ply", capture / "projections.txt", capture / "masks" / "view_003.png"
        link = self.folder / "link.png"
        link.symlink_to(mask)
        mesh = self.folder / "x.ply"
        place = ["take the place of the input"]
        self.refuses(place, truth, "reconstruct", capture, "-o", truth, "--truth", truth)
        self.refuses(place, mask, "reconstruct", capture, "-o", mesh, "--image", mask)
        self.refuses(place, mask, "reconstruct", capture, "-o", mesh, "--image", link)
        self.refuses(place, mask, "reconstruct", cameras, "-o", mesh, "--image", capture / "." / "masks" / mask.name)
        self.refuses(place, mask, "reconstruct", capture, "--views", "0-2", "-o", mesh, "--image", mask)
        for folder in ("images", "masks"): # a view that is not used may lack its files
            (capture / folder / "view_005.png").unlink()
        self.refuses(place, mask, "reconstruct", capture, "--views", "0-2", "-o", mesh, "--image", mask)
        json = self.folder / "x.json"
        os.link(cameras, json)
        self.refuses(place, cameras, "reconstruct", capture, "-o", mesh, "--metrics", json)
        self.refuses(place, cameras, "evaluate", truth, "--capture", capture, "--metrics", json)
        self.assertFalse(mesh.exists())

    def test_outputs_that_are_one(self):
        (self.folder / "out").mkdir()
        mesh, again = self.folder / "x.ply", self.folder / "out" / ".." / "x.ply"
        mesh.write_text("old")
        other = self.folder / "x.png"
        other.symlink_to(mesh)
        for option, file in (("--image", other), ("--octree", again.with_suffix(".htg"))):
            (self.folder / "x.htg").unlink(missing_ok=True)
            os.link(mesh, self.folder / "x.htg")
            self.refuses(["two outputs are one file"], mesh, "reconstruct", self.capture, "-o", mesh, option, file)

    def test_extensions(self):
        for option, file, extension in (("--image", "x.jpg", ".png"), ("--octree", "x.vtp", ".htg"), ("--metrics", "x.png", ".json")):
            self.bad(program.ARGUMENTS, [option, file, "does not end in " + extension], "reconstruct", self.capture, "-o",
                     self.folder / "x.ply", option, self.folder / file)
        self.assertEqual(os.listdir(self.folder), [])

    def test_broken_meshes(self):
        """However a mesh file is cut or lies, it is refused by name."""
        truth = self.capture / "truth.ply"
        whole = truth.read_bytes()
        end = whole.index(b"end_header\n") + len(b"end_header\n")
        header = whole[:end].decode()

        def refused(name, content, *words):
            file = self.folder / name
            file.write_bytes(content)
            self.bad(FILES, ["cannot read mesh", name, *words], "evaluate", file, "--capture", self.capture)

        for length in (0, 10, 60, end - 1, end, end + 100, end + 3000, len(whole) // 2, len(whole) - 1):
            refused("cut.ply", whole[:length])
        points = next(line for line in header.splitlines() if line.startswith("element vertex"))
        faces = next(line for line in header.splitlines() if line.startswith("element face"))
        for line, name in ((points, "vertex"), (faces, "face")):
            for count in ("99999999", "-5", "4294967296", "many"):
                refused("lie.ply", header.replace(line, f"element {name} {count}").encode() + whole[end:])
        text = "ply\nformat ascii 1.0\nelement vertex 4\nproperty float x\nproperty float y\nproperty float z\n" \
               "element face 4\nproperty list uchar int vertex_indices\nend_header\n"
        corners = "0 0 0\n1 0 0\n0 1 0\n0 0 1\n"
        triangles = "3 0 2 1\n3 0 1 3\n3 0 3 2\n3 1 2 3\n"
        (self.folder / "good.ply").write_text(text + corners + triangles)
        self.good("evaluate", self.folder / "good.ply", "--capture", self.capture)
        refused("text.ply", (text + corners + triangles[:-8]).encode(), "ends too soon, within face 3 of 4")
        refused("text.ply", (text + corners + triangles.replace("3 1 2 3", "3 1 2 7")).encode(), "face 3 of 4 names point 7, there are 4")
        refused("text.ply", (text + corners.replace("0 0 1", "0 0 nan") + triangles).encode(), "point 3 is not finite")
        for face in ("4 0 1 2 1000000000", "3 0 1 -1", "3 0 1 1.5e300", "3 0 1 x"):
            refused("text.ply", (text + corners + triangles.replace("3 1 2 3", face)).encode(), "face 3")
        refused("text.ply", (text.replace("vertex_indices", "corners") + corners + triangles).encode(), "no list vertex_indices")
        refused("text.ply", (text.replace("list uchar int", "int") + corners + triangles).encode(), "no list vertex_indices")
        refused("text.ply", (text.replace("property float y\n", "") + corners + triangles).encode(), "points have no y")
        refused("text.ply", (text.replace("list uchar", "list char") + corners + triangles.replace("3 1 2 3", "-3 1 2 3")).encode(),
                "a list of -3 values")
        refused("text.ply", (text.replace("uchar int", "uchar integer") + corners + triangles).encode(), "uchar integer")
        stl = self.folder / "x.stl"
        self.good("reconstruct", self.capture, "-o", stl, "--depth", 4)
        whole = stl.read_bytes()
        for length in (0, 50, 83, 500, len(whole) // 2, len(whole) - 1):
            refused("cut.stl", whole[:length], "ends too soon")
        solid = "solid a\n" + "facet normal 0 0 1\nouter loop\nvertex 0 0 0\nvertex 1 0 0\nvertex 0 1 0\nendloop\nendfacet\n" * 4
        refused("text.stl", solid.encode(), "ends too soon")
        (self.folder / "good.stl").write_text(solid + "endsolid a\n")
        self.good("evaluate", self.folder / "good.stl", "--capture", self.capture)

    def test_missing_image(self):
        capture = self.copy_of_capture()
        (capture / "masks" / "view_003.png").unlink()
        (capture / "images" / "view_003.png").unlink()
        self.fails(FILES, ["projections.txt", "view_003.png", "missing"], capture)

    def test_sizes_differ(self):
        capture = self.copy_of_capture()
        program.write_png(capture / "masks" / "view_004.png", 64, 32, lambda x, y: 255 * (x > 9))
        self.fails(FILES, ["masks/view_004.png", "64 x 32", "images/view_004.png", "128 x 128"], capture)

    def test_photographs_without_options(self):
        capture = self.copy_of_capture()
        for file in (capture / "masks").iterdir():
            file.unlink()
        (capture / "masks").rmdir()
        self.fails(PROCESSING, ["view_000.png", "key", "threshold"], capture)

    def test_matrices(self):
        for row, words in (("1 2 3", ["12"]), ("nan 0 0 0 0 1 0 0 0 0 1 5", ["nan"]),
                           ("inf 0 0 0 0 1 0 0 0 0 1 5", ["inf"]), ("1 0 0 0 1 0 0 0 0 0 1 5", ["rank", "view_000.png"])):
            with self.subTest(row):
                capture = self.copy_of_capture()
                self.edit_matrix(capture, row)
                self.fails(FILES, ["projections.txt"] + words, capture)
                for path in sorted(capture.rglob("*"), reverse=True):
                    path.rmdir() if path.is_dir() else path.unlink()
                capture.rmdir()

    def test_nothing_survives(self):
        capture = self.copy_of_capture()
        program.write_png(capture / "masks" / "view_005.png", 128, 128, lambda x, y: 0)
        box = ["--bounds", "-1,1,-1,1,-1,1"]
        self.fails(PROCESSING, ["nothing survives", "view_005.png"], capture, *box)
        self.fails(PROCESSING, ["nothing survives", "view_005.png"], capture)

    def test_one_view_without_bounds(self):
        self.fails(PROCESSING, ["automatic bounds", "1 view", "give the bounds"], self.capture, "--views", 0)

    def test_votes_that_do_not_fit_the_capture(self):
        for votes in (12, 65534):
            self.fails(ARGUMENTS, ["--background-votes", f"{votes} of 12 views", "0 to 11"], self.capture, "--background-votes", votes)
        self.fails(ARGUMENTS, ["--background-votes", "3 of 3 views", "0 to 2"], self.capture, "--views", "0-2", "--background-votes", 3)
        for surface in ("local-hull", "voting"):
            self.fails(ARGUMENTS, ["--background-votes", "3 contradicts --vote-share 0.9", "leaves 1 of 12 views"], self.capture,
                       "--surface", surface, "--vote-share", 0.9, "--background-votes", 3)
        self.fails(ARGUMENTS, ["--background-votes", "0 contradicts --vote-share 0.75", "leaves 3"], self.capture,
                   "--vote-share", 0.75, "--background-votes", 0)

    def test_selection(self):
        for selection, *words in (("99", "0 to 11"), ("0-17", "0 to 11"), ("3-1", "backwards"),
                                  ("view_99.png", "name of a view", "0 to 11")):
            words += ["--views: ", f"'{selection}'"]
            self.fails(ARGUMENTS, words, self.capture, "--views", selection)
            self.fails(ARGUMENTS, words, self.capture / "projections.txt", "--views", selection)
            self.bad(ARGUMENTS, words, "evaluate", self.capture / "truth.ply", "--capture", self.capture, "--views", selection)
        self.fails(FILES, ["nowhere", "no such folder"], self.folder / "nowhere", "--views", "99")

    def test_float_too_coarse(self):
        capture = self.copy_of_capture()
        file = capture / "projections.txt"
        lines = []
        for line in file.read_text().splitlines(): # the world moved by 1e6: X = X' - 1e6
            words = line.split()
            p = [float(word) for word in words[1:]]
            for row in range(3):
                p[4 * row + 3] -= 1e6 * p[4 * row]
            lines.append(" ".join([words[0]] + [repr(number) for number in p]))
        file.write_text("\n".join(lines) + "\n")
        self.fails(PROCESSING, ["single precision"], capture, "--bounds", "999999,1000001,-1,1,-1,1")

    def test_unwritable_output(self):
        for option, name in (("-o", "x.ply"), ("--metrics", "x.json"), ("--octree", "x.htg")):
            file = self.folder / "gone" / name
            place = ["-o", self.folder / "x.ply"] if option != "-o" else []
            self.bad(FILES, ["cannot write", str(file), "no folder"], "reconstruct", self.capture, *place, option, file)
        (self.folder / "taken.ply").mkdir()
        self.bad(FILES, ["cannot write", "taken.ply", "folder"], "reconstruct", self.capture, "-o",
                 self.folder / "taken.ply")
        self.assertEqual(self.names(), ["taken.ply"])

    @unittest.skipIf(os.geteuid() == 0, "root may write everywhere")
    def test_no_right_to_write(self):
        locked = self.make("locked")
        (locked / "x.ply").write_text("old")
        locked.chmod(0o555)
        self.bad(FILES, ["cannot write", "locked"], "reconstruct", self.capture, "-o", locked / "x.ply")
        self.assertEqual((locked / "x.ply").read_text(), "old")
        locked.chmod(0o755)

    def test_overwrites_whole_files_and_follows_links(self):
        (self.folder / "real.ply").write_text("old")
        (self.folder / "x.ply").symlink_to("real.ply")
        self.good("reconstruct", self.capture, "-o", self.folder / "x.ply", "--depth", 4)
        self.assertTrue((self.folder / "x.ply").is_symlink())
        self.assertEqual((self.folder / "real.ply").read_bytes()[:3], b"ply")

    def test_truth(self):
        self.fails(FILES, ["cannot read mesh", "none.ply", "no such file"], self.capture, "--truth",
                   self.folder / "none.ply")


class BadMeshes(ProgramTest):
    SHAPE = "sphere"

    def evaluate_fails(self, words, name, content):
        mesh = self.folder / name
        mesh.write_bytes(content)
        self.bad(FILES, ["cannot read mesh", name] + words, "evaluate", mesh, "--capture", self.capture)

    def test_meshes(self):
        self.evaluate_fails(["no face"], "empty.obj", b"")
        self.evaluate_fails(["line 4", "'9'"], "index.obj", b"v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 9\n")
        self.evaluate_fails(["line 1", "coordinates"], "short.obj", b"v 0 zero 0\n")
        self.evaluate_fails([], "broken.ply", b"ply\nformat nonsense\n")
        self.evaluate_fails([], "broken.vtp", b"<VTKFile")
        self.evaluate_fails([], "broken.stl", b"solid nothing")
        self.bad(program.ARGUMENTS, ["mesh.doc", "vtp, ply, stl or obj"], "evaluate", self.text("mesh.doc"), "--capture",
                 self.capture)
        self.bad(FILES, ["none.ply", "no such file"], "evaluate", self.folder / "none.ply", "--capture", self.capture)

    def text(self, name):
        (self.folder / name).write_text("text")
        return self.folder / name

    def test_mesh_to_photograph(self):
        self.bad(FILES, ["cannot read mesh", "none.ply"], "synthesize", self.folder / "new", "--mesh",
                 self.folder / "none.ply")
        self.assertEqual(self.names(), [])


if __name__ == "__main__":
    unittest.main()
