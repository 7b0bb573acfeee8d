# SPDX-License-Identifier: BSD-3-Clause
"""What each generation costs: carve, exact surface and local hulls of a capture, by the Python classes, a process for each depth.

    growth.py CAPTURE [--key CHANNEL:EXCESS] [--depths 7-11] [--pieces N | --local-hulls]
    growth.py CAPTURE [--key CHANNEL:EXCESS] --depths 10 --ranks 1,2,4,8

Views include a carve to depth 6. Local hulls are made with --local-hulls alone, and count in the memory then. With --pieces the octree is made in pieces, one after another, and no surface is kept.
With --ranks every piece of each of these numbers is made by a process of its own, as the ranks of an MPI run would, one
after another so that they do not disturb each other: what the slowest takes is what the run would. The package
vtksilhouette has to be on Python's path; memory is the operating system's account of the process.
"""
import argparse
import json
import resource
import subprocess
import sys
import time


def pipeline(options):
    from vtksilhouette import (vtkLocalHullSurfacer, vtkSilhouetteCaptureReader, vtkSilhouetteExtractor,
                               vtkSilhouetteOctreeSource, vtkVotingMarchingCubes)
    reader, extractor = vtkSilhouetteCaptureReader(), vtkSilhouetteExtractor()
    octree, cubes, hulls = vtkSilhouetteOctreeSource(), vtkVotingMarchingCubes(), vtkLocalHullSurfacer()
    reader.SetFileName(options.capture)
    extractor.SetInputConnection(reader.GetOutputPort())
    if options.key:
        channel, excess = options.key.split(":")
        extractor.SetKeyChannel({"red": 0, "green": 1, "blue": 2}[channel])
        extractor.SetKeyExcess(float(excess))
    extractor.LargestRegionOn()
    octree.SetInputConnection(extractor.GetOutputPort())
    cubes.SetInputConnection(0, octree.GetOutputPort(0))
    cubes.SetInputConnection(1, octree.GetOutputPort(1))
    hulls.SetInputConnection(0, cubes.GetOutputPort())
    hulls.SetInputConnection(1, octree.GetOutputPort(0))
    hulls.SetInputConnection(2, octree.GetOutputPort(1))
    return extractor, octree, cubes, hulls


def count(data, name):
    return int(data.GetFieldData().GetAbstractArray(name).GetVariantValue(0).ToTypeUInt64())


def one(options):
    """One depth: seconds, octants, view tests, memory."""
    extractor, octree, cubes, hulls = pipeline(options)
    begin = time.process_time()
    extractor.Update()
    octree.SetDepth(6)
    octree.UpdatePiece(0, options.pieces, 0)  # views prepared; threads and libraries awake
    octree.SetDepth(options.depth)
    result = {"views": time.process_time() - begin, "carve": 0.0, "surface": 0.0, "octants": 0, "view_tests": 0, "intersection": 0,
              "faces": 0}
    for piece in range(options.pieces) if options.piece is None else [options.piece]:
        start = time.process_time()
        octree.UpdatePiece(piece, options.pieces, 0)
        middle = time.process_time()
        cubes.UpdatePiece(piece, options.pieces, 0)
        result["carve"] += middle - start
        result["surface"] += time.process_time() - middle
        grid = octree.GetOutput()
        result["octants"] += count(grid, "OctantsTested")
        result["view_tests"] += count(grid, "ViewTests")
        result["intersection"] += count(grid, "IntersectionOctants")
        result["faces"] += cubes.GetOutput().GetNumberOfPolys()
    if options.local_hulls:
        start = time.process_time()
        hulls.Update(0)
        result["hulls"] = time.process_time() - start
    result["memory_mib"] = resource.getrusage(resource.RUSAGE_SELF).ru_maxrss / 1024.0
    print(json.dumps(result))


