# SPDX-License-Identifier: BSD-3-Clause
"""The benchmarks run, and count what the stages themselves count; no time is asserted."""
import json
import os
import subprocess
import unittest


def output(*command):
    return json.loads(subprocess.run(command, check=True, stdout=subprocess.PIPE, stderr=subprocess.DEVNULL).stdout)


class Stages(unittest.TestCase):
    def test_counts(self):
        rows = output(os.environ["SILHOUETTE_BENCHMARK"], "--benchmark_filter=sums|/5/", "--benchmark_min_time=0.01",
                      "--benchmark_format=json")["benchmarks"]
        found = {row["name"].split("/real_time")[0]: row for row in rows}
        self.assertEqual(sorted(found), ["carving/5", "localHulls/clean/5", "localHulls/noisy/5", "sums", "votingSurface/5"])
        stages = os.environ["SILHOUETTE_STAGES"]
        counts = output(stages, "ours", "--size", "512", "--depth", "5", "--repeats", "1")
        self.assertEqual(found["sums"]["pixels"], 36 * 512 * 512)
        self.assertEqual(found["carving/5"]["octants"], counts["octants_tested"])
        self.assertEqual(found["carving/5"]["view_tests"], counts["view_tests"])
        self.assertEqual(found["carving/5"]["intersection"], counts["intersection"])
        self.assertEqual(found["votingSurface/5"]["faces"], counts["faces"])
        for name, noise in (("clean", "0"), ("noisy", "2")):
            counts = output(stages, "hulls", "--size", "512", "--depth", "5", "--repeats", "1", "--noise-contour", noise)
            self.assertEqual(found["localHulls/%s/5" % name]["faces"], counts["faces"])


if __name__ == "__main__":
    unittest.main()
