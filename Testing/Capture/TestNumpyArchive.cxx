// SPDX-License-Identifier: BSD-3-Clause
#include "NumpyArchive.h"

#include "CaptureTesting.h"
#include "NumpyArchiveTesting.h"

#include <random>

using namespace silhouette;

namespace
{

const auto All = [](const std::string&) { return true; };

std::map<std::string, NumpyArray> readBytes(const std::string& bytes)
{
  const TemporaryFolder folder;
  return readNumpyArchive(folder.write("a.npz", bytes), All);
}

/** Without the folder. */
std::string archiveError(const std::string& bytes)
{
  const std::string error = errorOf([&] { readBytes(bytes); });
  return error.substr(std::min(error.find("a.npz"), error.size()));
}

std::string arrayError(const std::string& npy)
{
  return archiveError(zipBytes({ { "m.npy", npy } }));
}

const std::vector<double> Values = { 1.5, -2.25, 3, 4, 0.0009765625, -6 }; // exact in float32

} // namespace

TEST(NumpyArchive, EveryKindOfNumber)
{
  for (const char* type : { "<f8", ">f8", "<f4", ">f4" })
  {
    for (const bool isDeflated : { false, true })
    {
      for (const int version : { 1, 2, 3 })
      {
        const std::string npy = npyBytes(type, "False", "(2, 3)", encodedNumbers(Values, type), version);
        const auto arrays = readBytes(zipBytes({ { "m.npy", npy, isDeflated } }));
        EXPECT_EQ(arrays.at("m").shape, (std::vector<std::size_t>{ 2, 3 }));
        EXPECT_EQ(arrays.at("m").values, Values) << type << isDeflated << version;
      }
    }
  }
}

TEST(NumpyArchive, FortranOrder)
{
  const std::vector<double> columns = { 1.5, 4, -2.25, 0.0009765625, 3, -6 };
  const auto arrays = readBytes(zipBytes({ { "m.npy", npyBytes("<f8", "True", "(2, 3)", encodedNumbers(columns, "<f8")) } }));
  EXPECT_EQ(arrays.at("m").values, Values);
  // Three axes: the value at (i, j, k) is 100 i + 10 j + k.
  std::vector<double> first, last;
  for (int n = 0; n < 24; ++n)
  {
    first.push_back(n % 2 * 100 + n / 2 % 3 * 10 + n / 6);
    last.push_back(n / 12 * 100 + n / 4 % 3 * 10 + n % 4);
  }
  const auto three = readBytes(zipBytes({ { "m.npy", npyBytes("<f8", "True", "(2, 3, 4)", encodedNumbers(first, "<f8")) } }));
  EXPECT_EQ(three.at("m").values, last);
}

TEST(NumpyArchive, Shapes)
{
  const std::string one = encodedNumbers({ 7 }, "<f8");
  EXPECT_TRUE(readBytes(zipBytes({ { "m.npy", npyBytes("<f8", "False", "()", one) } })).at("m").shape.empty());
  EXPECT_EQ(readBytes(zipBytes({ { "m.npy", npyBytes("<f8", "False", "(1,)", one) } })).at("m").shape, std::vector<std::size_t>{ 1 });
  EXPECT_TRUE(readBytes(zipBytes({ { "m.npy", npyBytes("<f8", "False", "(0, 4)", "") } })).at("m").values.empty());
}

