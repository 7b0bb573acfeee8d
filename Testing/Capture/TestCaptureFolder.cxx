// SPDX-License-Identifier: BSD-3-Clause
#include "CaptureFolder.h"

#include "CaptureTesting.h"

using namespace silhouette;

namespace
{

const std::string P = " 1 0 0 0 0 1 0 0 0 0 1 0\n";
const std::string Krt = " 100 0 50 0 200 60 0 0 1  1 0 0 0 1 0 0 0 1  1 2 3\n";

std::vector<std::string> namesOf(const CaptureDescription& capture)
{
  std::vector<std::string> names;
  for (const CaptureEntry& entry : capture.entries)
  {
    names.push_back(entry.name);
  }
  return names;
}

CaptureOptions withViews(const std::string& views)
{
  CaptureOptions options;
  options.views = views;
  return options;
}

std::string errorIn(const TemporaryFolder& folder, const CaptureOptions& options = {})
{
  return errorOf([&] { describeCapture(folder.path(), options); });
}

/** COLMAP's text model of one image. */
void writeColmap(const TemporaryFolder& folder, const std::string& place, const std::string& image)
{
  folder.write(place + "cameras.txt", "1 SIMPLE_RADIAL 640 480 500 320 240 0.1\n");
  folder.write(place + "images.txt", "1 1 0 0 0 0 0 3 1 " + image + "\n\n");
}

/** transforms.json of one image. */
std::string transforms(const std::string& image, const std::string& keys = {})
{
  return R"({"fl_x": 500, "cx": 320, "cy": 240, "frames": [{"file_path": ")" + image + "\", " + keys +
         R"("transform_matrix": [[1,0,0,0],[0,1,0,0],[0,0,1,0]]}]})";
}

} // namespace

TEST(CaptureFolder, PhotographsInImagesMasksOfEqualStem)
{
  const TemporaryFolder folder;
  folder.write("projections.txt", "a.jpg" + P + "b.jpg" + P + "c.jpg" + P + "d.jpg" + P);
  for (const char* name : {"a", "b", "c", "d"})
  {
    folder.write(std::string("images/") + name + ".jpg");
  }
  folder.write("masks/a.png");
  folder.write("masks/b.jpg.png");
  folder.write("masks/c.pgm");
  folder.write("a.jpg"); // images/ goes first
  const CaptureDescription capture = describeCapture(folder.path());
  EXPECT_EQ(capture.folder, folder.path());
  EXPECT_EQ(capture.cameraFile, folder.path() / "projections.txt");
  EXPECT_EQ(capture.format, "P list");
  EXPECT_TRUE(capture.freeSign);
  EXPECT_TRUE(capture.warnings.empty());
  ASSERT_EQ(capture.entries.size(), 4u);
  EXPECT_EQ(capture.entries[0].photograph, folder.path() / "images" / "a.jpg");
  EXPECT_EQ(capture.entries[0].mask, folder.path() / "masks" / "a.png");
  EXPECT_EQ(capture.entries[1].mask, folder.path() / "masks" / "b.jpg.png");
  EXPECT_EQ(capture.entries[2].mask, folder.path() / "masks" / "c.pgm");
  EXPECT_TRUE(capture.entries[3].mask.empty());
  EXPECT_EQ(capture.entries[3].projection(2, 2), 1.0);
}

TEST(CaptureFolder, PhotographsBesideTheCameraFile)
{
  const TemporaryFolder folder;
  const auto file = folder.write("cameras.txt", "a.png" + P + "images/b.png" + P);
  folder.write("a.png");
  folder.write("images/b.png");
  folder.write("masks/b.png");
  const CaptureDescription capture = describeCapture(file);
  EXPECT_EQ(capture.cameraFile, file);
  EXPECT_EQ(capture.entries.at(0).photograph, folder.path() / "a.png");
  EXPECT_EQ(capture.entries.at(1).photograph, folder.path() / "images" / "b.png");
  EXPECT_EQ(capture.entries.at(1).mask, folder.path() / "masks" / "b.png");
  EXPECT_TRUE(capture.warnings.empty());
}

