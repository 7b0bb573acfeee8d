# SPDX-License-Identifier: BSD-3-Clause
"""Ours beside its peers on one synthesized capture; see compare.sh, which calls this."""
import argparse
import datetime
import importlib.util
import json
import math
import os
import pathlib
import platform
import subprocess
import sys
import tempfile

HERE = pathlib.Path(__file__).resolve().parent
NAMES = {"ours": "vtkSilhouette, octree and exact surface", "subpixel": "vtkSilhouette, octree and sub-pixel surface",
         "hulls": "vtkSilhouette, with local hulls",
         "dense": "dense exact reference, vtkFlyingEdges3D", "numpy": "numpy script, vtkFlyingEdges3D",
         "open3d": "Open3D carve_silhouette, vtkFlyingEdges3D"}

TURNS = 3  # one thread and two threads in turn: what else the machine does changes by the minute


def run(command):
    done = subprocess.run([str(word) for word in command], stdout=subprocess.PIPE, stderr=subprocess.PIPE,
                          universal_newlines=True)
    if done.returncode != 0:
        sys.exit("compare: %s failed (%d): %s" % (command[0], done.returncode, done.stderr.strip()[-2000:]))
    return done.stdout


def stages(side, cells, options, *more, threads=None):
    return json.loads(run([options.stages, side, "--shape", options.shape, "--depth", int(math.log2(cells)), "--views",
                           options.views, "--size", options.size, "--threads",
                           options.threads if threads is None else threads, "--repeats", options.repeats, *more]))


def measure(side, cells, options, folder):
    """One side in a process of its own; its numbers, and those of its mesh."""
    mesh = folder / ("%s-%d.ply" % (side, cells))
    if side in ("numpy", "open3d"):
        result = json.loads(run([sys.executable, HERE / "peers.py", side, folder / "capture", cells, mesh]))
    else:
        result = stages(side, cells, options, "--mesh", mesh)
    metrics = folder / "metrics.json"
    run([options.program, "evaluate", mesh, "--capture", folder / "capture", "--truth", folder / "capture" / "truth.ply",
         "--metrics", metrics, "--quiet"])
    judged = json.loads(metrics.read_text())
    result.update(xor=judged["total_xor"], error=judged["truth_mean"] / (2.0 / cells), closed=judged["closed"])
    return result


def seconds(result):
    """What counts of a side: everything from masks in memory to the mesh."""
    return sum(value for name, value in result["seconds"].items() if name != "marching_cubes")


def processor_seconds(result):
    return sum(value for name, value in result["cpu_seconds"].items() if name != "marching_cubes")


def ratio_text(value):
    return "%.3g" % value if value < 1000 else format(round(value), ",")


def table(rows, cells, options):
    ours = rows["ours"]
    lines = ["", "%d cells a side" % cells, "",
             "| | time, ratio to ours | processor time | memory | faces | XOR % | error, cells |",
             "| --- | ---: | ---: | ---: | ---: | ---: | ---: |"]
    for side, row in rows.items():
        lines.append("| %s | %s | %s | %.3g | %s | %.3f | %.3f |" % (
            NAMES[side], ratio_text(seconds(row) / seconds(ours)), ratio_text(processor_seconds(row) / processor_seconds(ours)),
            row["memory_mib"] / ours["memory_mib"], format(row["faces"], ","), 100 * row["xor"], row["error"]))
    lines += ["", "Ours and VTK's filters: the fastest of %d; others run once. Ours: sums %.3g, carve %.3g, surface %.3g s; %.0f MiB, of these the capture %.0f." % (
        options.repeats, ours["seconds"]["sums"], ours["seconds"]["carve"], ours["seconds"]["surface"], ours["memory_mib"],
        ours["memory_before_mib"])]
    return lines


