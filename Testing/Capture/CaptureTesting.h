// SPDX-License-Identifier: BSD-3-Clause
/** What the tests of this room share: a folder that goes away, error texts, random images, the real captures.
 */
#pragma once

#include "Error.h"
#include "View.h"

#include <gtest/gtest.h>

#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <random>
#include <string>

namespace silhouette
{

/** An empty folder of the running test's own, removed at the end. */
class TemporaryFolder
{
public:
  TemporaryFolder()
  {
    const auto* test = testing::UnitTest::GetInstance()->current_test_info();
    const std::string name = std::string("silhouette-") + test->test_suite_name() + "-" + test->name() + "-" +
                             std::to_string(std::random_device{}());
    this->Path = std::filesystem::temp_directory_path() / name;
    std::filesystem::create_directories(this->Path);
  }
  ~TemporaryFolder()
  {
    std::error_code error;
    std::filesystem::remove_all(this->Path, error);
  }
  TemporaryFolder(const TemporaryFolder&) = delete;
  void operator=(const TemporaryFolder&) = delete;

  const std::filesystem::path& path() const { return this->Path; }

  /** Write a file, making the folders that lead to it. */
  std::filesystem::path write(const std::string& name, const std::string& bytes = "x") const
  {
    const std::filesystem::path file = this->Path / name;
    std::filesystem::create_directories(file.parent_path());
    std::ofstream(file, std::ios::binary) << bytes;
    return file;
  }

private:
  std::filesystem::path Path;
};

/** The text of the InvalidInput that `call` throws; empty, with a failure, where it throws none. */
template <typename Call> std::string errorOf(Call&& call)
{
  try
  {
    call();
  }
  catch (const InvalidInput& error)
  {
    return error.what();
  }
  ADD_FAILURE() << "no InvalidInput was thrown";
  return {};
}

/** Whether `text` holds `part`; prints the text where not. */
inline testing::AssertionResult holds(const std::string& text, const std::string& part)
{
  return text.find(part) != std::string::npos
             ? testing::AssertionSuccess()
             : testing::AssertionFailure() << "'" << part << "' is not in: " << text;
}

inline BinaryImage emptyImage(int width, int height)
{
  return {width, height, std::vector<std::uint8_t>(std::size_t(width) * std::size_t(height), 0)};
}

/** Each pixel is object with the given chance. */
inline BinaryImage randomImage(int width, int height, double share, unsigned seed)
{
  std::mt19937 generator(seed);
  std::bernoulli_distribution object(share);
  BinaryImage image = emptyImage(width, height);
  for (auto& pixel : image.pixels)
  {
    pixel = object(generator) ? 1 : 0;
  }
  return image;
}

/** An image from rows of text: `#` is object. */
inline BinaryImage drawn(const std::vector<std::string>& rows)
{
  BinaryImage image = emptyImage(int(rows[0].size()), int(rows.size()));
  for (std::size_t i = 0; i < image.pixels.size(); ++i)
  {
    image.pixels[i] = rows[i / rows[0].size()][i % rows[0].size()] == '#' ? 1 : 0;
  }
  return image;
}

inline std::vector<std::string> rowsOf(const BinaryImage& image)
{
  std::vector<std::string> rows(std::size_t(image.height), std::string(std::size_t(image.width), '.'));
  for (int row = 0; row < image.height; ++row)
  {
    for (int column = 0; column < image.width; ++column)
    {
      rows[std::size_t(row)][std::size_t(column)] = image.at(column, row) ? '#' : '.';
    }
  }
  return rows;
}

/** A folder of real captures; empty where there is none. */
inline std::filesystem::path realCapture(const std::string& name)
{
  const char* other = std::getenv("SILHOUETTE_REAL_DATA");
  const std::filesystem::path folder = std::filesystem::path(other ? other : SILHOUETTE_SHARED_DATA) / name;
  std::error_code error;
  return std::filesystem::is_directory(folder, error) ? folder : std::filesystem::path();
}

} // namespace silhouette

/** Leave a test that needs a real capture which is not there. */
#define SKIP_WITHOUT(folder)                                                                                 \
  if ((folder).empty())                                                                                      \
  {                                                                                                          \
    GTEST_SKIP() << "the real captures are not here (SILHOUETTE_REAL_DATA, or ../shared/data)";              \
  }