TEST(CaptureFolder, NamesThatLeadElsewhere)
{
  const TemporaryFolder folder, other;
  const std::string own = folder.path().string(), elsewhere = other.path().string();
  folder.write("projections.txt", own + "/images/a.png" + P + "./images/b.png" + P + "./c.png" + P + elsewhere + "/d.png" + P);
  for (const char* name : {"a", "b", "c"})
  {
    folder.write(std::string("images/") + name + ".png");
    folder.write(std::string("masks/") + name + ".png");
  }
  other.write("d.png");
  folder.write("masks/d.pgm");
  const CaptureDescription capture = describeCapture(folder.path());
  EXPECT_TRUE(capture.warnings.empty());
  for (int i = 0; i < 3; ++i)
  {
    const std::string name = std::string(1, char('a' + i)) + ".png";
    EXPECT_EQ(capture.entries.at(i).photograph, folder.path() / "images" / name);
    EXPECT_EQ(capture.entries.at(i).mask, folder.path() / "masks" / name);
  }
  EXPECT_EQ(capture.entries.at(3).photograph, other.path() / "d.png");
  EXPECT_EQ(capture.entries.at(3).mask, folder.path() / "masks" / "d.pgm") << "not the photograph itself";
}

TEST(CaptureFolder, MasksThatNoViewFinds)
{
  const TemporaryFolder folder;
  folder.write("projections.txt", "a.jpg" + P + "b.jpg" + P);
  folder.write("images/a.jpg");
  folder.write("images/b.jpg");
  folder.write("masks/a.png");
  EXPECT_TRUE(describeCapture(folder.path()).warnings.empty()) << "a view without a mask may be meant";
  folder.write("masks/b_mask.png");
  folder.write("masks/notes.txt");
  const CaptureDescription capture = describeCapture(folder.path());
  ASSERT_EQ(capture.warnings.size(), 1u);
  EXPECT_TRUE(holds(capture.warnings[0], "masks: 'b_mask.png' is the mask of no view, and view 'b.jpg' has none"));
  EXPECT_TRUE(describeCapture(folder.path(), withViews("0")).warnings.empty());
}

TEST(CaptureFolder, MasksOnly)
{
  const TemporaryFolder folder;
  folder.write("projections.txt", "a.jpg" + P);
  folder.write("masks/a.png");
  const CaptureDescription capture = describeCapture(folder.path());
  EXPECT_TRUE(capture.entries.at(0).photograph.empty());
  EXPECT_EQ(capture.entries.at(0).mask, folder.path() / "masks" / "a.png");
}

TEST(CaptureFolder, MiddleburyAndItsGoodSilhouettes)
{
  const TemporaryFolder folder;
  folder.write("x_par.txt", "3\r\na.png" + Krt + "b.png" + Krt + "c.png" + Krt);
  for (const char* name : {"a.png", "b.png", "c.png"})
  {
    folder.write(name);
  }
  EXPECT_EQ(namesOf(describeCapture(folder.path())), (std::vector<std::string>{"a.png", "b.png", "c.png"}));
  folder.write("x_good_silhouette_images.txt", "c.png\r\na.png\r\n");
  const CaptureDescription capture = describeCapture(folder.path());
  EXPECT_EQ(capture.format, "Middlebury");
  EXPECT_FALSE(capture.freeSign);
  EXPECT_EQ(namesOf(capture), (std::vector<std::string>{"a.png", "c.png"}));
  EXPECT_EQ(namesOf(describeCapture(folder.path(), withViews("1-2"))),
            (std::vector<std::string>{"b.png", "c.png"}));
  folder.write("x_good_silhouette_images.txt", "a.png c.png\n");
  EXPECT_EQ(namesOf(describeCapture(folder.path())), (std::vector<std::string>{"a.png", "c.png"})) << "several on a line";
  folder.write("x_good_silhouette_images.txt", "a.png\n\nz.png\n");
  EXPECT_TRUE(
      holds(errorIn(folder), "x_good_silhouette_images.txt line 3: 'z.png' is not a view of x_par.txt"));
  folder.write("x_good_silhouette_images.txt", "\n");
  EXPECT_TRUE(holds(errorIn(folder), "x_good_silhouette_images.txt: names no view"));
}

TEST(CaptureFolder, CornerFamilyMovesByHalfAPixel)
{
  const TemporaryFolder folder;
  folder.write("x_par.txt", "1\na.png" + Krt);
  folder.write("a.png");
  CaptureOptions options;
  const Projection integer = describeCapture(folder.path(), options).entries.at(0).projection;
  options.cornerFamily = true;
  const Projection corner = describeCapture(folder.path(), options).entries.at(0).projection;
  EXPECT_EQ(integer(0, 2), 50.0);
  EXPECT_EQ(corner, cornerToInteger(integer));
}