def targets(rows, cells, options):
    """The statements that are made of a size, with what was measured."""
    ours, said = rows["ours"], []

    def say(text, value, limit, at_least=False):
        met = value >= limit if at_least else value <= limit
        said.append("- %s: %s (%s %.3g): %s" % (text, ratio_text(value), "at least" if at_least else "at most", limit,
                                                  "met" if met else "NOT met"))
    if "open3d" in rows:
        if cells == 512:
            say("Open3D's time, ours being 1", seconds(rows["open3d"]) / seconds(ours), 300, True)
            say("our memory, Open3D's being 1", ours["memory_mib"] / rows["open3d"]["memory_mib"], 1 / 30)
    if "dense" in rows:
        dense = rows["dense"]
        if cells == 512:
            say("our time, vtkFlyingEdges3D's alone being 1", seconds(ours) / dense["seconds"]["flying_edges"], 3)
        said.append("- vtkMarchingCubes' time alone, vtkFlyingEdges3D's being 1: %.3g" % (
            dense["seconds"]["marching_cubes"] / dense["seconds"]["flying_edges"]))
        for side, name in (("ours", "exact"), ("subpixel", "sub-pixel")):
            if side in rows:
                say("our XOR, %s, the dense reference's being 1" % name, rows[side]["xor"] / dense["xor"], 1)
    if "hulls" in rows:
        def hulls(result):
            return result["seconds"]["local_hulls"] / result["seconds"]["surface"]
        say("the local hulls' time on clean silhouettes, the surface's being 1", hulls(rows["hulls"]), 3)
        noise = options.size / 256.0
        noisy = {share: stages("hulls", cells, options, "--noise-contour", share * noise) for share in (0.25, 0.5, 1, 2)}
        say("the same with contour noise of %g px" % noise, hulls(noisy[1]), 6)
        said.append("- that time with contour noise of %s px: %s" % (
            ", ".join("%g" % (share * noise) for share in noisy), ", ".join(ratio_text(hulls(result)) for result in noisy.values())))
        said.append("- the whole's time with local hulls, that of octree and surface being 1, clean and with that noise: %s" % (
            ", ".join(ratio_text(seconds(result) / (seconds(result) - result["seconds"]["local_hulls"]))
                      for result in [rows["hulls"], *noisy.values()])))
    if options.threads != 1:
        fastest = {1: math.inf, 2: math.inf}
        for threads in (1, 2) * TURNS:
            fastest[threads] = min(fastest[threads], seconds(stages("ours", cells, options, threads=threads)))
        say("one thread's time, that of two being 1", fastest[1] / fastest[2], 1.8, True)
    return said


def machine():
    model = platform.processor() or platform.machine()
    try:
        for line in pathlib.Path("/proc/cpuinfo").read_text().splitlines():
            if line.startswith("model name"):
                model = line.split(":", 1)[1].strip()
                break
    except OSError:
        pass
    return "%s, %d processors, %s; load %.1f at the start" % (model, os.cpu_count(), platform.system(), os.getloadavg()[0])


def parse():
    parser = argparse.ArgumentParser(prog="compare.sh", description="Ours beside its peers, on one synthesized capture.")
    parser.add_argument("--program", required=True, help="the program vtksilhouette")
    parser.add_argument("--stages", required=True, help="the program silhouette-stages")
    parser.add_argument("--shape", default="jug", help="the solid (default: jug)")
    parser.add_argument("--views", type=int, default=36)
    parser.add_argument("--size", type=int, default=1024, help="pixels of an image's sides")
    parser.add_argument("--cells", default="128,256,512", help="cells a side, powers of two (default: 128,256,512)")
    parser.add_argument("--sides", default="ours,subpixel,hulls,dense,numpy,open3d", help="which sides run")
    parser.add_argument("--largest", default="numpy:256,open3d:512", help="the most cells of a side")
    parser.add_argument("--threads", type=int, default=0, help="0: all processors")
    parser.add_argument("--repeats", type=int, default=8, help="runs of each of our stages and of VTK's filters, of which the fastest counts (default: 8)")
    options = parser.parse_args()
    options.cells = [int(word) for word in options.cells.split(",")]
    options.largest = dict((word.split(":")[0], int(word.split(":")[1])) for word in options.largest.split(",") if word)
    for cells in options.cells:
        if cells < 8 or cells & (cells - 1):
            parser.error("%d cells a side: a power of two, at least 8, is needed" % cells)
    return options


def main():
    options = parse()
    sides = options.sides.split(",")
    print("%s, %s" % (datetime.date.today().isoformat(), machine()))
    print("%s, %d views of %d x %d pixels, the cube from -1 to 1" % (options.shape, options.views, options.size, options.size))
    if "open3d" in sides and importlib.util.find_spec("open3d") is None:
        print("open3d is not installed (Debian: python3-open3d): left out")
        sides.remove("open3d")
    with tempfile.TemporaryDirectory(prefix="compare-") as name:
        folder = pathlib.Path(name)
        run([options.program, "synthesize", folder / "capture", "--shape", options.shape, "--views", options.views, "--size",
             "%dx%d" % (options.size, options.size), "--quiet"])
        for cells in options.cells:
            rows = {side: measure(side, cells, options, folder) for side in sides if options.largest.get(side, cells) >= cells}
            print("\n".join(table(rows, cells, options) + [""] + targets(rows, cells, options)), flush=True)


if __name__ == "__main__":
    main()
