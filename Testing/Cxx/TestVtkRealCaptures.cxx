// SPDX-License-Identifier: BSD-3-Clause
/**
 * The real captures, which other people took and which are not part of the project: SILHOUETTE_REAL_DATA names their folder, else
 * they are looked for beside the checkout. Skipped where they are not.
 */
#include "ModelingTesting.h"

#include "vtkHyperTreeGrid.h"
#include "vtkSilhouetteCaptureReader.h"
#include "vtkSilhouetteExtractor.h"
#include "vtkSilhouetteOctreeSource.h"
#include "vtkVotingMarchingCubes.h"

#include <cstdlib>
#include <sys/stat.h>

namespace
{

std::string captureFolder(const std::string& name)
{
  const char* other = std::getenv("SILHOUETTE_REAL_DATA");
  const std::string folder = std::string(other ? other : SILHOUETTE_SHARED_DATA) + "/" + name;
  struct stat status;
  return stat(folder.c_str(), &status) == 0 ? folder : std::string();
}

double field(vtkDataObject* data, const char* name)
{
  vtkDataArray* array = data->GetFieldData()->GetArray(name);
  EXPECT_NE(array, nullptr) << name;
  return array ? array->GetComponent(0, 0) : -1.0;
}

/** Reader, extractor with the recipe of the dinosaur's chroma key, octree. */
struct Dinosaur
{
  explicit Dinosaur(const std::string& folder)
  {
    this->Reader->SetFileName(folder.c_str());
    this->Extractor->SetInputConnection(this->Reader->GetOutputPort());
    this->Extractor->SetKeyChannel(vtkSilhouetteExtractor::BLUE);
    this->Extractor->SetKeyExcess(0.08);
    this->Extractor->UseThresholdOn();
    this->Extractor->SetThreshold(0.12);
    this->Extractor->AddOperation(vtkSilhouetteExtractor::OPENING, 1);
    this->Extractor->LargestRegionOn();
    this->Extractor->SetFillHoles(60);
    this->Octree->SetInputConnection(this->Extractor->GetOutputPort());
    this->Octree->SetDepth(9);
  }
  vtkNew<vtkSilhouetteCaptureReader> Reader;
  vtkNew<vtkSilhouetteExtractor> Extractor;
  vtkNew<vtkSilhouetteOctreeSource> Octree;
};

} // namespace

TEST(VtkRealCaptures, TheDinosaursOctreeAtDepthNine)
{
  const std::string folder = captureFolder("vgg-dinosaur");
  if (folder.empty())
  {
    GTEST_SKIP() << "the real captures are not here (SILHOUETTE_REAL_DATA, or ../shared/data)";
  }
  Dinosaur dinosaur(folder);
  silhouette::testing::Listener listener(dinosaur.Octree);

  // A cube of edge 0.2: a prototype with the exact polygon took 4.48 million view tests; bounding boxes alone keep
  // 410,050 octants.
  dinosaur.Octree->AutomaticBoundsOff();
  dinosaur.Octree->SetBounds(-0.1015, 0.0985, -0.1271, 0.0729, -0.7317, -0.5317);
  dinosaur.Octree->Update();
  EXPECT_LE(field(dinosaur.Octree->GetOutput(), "ViewTests"), 4.7e6);
  EXPECT_LT(field(dinosaur.Octree->GetOutput(), "IntersectionOctants"), 410050);
  EXPECT_GT(field(dinosaur.Octree->GetOutput(), "IntersectionOctants"), 300000);
  EXPECT_TRUE(listener.Errors.empty());
  ASSERT_EQ(listener.Warnings.size(), 1u) << "mirrored and not metric, said once";

  dinosaur.Octree->AutomaticBoundsOn();
  vtkNew<vtkVotingMarchingCubes> cubes;
  cubes->SetInputConnection(0, dinosaur.Octree->GetOutputPort(0));
  cubes->SetInputConnection(1, dinosaur.Octree->GetOutputPort(1));
  cubes->Update();
  double bounds[6];
  cubes->GetOutput()->GetBounds(bounds);
  const double longest =
    std::max({ bounds[1] - bounds[0], bounds[3] - bounds[2], bounds[5] - bounds[4] });
  const double edge = dinosaur.Octree->GetOutput()->GetFieldData()->GetArray("RootCube")->GetComponent(0, 3);
  EXPECT_LE(edge, 1.1 * longest);
  EXPECT_GT(edge, longest);
}