TEST(CaptureFolder, CameraFileIsLookedFor)
{
  const TemporaryFolder folder;
  EXPECT_TRUE(holds(errorIn(folder),
                    ": no camera file; looked for projections.txt (a P list), *_par.txt (Middlebury), transforms.json, transforms_train.json (NeRF, nerfstudio), "
                    "cameras and images, .bin or .txt, in it, in its sparse or sparse/0 (COLMAP), cameras.yml, .yaml, .xml or .json (OpenCV), *.xml (Metashape), "
                    "txt/00000000.txt (PMVS), cameras_sphere.npz, cameras.npz (NeuS, IDR)"));
  folder.write("b_par.txt", "1\na.png" + Krt);
  folder.write("a_par.txt", "1\na.png" + Krt);
  EXPECT_TRUE(
      holds(errorIn(folder), "several of *_par.txt (Middlebury): a_par.txt, b_par.txt; and no projections.txt (a P list); give the camera file itself"));
  folder.write("a.png");
  EXPECT_EQ(describeCapture(folder.path() / "b_par.txt").entries.size(), 1u);
  folder.write("projections.txt", "a.png" + P);
  EXPECT_EQ(describeCapture(folder.path()).format, "P list");
  EXPECT_TRUE(holds(errorOf([&] { describeCapture(folder.path() / "none"); }),
                    "none: there is no such folder or camera file"));
}

TEST(CaptureFolder, OtherProgramsAreLookedForInOrder)
{
  const TemporaryFolder folder;
  for (const char* name : {"a.png", "b.png", "c.png", "d.png", "e.png", "images/f.jpg", "masks/f.jpg.png"})
  {
    folder.write(name);
  }
  const auto found = [&] { return std::pair(describeCapture(folder.path()).format, describeCapture(folder.path()).entries.at(0).name); };
  writeColmap(folder, "sparse/0/", "f.jpg");
  const CaptureDescription capture = describeCapture(folder.path());
  EXPECT_EQ(capture.format, "COLMAP");
  EXPECT_FALSE(capture.freeSign);
  EXPECT_EQ(capture.folder, folder.path());
  EXPECT_EQ(capture.cameraFile, folder.path() / "sparse/0/images.txt");
  EXPECT_EQ(capture.entries.at(0).photograph, folder.path() / "images/f.jpg");
  EXPECT_EQ(capture.entries.at(0).mask, folder.path() / "masks/f.jpg.png");
  EXPECT_EQ(capture.entries.at(0).width, 640);
  EXPECT_EQ(capture.entries.at(0).height, 480);
  EXPECT_EQ(capture.entries.at(0).lens.value().coefficients[0], 0.1);
  writeColmap(folder, "sparse/", "e.png");
  EXPECT_EQ(found(), std::pair(std::string("COLMAP"), std::string("e.png")));
  writeColmap(folder, "", "d.png");
  EXPECT_EQ(found(), std::pair(std::string("COLMAP"), std::string("d.png")));
  folder.write("transforms_train.json", transforms("c"));
  EXPECT_EQ(found(), std::pair(std::string("transforms.json"), std::string("c.png")));
  folder.write("transforms.json", transforms("b"));
  EXPECT_EQ(found(), std::pair(std::string("transforms.json"), std::string("b.png")));
  folder.write("a_par.txt", "1\na.png" + Krt);
  EXPECT_EQ(found(), std::pair(std::string("Middlebury"), std::string("a.png")));
}

TEST(CaptureFolder, ColmapModelsByTheirOwnPaths)
{
  const TemporaryFolder folder;
  writeColmap(folder, "sparse/1/", "a.png");
  folder.write("images/a.png");
  for (const char* path : {"sparse/1", "sparse/1/", "sparse/1/cameras.txt", "sparse/1/images.txt"})
  {
    const CaptureDescription capture = describeCapture(folder.path() / path);
    EXPECT_EQ(capture.folder, folder.path()) << path;
    EXPECT_EQ(capture.entries.at(0).photograph, folder.path() / "images/a.png") << path;
  }
  writeColmap(folder, "sparse/1/", "b.png");
  EXPECT_TRUE(holds(errorOf([&] { describeCapture(folder.path() / "sparse/1/cameras.txt"); }),
                    "sparse/1/images.txt line 1: image 'b.png' is missing: neither in " + folder.path().string() + " nor"))
      << "the file that names it";
  folder.write("images/b.png");
  const std::vector<std::filesystem::path> files = captureFiles(folder.path() / "sparse/1");
  for (const char* file : {"sparse/1/cameras.txt", "sparse/1/images.txt", "images/b.png"})
  {
    EXPECT_GE(std::count(files.begin(), files.end(), folder.path() / file), 1) << file;
  }
}