def measure(*arguments):
    """What one() says in a process of its own."""
    command = [sys.executable, __file__, *sys.argv[1:], *map(str, arguments)]
    run = subprocess.run(command, stdout=subprocess.PIPE)
    if run.returncode != 0:
        sys.exit("growth.py: %s made no octree or surface; what is wrong is said above" % " ".join(map(str, arguments)))
    return json.loads(run.stdout.splitlines()[-1])


def scaling(options):
    """How evenly the pieces share the work, and what each rank repeats."""
    depth = options.depths[0]
    print("| ranks | slowest rank | mean rank | slowest to mean | all ranks | views, each rank | memory, most, MiB | "
          "on the surface, least to most |\n| ---: | ---: | ---: | ---: | ---: | ---: | ---: | ---: |")
    base = None
    for ranks in options.ranks:
        rows = [measure("--depth", depth, "--pieces", ranks, "--piece", piece) for piece in range(ranks)]
        times = [row["carve"] + row["surface"] for row in rows]
        base = base or sum(times)
        mean = sum(times) / ranks
        print("| %d | %.3g | %.3g | %.2f | %.3g | %.3g | %.0f | %s to %s |" % (
            ranks, max(times) / base, mean / base, max(times) / mean, sum(times) / base,
            sum(row["views"] for row in rows) / ranks / base, max(row["memory_mib"] for row in rows),
            *(format(pick(row["intersection"] for row in rows), ",") for pick in (min, max))), flush=True)
    print("\nDepth %d; processor times as multiples of carve and surface by the first number of ranks (%.3g s)." % (depth, base))


def table(options):
    rows = {depth: measure("--depth", depth) for depth in options.depths}
    heads = ["depth", "octants tested", "view tests", "on the surface", "faces", "carve", "surface", "time, of the depth before",
             *(["local hulls", "of the depth before", "of the surface"] if options.local_hulls else []), "memory, MiB"]
    print("| %s |\n|%s" % (" | ".join(heads), " ---: |" * len(heads)))
    first = rows[options.depths[0]]
    base = first["carve"] + first["surface"]
    for depth, row in rows.items():
        taken = row["carve"] + row["surface"]
        before = rows.get(depth - 1)
        cells = [depth, *(format(row[key], ",") for key in ("octants", "view_tests", "intersection", "faces")),
                 "%.3g" % (row["carve"] / base), "%.3g" % (row["surface"] / base),
                 "%.2f" % (taken / (before["carve"] + before["surface"])) if before else ""]
        if options.local_hulls:
            cells += ["%.3g" % (row["hulls"] / base), "%.2f" % (row["hulls"] / before["hulls"]) if before else "",
                      "%.2f" % (row["hulls"] / row["surface"])]
        print("| %s |" % " | ".join(map(str, [*cells, "%.0f" % row["memory_mib"]])))
    print("\nTimes as multiples of carve and surface at depth %d (%.3g s)." % (options.depths[0], base))


def depths_of(text):
    first, last = text.split("-") if "-" in text else (text, text)
    return list(range(int(first), int(last) + 1))


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("capture")
    parser.add_argument("--key")
    parser.add_argument("--depths", type=depths_of, default=list(range(7, 12)))
    parser.add_argument("--pieces", type=int, default=1)
    parser.add_argument("--local-hulls", action="store_true")
    parser.add_argument("--ranks", type=lambda text: [int(n) for n in text.split(",")])
    parser.add_argument("--depth", type=int, help=argparse.SUPPRESS)
    parser.add_argument("--piece", type=int, help=argparse.SUPPRESS)
    options = parser.parse_args()
    if options.ranks and len(options.depths) > 1:
        parser.error("--ranks goes with one depth: --depths %d" % options.depths[-1])
    if options.local_hulls and (options.ranks or options.pieces > 1):
        parser.error("--local-hulls goes with one piece: the local hulls are decided over the whole")
    one(options) if options.depth else scaling(options) if options.ranks else table(options)


if __name__ == "__main__":
    main()
