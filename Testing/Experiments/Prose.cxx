// SPDX-License-Identifier: BSD-3-Clause
#include "Prose.h"

namespace silhouette::experiments::prose
{

const char* const Opening = R"(# Experiments: the surfaces under noise

This page is written by a program, tables, figures and words; the whole of it is made anew, from seeds, by

```sh
build/bin/silhouette-experiments --all --output experiments --documentation Documentation
```

`--resume` goes on with a run that was interrupted; `--report` alone writes the page from results that are
there; `--help` explains the rest. The short form that runs with the tests asserts the promises below in
every run.
)";

const char* const Setting = R"(
Six synthesized solids: two convex ones (sphere, pebble) and four that are not (torus, jug, pumpkin, twig).
Noise is of one kind at a time. Contour: the silhouettes' contours are moved along their normals by a random
field that is smooth over 6 px, of the stated standard deviation. Camera: the reported principal points are
off by the stated deviation in u and v. Blobs: three discs of radius 8 to 25 px are cut out of each of so
many masks. Pixels: so many of all pixels flip (salt and pepper), without a filter. Rotation: the reported
cameras are turned about each axis by the stated deviation. Pixels are those of an image of 1024; for other
sizes they are scaled. An octant of depth 7 is 7.5 of these pixels wide: 2, 4 and 8 px of contour noise are 0.27, 0.53
and 1.07 octants; at depth 6 an octant is twice as wide and the same noise half as many octants.

**Settings.** Above each table stand the depth of its octrees, the size of its images and its seeds. Seeds 1 to
4 are those that constants were chosen with, on jug, sphere and torus; the deficit and the shift below which
nothing is corrected, on all six objects; all numbers here are of other seeds. Mid-edge marching cubes, faithful voting,
voting with three background votes, the 3D Delaunay triangulation, the convex hull and VTK's surface
reconstruction are run with the first seed alone, and so is every method under 1 % of flipped pixels. The
errors to the solid and the XOR shares are of the first seed, for the methods that are run with all. Delaunay
triangulation and surface reconstruction are given every n-th point of exact marching cubes, 10,000 at most.
)";

const char* const Measures = R"(
Everything is carved in the same cube from -1 to 1, so that all methods share their octants. The *reference*
is the visual hull: exact marching cubes of the clean silhouettes, two generations deeper (one at depth 9). Of the twig, which is thinner than an octant, marching cubes leaves pieces at any depth: its
reference is the solid's own mesh, so that what is missing of a surface and what is too much both count.
The *error* is
the mean of two mean distances, from the surface to the reference and back, in leaf octants, over every n-th
triangle of each (12,000 or so; 3,000 for Delaunay triangulation, convex hull and surface reconstruction),
weighted by area. *Spread*, behind the sign ±, is the standard deviation
over the seeds. *Lost* are the last generation's survivors, of the octree that the surface was made from,
that it neither crosses nor encloses. *Genus* is empty where a surface is open. *XOR* is the share of the
silhouettes' pixels that the rendered surface has wrong, over the views used, with their noise.
)";

const char* const Promises = R"(
## Promises

In how many runs a surface breaks what the local hulls promise. The promise is theirs alone; the others show
what it is worth.
)";

const char* const Targets = R"(
## What was to be reached

The error of the local hulls as a ratio to that of exact marching cubes in the same run, the mean over the
seeds. Bold is reached.
)";

const char* const Errors = R"(
### Errors

In octants, with their spread; bold is the least of all methods. Numbers behind voting are the background votes
allowed: 1 of 36 views is a share of 97 %, 3 one of 92 %. Where there are two tables, the second is of the methods
that are run with the first seed alone.
)";

const char* const Shapes = R"(
### Soundness and shape

Voting, in both modes, with the number of background votes that has the least error in that row: in practice
it is not known. Ranges are over the seeds.
)";

const char* const Times = R"(
## Times

Medians of the times of the surface alone, without views and carving, as ratios to exact marching cubes of
the same run.
)";

const char* const Failures = R"(
## Runs without a surface

)";

const char* const Stages = R"(
## What each stage is for

The robust local hulls without one of their stages at a time. First the error of all stages together, the mean
over the objects, in octants; then the errors as ratios to it in the same runs, the geometric mean over the
objects, bold where leaving the stage out makes the error a tenth larger. Behind them the number of runs whose
surface has several pieces, another genus than the solid, or breaks one of the promises.
)";

const char* const Scaling = R"(
## Depths and sizes of images

The ratio of the local hulls' error to exact marching cubes', without noise and under contour noise of half an octant of the
depth. The constants are shares or octants, so that the ratio is to stay where an octant is at least two pixels
wide; in the middle of an image of 512 pixels it is 7.5 pixels at depth 6 and 0.9 at depth 9. It stays over the
sizes of images as long as an octant is that wide. It does not stay over the depths, but rises: the smaller an octant is beside the object, the fewer views
compete at a point, and the less marching cubes' own error; that the noise is smooth over 6 of 1024 pixels whatever the
depth, which is ever more octants, explains a small part of it (method.md, section 4).
)";

const char* const Islands = R"(
## Salt and pepper, with islands and debris dropped

Flipped pixels that no filter removes leave islands among the survivors, and debris on the object, which the local hulls keep, as they
promise to lose no octant. With `--drop-islands` the octants that only false pixels uphold and the components that are smaller than a twentieth
of the largest one are given up, and counted. Beside it voting at the best of its shares (1, 2 or 3 background votes).
)";

const char* const Votes = R"(
## Table 6.1 of the thesis

Faithful voting, mid-edge, on one convex object and a lattice of 64 x 64 x 64 octants (seven levels with the
root), 36 views. The thesis does not say what its object was. A sphere 47 octants across whose cameras are
off by 0.6 octants is where the search for what comes nearest starts; it goes over sizes, noise and seeds.
)";

const char* const Generations = R"(
One figure of the thesis stays open: 15,552 intersection octants in the last generation. Half the faces plus
the lost octants is nearly the same in all columns of its table, 10,675 to 11,000; an octant that has
patches has two triangles on average, so this is about the number of octants that were looked at, and 15,552
is not. In the spheres here it is the number of intersection octants of the last generation to some percent.
Two readings are left: 15,552 counts the intersection octants of all generations together, to which the last
column comes near, or the test of octants was looser than the exact polygon.
)";

const char* const Hulls = R"(
## Delaunay triangulation and convex hull

The thesis's Figure 6.4: the 3D Delaunay triangulation and the 3D convex hull of 100 random points, and of
the points of marching cubes on the convex object of Table 6.1. Both are convex whatever the object: on the
concave ones their error is the depth of the concavities. (The boundary of VTK's tetrahedra has a few faces
more than the hull: it leaves out the flattest of the outer tetrahedra.)
)";

} // namespace silhouette::experiments::prose