/** As numpy 1.24 writes numpy.savez_compressed(file, a=numpy.array([[1.0, 2.5]]), b=numpy.array([3], dtype=">f4")). */
TEST(NumpyArchive, WrittenByNumpy)
{
  const std::vector<unsigned char> bytes = {
    80, 75, 3, 4, 20, 0, 0, 0, 8, 0, 0, 0, 33, 0, 165, 222, 178, 228, 78, 0, 0, 0, 144, 0, 0, 0, 5, 0, 20, 0, 97, 46, 110, 112, 121, 1, 0, 16, 0, 144, 0,
    0, 0, 0, 0, 0, 0, 78, 0, 0, 0, 0, 0, 0, 0, 155, 236, 23, 234, 27, 16, 201, 200, 80, 198, 80, 173, 158, 146, 90, 156, 92, 164, 110, 165, 160, 110, 147,
    102, 161, 174, 163, 160, 158, 150, 95, 84, 82, 148, 152, 23, 159, 95, 148, 146, 10, 18, 119, 75, 204, 41, 78, 5, 138, 23, 103, 36, 22, 164, 2, 249,
    26, 134, 58, 10, 70, 154, 58, 10, 181, 10, 100, 3, 46, 6, 48, 248, 96, 15, 161, 89, 28, 0, 80, 75, 3, 4, 20, 0, 0, 0, 8, 0, 0, 0, 33, 0, 199, 241, 48,
    227, 72, 0, 0, 0, 132, 0, 0, 0, 5, 0, 20, 0, 98, 46, 110, 112, 121, 1, 0, 16, 0, 132, 0, 0, 0, 0, 0, 0, 0, 72, 0, 0, 0, 0, 0, 0, 0, 155, 236, 23, 234,
    27, 16, 201, 200, 80, 198, 80, 173, 158, 146, 90, 156, 92, 164, 110, 165, 160, 110, 151, 102, 162, 174, 163, 160, 158, 150, 95, 84, 82, 148, 152, 23,
    159, 95, 148, 146, 10, 18, 119, 75, 204, 41, 78, 5, 138, 23, 103, 36, 22, 164, 2, 249, 26, 134, 58, 154, 58, 10, 181, 10, 20, 0, 46, 7, 7, 6, 6, 0,
    80, 75, 1, 2, 20, 3, 20, 0, 0, 0, 8, 0, 0, 0, 33, 0, 165, 222, 178, 228, 78, 0, 0, 0, 144, 0, 0, 0, 5, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 128, 1, 0, 0,
    0, 0, 97, 46, 110, 112, 121, 80, 75, 1, 2, 20, 3, 20, 0, 0, 0, 8, 0, 0, 0, 33, 0, 199, 241, 48, 227, 72, 0, 0, 0, 132, 0, 0, 0, 5, 0, 0, 0, 0, 0, 0,
    0, 0, 0, 0, 0, 128, 1, 133, 0, 0, 0, 98, 46, 110, 112, 121, 80, 75, 5, 6, 0, 0, 0, 0, 2, 0, 2, 0, 102, 0, 0, 0, 4, 1, 0, 0, 0, 0 };
  const auto arrays = readBytes(std::string(bytes.begin(), bytes.end()));
  EXPECT_EQ(arrays.at("a").values, (std::vector<double>{ 1, 2.5 }));
  EXPECT_EQ(arrays.at("a").shape, (std::vector<std::size_t>{ 1, 2 }));
  EXPECT_EQ(arrays.at("b").values, std::vector<double>{ 3 });
}

TEST(NumpyArchive, OthersAreNotUnpacked)
{
  const TemporaryFolder folder;
  const auto file = folder.write("a.npz", zipBytes({ { "photo.npy", "garbage" }, { "readme.txt", "text" }, { "m.npy", npyMatrix(std::vector<double>(16, 2)) } }));
  const auto arrays = readNumpyArchive(file, [](const std::string& name) { return name == "m"; });
  EXPECT_EQ(arrays.size(), 1u);
  EXPECT_EQ(arrays.at("m").values.size(), 16u);
}