TEST(CaptureFolder, FamiliesThatAreStated)
{
  const TemporaryFolder folder;
  folder.write("a.png");
  CaptureOptions options;
  options.cornerFamily = true;
  folder.write("transforms.json", transforms("a"));
  EXPECT_TRUE(holds(errorIn(folder, options), "transforms.json: its format, transforms.json, states its pixel family, corner; the corner family is a choice for formats that state none"));
  writeColmap(folder, "sparse/", "a.png");
  EXPECT_TRUE(holds(errorOf([&] { describeCapture(folder.path() / "sparse", options); }), "sparse/images.txt: its format, COLMAP, states its pixel family, corner; "));
}

TEST(CaptureFolder, MasksThatTheCameraFileNames)
{
  const TemporaryFolder folder;
  folder.write("transforms.json", transforms("images/a.jpg", "\"mask_path\": \"./m/x.png\", "));
  folder.write("images/a.jpg");
  folder.write("masks/a.png");
  EXPECT_TRUE(holds(errorIn(folder), "transforms.json frame 0, 'images/a.jpg': the mask './m/x.png' of view 'images/a.jpg' is missing: there is no " +
                                         (folder.path() / "m/x.png").string()));
  EXPECT_EQ(captureViewNames(folder.path()), std::vector<std::string>{"images/a.jpg"});
  folder.write("m/x.png");
  EXPECT_EQ(describeCapture(folder.path()).entries.at(0).mask, folder.path() / "m/x.png") << "not that of its stem";
  const std::vector<std::filesystem::path> files = captureFiles(folder.path());
  EXPECT_EQ(std::count(files.begin(), files.end(), folder.path() / "m/x.png"), 1);
}

TEST(CaptureFolder, ImageSizesThatTheCameraFileDoesNotSay)
{
  const TemporaryFolder folder;
  const std::string pose = R"("transform_matrix": [[1,0,0,0],[0,1,0,0],[0,0,1,0]]}]})";
  folder.write("transforms.json", R"({"camera_angle_x": 1.5, "frames": [{"file_path": "train/r_0", )" + pose);
  folder.write("train/r_0.png");
  EXPECT_TRUE(holds(errorIn(folder), "transforms.json frame 0, 'train/r_0.png': the camera file does not say the image's size"));
  EXPECT_EQ(captureViewNames(folder.path()), std::vector<std::string>{"train/r_0.png"}) << "names need no size";
  EXPECT_EQ(captureFiles(folder.path()).size(), 2u);
  CaptureOptions options;
  options.sizeOf = [&](const std::filesystem::path& file)
  {
    EXPECT_EQ(file, folder.path() / "train/r_0.png");
    return std::array<int, 2>{200, 100};
  };
  const Projection projection = describeCapture(folder.path(), options).entries.at(0).projection;
  EXPECT_NEAR(projection(0, 0), 100.0 / std::tan(0.75), 1e-9);
  EXPECT_NEAR(projection(0, 2), -99.5, 1e-9) << "the camera looks along -z";
  EXPECT_NEAR(projection(1, 2), -49.5, 1e-9);
}

TEST(CaptureFolder, MissingImages)
{
  const TemporaryFolder folder;
  folder.write("projections.txt", "a.png" + P + "b.png" + P);
  folder.write("images/a.png");
  const std::string error = errorIn(folder);
  EXPECT_TRUE(holds(error, "projections.txt line 2: image 'b.png' is missing"));
  EXPECT_TRUE(holds(error, folder.path().string()));
  EXPECT_EQ(namesOf(describeCapture(folder.path(), withViews("a"))), std::vector<std::string>{"a.png"})
      << "views that are not used need no image";
  std::filesystem::create_directories(folder.path() / "images" / "b.png");
  EXPECT_TRUE(holds(errorIn(folder), "'b.png' is missing")) << "a folder is no image";
}

TEST(CaptureFolder, SharedMasksAndRank)
{
  const TemporaryFolder folder;
  folder.write("projections.txt", "a.png" + P + "a.jpg" + P);
  folder.write("a.png");
  folder.write("a.jpg");
  folder.write("masks/a.bmp");
  EXPECT_TRUE(holds(errorIn(folder), "a.bmp: would be the mask of both view 'a.png' and view 'a.jpg'"));
  folder.write("projections.txt", "a.png" + P + "a.jpg 1 0 0 0 2 0 0 0 0 0 1 0");
  EXPECT_TRUE(holds(errorIn(folder),
                    "projections.txt line 2: the projection of view 'a.jpg' has rank 2; a camera needs 3"));
}

