# SPDX-License-Identifier: BSD-3-Clause
"""No include of the tree points the wrong way; and the check that says so finds what is planted."""

import os
import shutil
import subprocess
import tempfile
import unittest

from structure import ROOMS, violations

TREE = os.path.abspath(os.path.join(os.path.dirname(__file__), os.pardir, os.pardir))


class TestTree(unittest.TestCase):
    def test_no_include_points_the_wrong_way(self):
        found = violations(TREE)
        self.assertEqual(found, [], "\n" + "\n".join(found))

    def test_the_rooms_exist(self):
        # A room that is renamed would pass unseen.
        for room in ROOMS:
            if room != "Examples":
                with self.subTest(room):
                    self.assertTrue(os.path.isdir(os.path.join(TREE, room)))


    def test_the_top_level_holds_the_rooms_alone(self):
        if not os.path.exists(os.path.join(TREE, ".git")):
            self.skipTest("no git checkout: what is tracked is not known")
        tracked = subprocess.run(["git", "-c", f"safe.directory={TREE}", "-C", TREE, "ls-files"], check=True, text=True,
                                 stdout=subprocess.PIPE).stdout.splitlines()
        folders = {path.split("/")[0] for path in tracked if "/" in path}
        self.assertEqual(folders, {".ci", "CMake", "Documentation", "Examples", "Filters", "Testing", "Wrapping"})


class TestCheck(unittest.TestCase):
    """Each case plants one violation in a small tree of its own."""

    def setUp(self):
        self.tree = tempfile.mkdtemp()
        self.addCleanup(shutil.rmtree, self.tree)
        self.write("Filters/Core/Mesh.h", "#include <vector>\n")
        self.write("Filters/Core/PreparedViews.h", "inline int f(V v) { return v.object[0] + v.tiles.words()[0]; }\n")
        self.write("Filters/Capture/Regions.h", '#include "Mesh.h"\n#include <opencv2/imgproc.hpp>\n')
        self.write("Filters/Modeling/vtk.module", "NAME\n  M\n")
        self.write("Filters/Modeling/CMakeLists.txt", "set(classes\n  vtkSilhouetteThing\n)\n")
        self.write("Filters/Modeling/vtkSilhouetteThing.h",
                   '#include "vtkPolyDataAlgorithm.h"\n#include <memory>\n// template <T> of Eigen::Matrix\n')
        self.write("Filters/Modeling/vtkSilhouetteThing.cxx",
                   '#include "vtkSilhouetteThing.h"\n#include "Regions.h"\n#include <Eigen/LU>\n')
        self.write("Filters/OffScreen/Window.h", '#include "vtkRenderWindow.h"\n')
        self.write("Wrapping/CommandLine/main.cxx", '#include "vtkSilhouetteThing.h"\n#include <fstream>\n')
        self.write("Examples/Cxx/main.cxx", "#include <vtkSilhouetteThing.h>\n")

    def write(self, path, text):
        path = os.path.join(self.tree, path)
        os.makedirs(os.path.dirname(path), exist_ok=True)
        with open(path, "a", encoding="utf-8") as file:
            file.write(text)

    def expect(self, path, planted, *texts):
        before = len(violations(self.tree))
        self.assertEqual(before, 0, violations(self.tree))
        self.write(path, planted)
        found = violations(self.tree)
        self.assertEqual(len(found), 1, found)
        for text in (path, *texts):
            self.assertIn(text, found[0])

    def test_backwards_includes(self):
        for path, header, owner in (
                ("Filters/Core/Mesh.h", '"Regions.h"', "Filters/Capture"),
                ("Filters/Core/Mesh.h", '"../Capture/Regions.h"', "Filters/Capture"),
                ("Filters/Capture/Regions.h", '"vtkSilhouetteThing.h"', "Filters/Modeling"),
                ("Filters/OffScreen/Window.h", '"Mesh.h"', "Filters/Core"),
                ("Filters/Modeling/vtkSilhouetteThing.cxx", '"Window.h"', "Filters/OffScreen"),
                ("Examples/Cxx/main.cxx", '"Mesh.h"', "Filters/Core")):
            with self.subTest(path=path, header=header):
                self.setUp()
                self.expect(path, f"#include {header}\n", f"includes {header} of {owner}")

    def test_libraries_in_the_wrong_room(self):
        for path, header, kind in (
                ("Filters/Core/Mesh.h", '"vtkPolyData.h"', "VTK"),
                ("Filters/Core/Mesh.h", "<opencv2/core.hpp>", "OpenCV"),
                ("Filters/Core/Mesh.h", "<fstream>", "files"),
                ("Filters/Core/Mesh.h", "<filesystem>", "files"),
                ("Filters/Core/Mesh.h", "<sys/mman.h>", "the system"),
                ("Filters/Core/LargePages.cxx", "<fstream>", "files"),
                ("Filters/Capture/Regions.h", "<vtkImageData.h>", "VTK"),
                ("Filters/Modeling/vtkSilhouetteThing.cxx", "<opencv2/core.hpp>", "OpenCV"),
                ("Filters/Modeling/vtkSilhouetteThing.cxx", "<pugixml.hpp>", "the camera files' libraries"),
                ("Wrapping/CommandLine/main.cxx", "<yaml-cpp/yaml.h>", "the camera files' libraries"),
                ("Filters/Core/Mesh.h", "<zlib.h>", "the camera files' libraries"),
                ("Filters/OffScreen/Window.h", "<Eigen/Core>", "Eigen"),
                ("Wrapping/CommandLine/main.cxx", "<opencv2/core.hpp>", "OpenCV")):
            with self.subTest(path=path, header=header):
                self.setUp()
                self.expect(path, f"#include {header}\n", f"includes {header} ({kind})")

    def test_one_file_of_the_core_may_ask_the_system(self):
        self.write("Filters/Core/LargePages.cxx", "#include <sys/mman.h>\n")
        self.assertEqual(violations(self.tree), [])

    def test_unknown_headers(self):
        self.expect("Filters/Core/Mesh.h", "  #  include <boost/any.hpp>\n", "neither ours nor known")

    def test_installed_headers(self):
        path = "Filters/Modeling/vtkSilhouetteThing.h"
        for planted, what in (("#include <Eigen/Core>\n", "includes <Eigen/Core>"),
                              ('#include "Mesh.h"\n', 'includes "Mesh.h"'),
                              ("template <typename T> T f();\n", "shows a template"),
                              ("void f(const Eigen::Vector3d&);\n", "shows Eigen"),
                              ("void f(cv::Mat);\n", "shows OpenCV")):
            with self.subTest(planted):
                self.setUp()
                self.expect(path, planted, "an installed header", what)

    def test_pixels_looked_up_elsewhere(self):
        for planted in ("int a = view.object[3];\n", "int a = view->object.data()[3];\n",
                        "int a = view.tiles.words()[3];\n"):
            with self.subTest(planted):
                self.setUp()
                self.expect("Filters/Core/Mesh.h", planted, "outside PreparedViews")


if __name__ == "__main__":
    unittest.main()