TEST(NumpyArchive, DamagedArchives)
{
  const std::string npy = npyMatrix(std::vector<double>(16, 2));
  const std::string zip = zipBytes({ { "m.npy", npy } });
  EXPECT_EQ(archiveError(""), "a.npz: is no zip file, or cut off");
  EXPECT_EQ(archiveError("PK\x03\x04 and no more of it than that"), "a.npz: is no zip file, or cut off");
  EXPECT_EQ(archiveError(zip.substr(0, zip.size() - 1)), "a.npz: is no zip file, or cut off");
  EXPECT_EQ(archiveError(zip.substr(zip.size() - 22)), "a.npz: is cut off or damaged (4 bytes at " + std::to_string(zip.size() - 22 - 51) + " of 22)");
  const auto changed = [&](std::size_t at, const std::string& bytes) { return std::string(zip).replace(at, bytes.size(), bytes); };
  const std::size_t directory = zip.size() - 22 - 51, end = zip.size() - 22;
  EXPECT_EQ(archiveError(changed(directory, "x")), "a.npz: its directory is damaged at entry 0");
  EXPECT_EQ(archiveError(changed(end + 16, "\xFF\xFF\xFF\xFF")), "a.npz: is a zip64 file, which is not read");
  EXPECT_EQ(archiveError(changed(directory + 8, "\x01")), "a.npz array 'm': is encrypted");
  EXPECT_EQ(archiveError(changed(directory + 10, "\x0C")), "a.npz array 'm': is packed with method 12; stored and deflated arrays are read");
  EXPECT_EQ(archiveError(changed(directory + 24, "\xFF\xFF\xFF\x7F")),
            "a.npz array 'm': 2147483647 bytes are too many for a camera's array (at most 64 KiB)");
  EXPECT_EQ(archiveError(changed(directory + 24, "\x07")), "a.npz array 'm': is damaged");
  EXPECT_EQ(archiveError(changed(directory + 42, "\x05")), "a.npz array 'm': is not where the directory says");
  EXPECT_EQ(archiveError(changed(directory - 4, "\x01")), "a.npz array 'm': is damaged"); // a bit of the data, seen by the CRC
  EXPECT_EQ(archiveError(zipBytes({ { "m.npy", npy }, { "m.npy", npy } })), "a.npz array 'm': occurs twice");
}

TEST(NumpyArchive, WrongArrays)
{
  const std::string data = encodedNumbers({ 1, 2 }, "<f8");
  EXPECT_EQ(arrayError("text"), "a.npz array 'm': is not of numpy's format");
  EXPECT_EQ(arrayError("\x93NUMPY\x01"), "a.npz array 'm': is cut off or damaged (2 bytes at 8 of 7)");
  EXPECT_EQ(arrayError(npyBytes("<i8", "False", "(2,)", data)), "a.npz array 'm': is of the type ''<i8''; float32 and float64 are read");
  EXPECT_EQ(arrayError(npyBytes("<f8", "False", "(3,)", data)), "a.npz array 'm': the shape asks for 3 numbers, but 16 bytes follow");
  EXPECT_EQ(arrayError(npyBytes("<f8", "False", "(2000000000, 2000000000, 2000000000)", data)),
            "a.npz array 'm': the shape asks for 8e+27 numbers, but 16 bytes follow");
  EXPECT_EQ(arrayError(npyBytes("<f8", "False", "(2, -1)", data)), "a.npz array 'm': '-1' in the shape in numpy's header is no whole number");
  EXPECT_EQ(arrayError(npyBytes("<f8", "False", "2", data)), "a.npz array 'm': the shape in numpy's header is no tuple");
  EXPECT_EQ(arrayError("\x93NUMPY\x01" + std::string(1, '\0') + littleEndian(2, 2) + "{}"), "a.npz array 'm': numpy's header has no 'descr'");
}

TEST(NumpyArchive, GarbageIsRefusedNotObeyed)
{
  const std::string whole = zipBytes({ { "m.npy", npyMatrix(std::vector<double>(16, 2)), true } });
  for (std::size_t size = 0; size < whole.size(); ++size)
  {
    EXPECT_FALSE(archiveError(whole.substr(0, size)).empty());
  }
  std::mt19937 generator(3);
  for (int trial = 0; trial < 2000; ++trial)
  {
    std::string bytes = whole;
    for (int n = 0; n < 1 + trial % 4; ++n)
    {
      bytes[generator() % bytes.size()] = char(generator());
    }
    try
    {
      readBytes(bytes);
    }
    catch (const InvalidInput&)
    {
    }
  }
}
