// SPDX-License-Identifier: BSD-3-Clause
#include "Synthesize.h"

#include "Arguments.h"
#include "CaptureFiles.h"
#include "ExitCodes.h"
#include "MeshFiles.h"
#include "OutputFiles.h"
#include "Stages.h"

#include "vtkNew.h"
#include "vtkPartitionedDataSetCollection.h"
#include "vtkPolyData.h"
#include "vtkSMPTools.h"
#include "vtkSyntheticCaptureSource.h"

#include <cstdio>

namespace silhouette::program
{
namespace
{

constexpr int LargestSize = 16384;

/** In the order of vtkSyntheticCaptureSource's shapes. */
const std::vector<std::string> ShapeNames = { "jug", "sphere", "torus", "twig", "pebble", "pumpkin" };

const char* const Description =
  "A capture whose truth is known: photographs, silhouettes and cameras of a solid, and the solid.\n\n"
  "Writes FOLDER/masks, FOLDER/images, FOLDER/projections.txt and FOLDER/truth.ply. Masks are exact (a pixel is object\n"
  "where its centre lies in a projected triangle) unless noise is asked for; photographs have none.";

std::string footer()
{
  return std::string("Examples:\n"
                     "  vtksilhouette synthesize jug\n"
                     "  vtksilhouette synthesize torn --shape torus --views 24 --size 640x480 --noise-blobs 3 --seed 7\n\n") +
    ExitCodesHelp;
}

} // namespace

Synthesize::Synthesize(CLI::App& program)
{
  this->App = addCommand(program, "synthesize", Description);
  this->App->add_option("FOLDER", this->Folder, "Where the capture goes; has to be empty, or not to be there")
    ->required();
  this->addShape();
  this->addNoise();
  this->App->add_flag("--force", this->Force, "Replace a capture that is in FOLDER")->group("Run");
  this->App->add_option("--threads", this->Threads, "Threads to use (default: 0, all processors)")
    ->type_name("N")
    ->check(inRange(0, 4096, true))
    ->group("Run");
  this->App->add_flag("-q,--quiet", this->Quiet, "No progress bar and no summary")->group("Run");
  this->App->footer(footer());
}

void Synthesize::addShape()
{
  const char* const group = "Solid and cameras";
  CLI::Option* shape = this->App->add_option("--shape", this->Shape,
    "jug, with a handle: genus 1, concave, thin parts; sphere, of radius 0.9; torus; twig, of tubes thinner than an "
    "octant of depth 7; pebble, convex; pumpkin, with grooves and a stalk (default: jug). All lie in the cube from -1 "
    "to 1");
  shape->type_name("NAME")->check(CLI::IsMember(ShapeNames))->group(group);
  this->App->add_option("--mesh", this->Mesh, "A solid of your own instead: .vtp, .ply, .stl or .obj")
    ->type_name("FILE")
    ->excludes(shape)
    ->group(group);
  this->App->add_option("--views", this->Views, "Number of cameras, around the solid; more carve closer")
    ->type_name("N")
    ->check(inRange(1, 10000, true))
    ->capture_default_str()
    ->group(group);
  this->App->add_option("--size", this->SizeText, "Size of the images, pixels")
    ->type_name("WxH")
    ->capture_default_str()
    ->group(group);
}

void Synthesize::addNoise()
{
  const char* const group = "Noise (default: none)";
  this->App->add_option("--seed", this->Seed, "Another number draws other noise of the same strength, 0 to 2^32 - 1 (default: 0)")
    ->type_name("N")
    ->check(inRange(0, 4294967295.0, true))
    ->group(group);
  this->App
    ->add_option("--noise-contour", this->NoiseContour, "Standard deviation of the contours' displacement, smooth along "
                                                        "the contour; pixels, 0 to 1000")
    ->type_name("SIGMA")
    ->check(inRange(0.0, 1000.0))
    ->group(group);
  this->App
    ->add_option("--noise-blobs", this->NoiseBlobs, "Cut 3 discs (of radius 8 to 25 pixels at an image size of 1024) out "
                                                    "of each of N masks; N up to the number of views")
    ->type_name("N")
    ->check(inRange(0, 10000, true))
    ->group(group);
  this->App->add_option("--noise-pixels", this->NoisePixels, "Share of each mask's pixels that flip, 0 to 1")
    ->type_name("SHARE")
    ->check(inRange(0.0, 1.0))
    ->group(group);
  this->App
    ->add_option("--noise-camera", this->NoiseCamera, "Standard deviation of the principal points as written; pixels, "
                                                      "0 to 1e6")
    ->type_name("PX")
    ->check(inRange(0.0, 1e6))
    ->group(group);
  this->App
    ->add_option("--noise-rotation", this->NoiseRotation, "Standard deviation of the turn about each camera's axes as "
                                                          "written; degrees, 0 to 90")
    ->type_name("DEGREES")
    ->check(inRange(0.0, 90.0))
    ->group(group);
}

void Synthesize::finish()
{
  const std::size_t cross = this->SizeText.find_first_of("xX");
  const CLI::Validator side = inRange(1, LargestSize, true);
  const std::string width = this->SizeText.substr(0, cross);
  const std::string height = cross == std::string::npos ? std::string() : this->SizeText.substr(cross + 1);
  if (!side(width).empty() || !side(height).empty())
  {
    throw CLI::ValidationError("--size", "expected width and height in pixels, 1 to 16384 each, as in 1024x768; got '" +
        this->SizeText + "'");
  }
  this->Width = static_cast<int>(std::stod(width)); // which may be written 1e3
  this->Height = static_cast<int>(std::stod(height));
  if (this->NoiseBlobs > this->Views)
  {
    throw CLI::ValidationError("--noise-blobs", std::to_string(this->NoiseBlobs) + " masks are more than the " +
        std::to_string(this->Views) + " views");
  }
}

void Synthesize::configure(vtkSyntheticCaptureSource* source) const
{
  source->SetShape(indexOf(this->Shape.value_or("jug"), ShapeNames));
  source->SetNumberOfViews(this->Views);
  source->SetWidth(this->Width);
  source->SetHeight(this->Height);
  source->SetSeed(static_cast<vtkIdType>(this->Seed));
  source->SetNoiseContour(this->NoiseContour);
  source->SetNoiseBlobs(this->NoiseBlobs);
  source->SetNoisePixels(this->NoisePixels);
  source->SetNoiseCamera(this->NoiseCamera);
  source->SetNoiseRotation(this->NoiseRotation);
}

void Synthesize::run()
{
  if (this->Threads > 0)
  {
    vtkSMPTools::Initialize(this->Threads);
  }
  Stages stages(this->Quiet);
  StagedFolder folder(this->Folder, this->Force);
  vtkNew<vtkSyntheticCaptureSource> source;
  this->configure(source);
  if (!this->Mesh.empty())
  {
    stages.run("read", "reading the mesh", [&] { source->SetInputData(readMesh(this->Mesh)); });
  }
  stages.run(source, "synthesize", "photographing the solid");
  vtkPartitionedDataSetCollection* masks = vtkPartitionedDataSetCollection::SafeDownCast(source->GetOutputDataObject(0));
  stages.run("write", "writing the capture",
    [&]
    {
      writeImages(masks, folder.path() / "masks");
      writeImages(source->GetPhotographsOutput(), folder.path() / "images");
      writeProjections(masks, folder.path() / "projections.txt");
      writeMesh(source->GetTruthOutput(), folder.path() / "truth.ply");
    });
  folder.commit();
  if (!this->Quiet)
  {
    std::printf("wrote %s: %d views of %d x %d pixels, projections.txt, truth.ply (%lld triangles)\n",
      this->Folder.c_str(), this->Views, this->Width, this->Height,
      static_cast<long long>(source->GetTruthOutput()->GetNumberOfPolys()));
  }
}

} // namespace silhouette::program