TEST(CaptureFolder, TwoMasksOfAView)
{
  const TemporaryFolder folder;
  folder.write("projections.txt", "a.png" + P + "b.png" + P);
  folder.write("images/a.png");
  folder.write("images/b.png");
  folder.write("masks/a.png");
  const std::filesystem::path masks = folder.path() / "masks";
  for (const char* other : {"a.jpg", "a.png.png", "a.pgm"})
  {
    folder.write(std::string("masks/") + other);
    EXPECT_TRUE(holds(errorIn(folder), (masks / "a.png").string() + " and " + (masks / other).string() +
                                           ": either would be the mask of view 'a.png'"));
    EXPECT_EQ(describeCapture(folder.path(), withViews("b.png")).entries.size(), 1u) << "a view that is not used may";
    std::filesystem::remove(masks / other);
  }
  folder.write("masks/a.txt");
  EXPECT_EQ(describeCapture(folder.path()).entries.at(0).mask, masks / "a.png");

  // Views of equal stem have masks of equal stem.
  folder.write("projections.txt", "a.png" + P + "a.jpg" + P);
  folder.write("images/a.jpg");
  folder.write("masks/a.jpg");
  const CaptureDescription capture = describeCapture(folder.path());
  EXPECT_EQ(capture.entries.at(0).mask, masks / "a.png");
  EXPECT_EQ(capture.entries.at(1).mask, masks / "a.jpg");
  EXPECT_EQ(describeCapture(folder.path(), withViews("a.png")).entries.size(), 1u);
}

TEST(CaptureFolder, ImagesThatNoLineNames)
{
  const TemporaryFolder folder;
  folder.write("projections.txt", "a.png" + P + "images/b.png" + P + "c" + P);
  folder.write("images/a.png");
  folder.write("images/b.png");
  folder.write("images/c.jpg");
  folder.write("images/readme.txt");
  EXPECT_TRUE(describeCapture(folder.path(), withViews("0")).warnings.empty());
  folder.write("images/z.JPG");
  auto warnings = describeCapture(folder.path()).warnings;
  ASSERT_EQ(warnings.size(), 1u);
  EXPECT_TRUE(holds(warnings[0], "1 image is not named in projections.txt and not used: 'z.JPG'"));
  folder.write("images/y.png");
  warnings = describeCapture(folder.path()).warnings;
  ASSERT_EQ(warnings.size(), 1u) << "one for a capture";
  EXPECT_TRUE(
      holds(warnings[0], "2 images are not named in projections.txt and not used: 'y.png' and others"));
}

TEST(CaptureFolder, SeveralListsOfGoodSilhouettes)
{
  const TemporaryFolder folder;
  folder.write("projections.txt", "a.png" + P);
  folder.write("a.png");
  folder.write("p_good_silhouette_images.txt", "a.png");
  EXPECT_EQ(describeCapture(folder.path()).entries.size(), 1u);
  folder.write("q_good_silhouette_images.txt", "a.png");
  EXPECT_TRUE(
      holds(errorIn(folder), "several of *_good_silhouette_images.txt (p_good_silhouette_images.txt, q_"));
  EXPECT_EQ(describeCapture(folder.path(), withViews("0")).entries.size(), 1u);
}

TEST(CaptureFolder, RealRing)
{
  const auto folder = realCapture("middlebury-dino-sparse-ring");
  SKIP_WITHOUT(folder);
  const CaptureDescription capture = describeCapture(folder);
  EXPECT_EQ(capture.entries.size(), 15u);
  for (const std::string& name : namesOf(capture))
  {
    EXPECT_NE(name, "dinoSR0006.png");
  }
  EXPECT_EQ(describeCapture(folder, withViews("0-15")).entries.size(), 16u);
  EXPECT_TRUE(capture.warnings.empty());
  // The middle of the published tight box falls well inside every image.
  const Eigen::Vector4d middle(-0.0255, 0.0246765, -0.021175, 1.0);
  for (const CaptureEntry& entry : capture.entries)
  {
    const Vector3 h = entry.projection * middle;
    EXPECT_GT(h.z(), 0.0);
    EXPECT_NEAR(h.x() / h.z(), 320, 160);
    EXPECT_NEAR(h.y() / h.z(), 240, 120);
  }
}

TEST(CaptureFolder, RealTurntable)
{
  const auto folder = realCapture("vgg-dinosaur");
  SKIP_WITHOUT(folder);
  const CaptureDescription capture = describeCapture(folder);
  EXPECT_EQ(capture.entries.size(), 36u);
  EXPECT_EQ(capture.entries[35].name, "viff.035.png");
  EXPECT_EQ(capture.entries[35].photograph, folder / "viff.035.png");
  EXPECT_EQ(capture.entries[0].projection(0, 0), 3.9923568756416135);
  EXPECT_EQ(capture.entries[0].projection(2, 3), 0.012249358697517865);
}
