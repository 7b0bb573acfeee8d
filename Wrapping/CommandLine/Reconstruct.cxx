// SPDX-License-Identifier: BSD-3-Clause
#include "Reconstruct.h"

#include "Arguments.h"
#include "ExitCodes.h"
#include "MeshFiles.h"
#include "OutputChecks.h"
#include "Reconstruction.h"

#include <limits>

namespace silhouette::program
{
namespace
{

const char* const Description =
  "From calibrated photographs, or their silhouettes, to a closed mesh.\n\n"
  "The silhouettes carve an octree out of the space that all cameras see; marching cubes and local hulls make a mesh "
  "of\nwhat survives. The default surface is closed, oriented outwards, manifold and free of self-intersections, "
  "whatever\nthe silhouettes.";

constexpr const char* HullGroup = "Local hulls";

std::string footer()
{
  return std::string("Colours are on a scale of 0 to 1, lengths in the unit of the cameras. Without any of the options "
                     "that tell\nbackground from object, masks, two-valued images or an alpha channel are the "
                     "silhouettes.\n\n"
                     "Examples:\n"
                     "  vtksilhouette reconstruct jug -o jug.ply\n"
                     "  vtksilhouette reconstruct photos -o toy.ply --key blue:0.08 --opening 1 --largest-region \\\n"
                     "    --fill-holes 60 --metrics toy.json --image toy.png\n\n") +
    ExitCodesHelp;
}

} // namespace

std::string ReconstructOptions::carvingSettledBy() const
{
  return this->voteShare ? "--vote-share"
    : this->backgroundVotes ? "--background-votes"
    : this->votes == "faithful" ? "--votes faithful"
    : this->surface == "marching-cubes" ? "--surface marching-cubes"
    : this->silhouettes.dilates() ? "--dilate"
    : "";
}

Reconstruct::Reconstruct(CLI::App& program)
{
  this->App = addCommand(program, "reconstruct", Description);
  this->App
    ->add_option("CAPTURE", this->Options.capture, "A folder with images/ or masks/ and projections.txt (image name and "
                                                   "the 12 numbers of the 3 x 4 matrix, a line a view), a Middlebury "
                                                   "*_par.txt, a transforms.json (NeRF, Blender, nerfstudio), a COLMAP "
                                                   "model (cameras and images, .bin or .txt, there or in sparse or "
                                                   "sparse/0), or cameras of OpenCV (cameras.yml), Metashape (*.xml), "
                                                   "PMVS (txt) or NeuS (*.npz); or one of these files. Lens distortion is taken out")
    ->required();
  this->addOutputs();
  this->Options.silhouettes.addTo(*this->App);
  this->addOctree();
  this->addSurface();
  this->addLocalHulls();
  this->addRest();
  this->App->footer(footer());
}

void Reconstruct::addOutputs()
{
  const char* const group = "Output";
  this->App->add_option("-o,--output", this->Options.mesh, "The mesh: .vtp and .obj keep double precision, .ply and "
                                                           ".stl single precision")
    ->type_name("FILE")
    ->required()
    ->group(group);
  this->App
    ->add_option("--metrics", this->Options.metrics, "Counts, qualities and costs of this run, one JSON object")
    ->type_name("FILE.json")
    ->group(group);
  this->App->add_option("--image", this->Options.image, "A rendered preview of the mesh")
    ->type_name("FILE.png")
    ->group(group);
  this->App->add_option("--octree", this->Options.octree, "The octree, as VTK's HyperTreeGrid (ParaView opens it)")
    ->type_name("FILE.htg")
    ->group(group);
}

void Reconstruct::addOctree()
{
  const char* const group = "Octree";
  CLI::Option* depth = this->App->add_option("--depth", this->Options.depth,
    "Subdivisions of the root cube, 1 to 16 (default: 8). One more is twice as fine and costs about four times as much");
  depth->type_name("N")->check(inRange(1, 16, true))->group(group);
  this->App
    ->add_option("--leaf-edge", this->Options.leafEdge, "Instead of the depth: subdivide until octants have at most "
                                                        "this edge. Larger is coarser")
    ->type_name("LENGTH")
    ->check(aboveZero(std::numeric_limits<double>::max()))
    ->excludes(depth)
    ->group(group);
  this->App
    ->add_option("--bounds", this->Options.boundsText, "A box that holds the object (default: found from silhouettes "
                                                       "and cameras)")
    ->type_name("X0,X1,Y0,Y1,Z0,Z1")
    ->group(group);
  this->App
    ->add_option("--outside", this->Options.outside, "What a view says of points outside its image: border, nothing "
                                                     "beyond a side that the silhouette touches, else background; "
                                                     "unknown, nothing; background")
    ->type_name("POLICY")
    ->check(CLI::IsMember({ "border", "unknown", "background" }))
    ->capture_default_str()
    ->group(group);
  this->App
    ->add_option("--carving", this->Options.carving, "tolerant, background votes, and at worst dilated silhouettes, where "
                                                     "strict carving cuts parts thinner than the noise, so that they are "
                                                     "lost in all silhouettes; strict, without looking. "
                                                     "--background-votes, --vote-share, --dilate, --votes faithful and "
                                                     "--surface marching-cubes settle it, too; they exclude an explicit tolerant")
    ->type_name("KIND")
    ->check(CLI::IsMember({ "tolerant", "strict" }))
    ->capture_default_str()
    ->group(group);
}

void Reconstruct::addLocalHulls()
{
  const char* const group = HullGroup;
  this->App
    ->add_option("--mode", this->Options.mode, "robust, labels of the views corrected by what they agree on; thesis, one "
                                               "convex hull for each chain of slices, combined; it has no correction to switch off")
    ->type_name("MODE")
    ->check(CLI::IsMember({ "robust", "thesis" }))
    ->capture_default_str()
    ->group(group);
  this->App
    ->add_option("--drop-islands", this->Options.islandShare, "Give up components of the octants that survive where "
                                                              "they have fewer than this share of the largest one's, 0 "
                                                              "to 1, and octants that only false pixels uphold; they are "
                                                              "counted in the metrics, dropped_octants. "
                                                              "Without this option all are kept")
    ->type_name("[SHARE]")
    ->expected(0, 1)
    ->default_str("0.05")
    ->check(inRange(0.0, 1.0))
    ->group(group);
  const auto addSwitch = [&](const char* name, bool& option, const char* help)
  { this->Switches.push_back(this->App->add_flag_callback(name, [&option] { option = false; }, help)->group(group)); };
  addSwitch("--no-repair", this->Options.repair, "Leave silhouettes as they are: speckles, in the object and in the "
                                                 "background, and what a single view cuts deep and wide out of the "
                                                 "object; without it the former are filled and erased, the latter filled");
  addSwitch("--no-alignment", this->Options.alignment, "Leave views where their cameras say they are");
  addSwitch("--no-correction", this->Options.correction, "Leave the surface where the strictest views say it is, not "
                                                         "where they agree on average");
  addSwitch("--no-thin-hulls", this->Options.thinHulls, "Leave parts thinner than an octant angular");
  addSwitch("--no-handles", this->Options.handles, "Leave handles apart that noise has cut");
  addSwitch("--no-tunnels", this->Options.tunnels, "Leave narrow tunnels open, which noise and the grid make");
}

void Reconstruct::addSurface()
{
  const char* const group = "Surface";
  this->App
    ->add_option("--surface", this->Options.surface, "local-hull, closed and clean whatever the silhouettes; voting, "
                                                     "marching cubes with a vote of the views at each corner; "
                                                     "marching-cubes, the same with all views needed")
    ->type_name("KIND")
    ->check(CLI::IsMember({ "local-hull", "voting", "marching-cubes" }))
    ->capture_default_str()
    ->group(group);
  this->App
    ->add_option("--vote-share", this->Options.voteShare, "Share of the views that must call a point inside, above 0 "
                                                          "to 1 (default: what --background-votes leaves, else "
                                                          "what --carving settles). "
                                                          "Smaller forgives more wrong silhouettes")
    ->type_name("X")
    ->check(aboveZero(1.0))
    ->group(group);
  this->App
    ->add_option("--background-votes", this->Options.backgroundVotes, "Views that may call an octant background "
                                                                      "without its being carved, fewer than all (default: what "
                                                                      "--vote-share leaves, else what --carving settles)")
    ->type_name("K")
    ->check(inRange(0, 65534, true))
    ->group(group);
  this->App
    ->add_option("--votes", this->Options.votes, "consistent, the octree allows the background votes that the share "
                                                 "leaves, and the surface is closed; faithful, the strict octree at "
                                                 "any share, as published: marching cubes then has holes")
    ->type_name("MODE")
    ->check(CLI::IsMember({ "consistent", "faithful" }))
    ->capture_default_str()
    ->group(group);
  this->App
    ->add_option("--edges", this->Options.edges, "Where marching cubes puts a vertex on its edge: exact, where the "
                                                 "votes fail, pixels being squares; sub-pixel, the same by distances "
                                                 "between pixels, nearer to smooth contours; middle")
    ->type_name("PLACE")
    ->check(CLI::IsMember({ "exact", "sub-pixel", "middle" }))
    ->capture_default_str()
    ->group(group);
  this->App
    ->add_flag("--largest", this->Options.largest, "Keep the component of the largest volume only; octants given up with "
                                                   "the others are counted in the metrics, dropped_octants")
    ->group(group);
}

void Reconstruct::addRest()
{
  const char* const group = "Run";
  this->App
    ->add_option("--truth", this->Options.truth, "A mesh to measure the distance to, from samples a leaf edge of the octree apart "
                                                "(evaluate's are a 512th of the truth's longest side): .vtp, .ply, .stl or .obj")
    ->type_name("MESH")
    ->group(group);
  this->App
    ->add_option("--pieces", this->Options.pieces, "Carve and contour in so many pieces, one after another: only one piece's "
                                                   "octree is held in memory (--carving tolerant, which looks at the whole, "
                                                   "holds it all); the mesh is the same. With --surface voting or "
                                                   "marching-cubes; lost_surface is then not measured")
    ->type_name("N")
    ->check(inRange(1, 4096, true))
    ->capture_default_str()
    ->group(group);
  this->App
    ->add_option("--threads", this->Options.threads, "Threads to use (default: 0, all processors); the result is the "
                                                     "same for any number")
    ->type_name("N")
    ->check(inRange(0, 4096, true))
    ->group(group);
  this->App->add_flag("-q,--quiet", this->Options.quiet, "No progress bar and no summary")->group(group);
}

void Reconstruct::finish()
{
  ReconstructOptions& options = this->Options;
  options.silhouettes.finish();
  if (!isMeshFile(options.mesh))
  {
    throw CLI::ValidationError("--output", "'" + options.mesh + "' has the extension of no mesh; " + MeshFormats +
        " are written");
  }
  if (!options.boundsText.empty())
  {
    const std::string expected = "six numbers x0,x1,y0,y1,z0,z1, the smaller of each pair first";
    const std::vector<double> box = parseNumbers("--bounds", options.boundsText, 6, expected);
    if (!(box[0] < box[1] && box[2] < box[3] && box[4] < box[5]))
    {
      throw CLI::ValidationError("--bounds", "expected " + expected + "; got '" + options.boundsText + "'");
    }
    options.bounds = { box[0], box[1], box[2], box[3], box[4], box[5] };
  }
  if (options.surface == "marching-cubes" &&
    (options.voteShare.value_or(1.0) < 1.0 || options.backgroundVotes.value_or(0) > 0))
  {
    throw CLI::ValidationError("--surface", "marching-cubes needs all views; with a vote share or background votes "
                                            "it is --surface voting");
  }
  if (options.pieces > 1 && (options.surface == "local-hull" || !options.octree.empty()))
  {
    throw CLI::ValidationError("--pieces", options.surface == "local-hull"
        ? "local hulls are decided over the whole; pieces need --surface voting or marching-cubes"
        : "--octree writes the whole octree, which pieces never hold");
  }
  this->checkMeaning();
  checkExtension("--metrics", options.metrics, ".json");
  checkExtension("--image", options.image, ".png");
  checkExtension("--octree", options.octree, ".htg");
}

void Reconstruct::checkMeaning() const
{
  const ReconstructOptions& options = this->Options;
  for (const CLI::Option* option : this->App->get_options([](const CLI::Option* one) { return one->get_group() == HullGroup; }))
  {
    if (option->count() > 0 && options.surface != "local-hull")
    {
      throw CLI::ValidationError(option->get_name(), "means nothing to --surface " + options.surface + "; it is for local-hull");
    }
  }
  for (const CLI::Option* option : this->Switches)
  {
    if (option->count() > 0 && options.mode == "thesis")
    {
      throw CLI::ValidationError(option->get_name(), "means nothing to --mode thesis, which corrects nothing; it is for robust");
    }
  }
  if (options.votes == "faithful" && options.backgroundVotes.value_or(0) > 0)
  {
    throw CLI::ValidationError("--background-votes", std::to_string(*options.backgroundVotes) +
        " contradicts --votes faithful, whose octree is strict: it is 0");
  }
  const std::string settledBy = options.carvingSettledBy();
  if (this->App->get_option("--carving")->count() > 0 && options.carving == "tolerant" && !settledBy.empty())
  {
    throw CLI::ValidationError("--carving", "tolerant means nothing with " + settledBy + ", which settles what is tolerated");
  }
}

void Reconstruct::run()
{
  Reconstruction(this->Options).run();
}

} // namespace silhouette::program
