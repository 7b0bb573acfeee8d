// SPDX-License-Identifier: BSD-3-Clause
#include "ColmapFiles.h"

#include "Error.h"
#include "TextParsing.h"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <fstream>
#include <optional>
#include <string_view>

namespace silhouette
{

namespace
{

namespace fs = std::filesystem;

/** At the place of the number that stands for it in binary files. */
constexpr std::array<ColmapModel, 12> Models = {{{"SIMPLE_PINHOLE", 3, 1, ColmapLens::Brown},
                                                 {"PINHOLE", 4, 2, ColmapLens::Brown},
                                                 {"SIMPLE_RADIAL", 4, 1, ColmapLens::Brown},
                                                 {"RADIAL", 5, 1, ColmapLens::Brown},
                                                 {"OPENCV", 8, 2, ColmapLens::Brown},
                                                 {"OPENCV_FISHEYE", 8, 2, ColmapLens::Fisheye},
                                                 {"FULL_OPENCV", 12, 2, ColmapLens::Brown},
                                                 {"FOV", 5, 2, ColmapLens::NotRead},
                                                 {"SIMPLE_RADIAL_FISHEYE", 4, 1, ColmapLens::Fisheye},
                                                 {"RADIAL_FISHEYE", 5, 1, ColmapLens::Fisheye},
                                                 {"THIN_PRISM_FISHEYE", 12, 2, ColmapLens::NotRead},
                                                 {"RAD_TAN_THIN_PRISM_FISHEYE", 16, 2, ColmapLens::NotRead}}};

/** Throws InvalidInput unless the model is read. `name` is what the file calls it. */
const ColmapModel* checkedModel(const ColmapModel* model, const std::string& name, const std::string& where, std::uint32_t camera)
{
  if (model && model->lens != ColmapLens::NotRead)
  {
    return model;
  }
  std::string read;
  for (const ColmapModel& known : Models)
  {
    read += known.lens == ColmapLens::NotRead ? "" : (read.empty() ? "" : ", ") + std::string(known.name);
  }
  throw InvalidInput(where + ": camera " + std::to_string(camera) + " has the model " + name + ", which is not read; " + read +
                     " are. COLMAP's image_undistorter makes images and cameras without a lens's distortion");
}

double finite(double value, const std::string& text, const std::string& where, const std::string& what)
{
  if (!std::isfinite(value))
  {
    throw InvalidInput(where + ": " + what + " is " + text + ", which is not a finite number");
  }
  return value;
}

double number(const std::string& text, const std::string& where, const std::string& what)
{
  return finite(parseFinite(text).value_or(std::nan("")), inQuotes(text), where, what);
}

std::uint32_t wholeNumber(const std::string& text, const std::string& where, const std::string& what)
{
  const std::optional<int> value = parseCount(text);
  if (!value)
  {
    throw InvalidInput(where + ": " + what + " is " + inQuotes(text) + ", which is not a whole number of at least 0");
  }
  return std::uint32_t(*value);
}

constexpr std::array<const char*, 7> PoseNames = {"QW", "QX", "QY", "QZ", "TX", "TY", "TZ"};

std::string poseName(std::size_t i, const std::string& image)
{
  return std::string(PoseNames[i]) + " of image " + inQuotes(image);
}

/** Lines of a text file of any length, one after another: images.txt holds the points that its images see. */
class LineReader
{
public:
  explicit LineReader(const fs::path& file)
      : File(file), Stream(file, std::ios::binary)
  {
    std::error_code error;
    if (!fs::is_regular_file(file, error))
    {
      throw InvalidInput(file.string() + ": there is no such file");
    }
    if (!this->Stream)
    {
      throw InvalidInput(file.string() + ": cannot be read");
    }
  }

  /** False where no line is left. */
  bool next()
  {
    constexpr std::size_t Longest = std::size_t(256) << 20;
    this->Line.clear();
    ++this->Number;
    std::streambuf& buffer = *this->Stream.rdbuf();
    int c = buffer.sbumpc();
    const bool isLeft = c != EOF;
    for (; c != EOF && c != '\n'; c = buffer.sbumpc())
    {
      if (c == 0 || this->Line.size() == Longest)
      {
        throw InvalidInput(this->where() + ": not a text file " + (c == 0 ? "(it holds a zero byte)" : "(a line of more than 256 MiB)"));
      }
      this->Line.push_back(char(c));
    }
    return isLeft;
  }

  /** The line's next word, without the blanks around it; empty where none is left. */
  static std::string_view takeWord(std::string_view& line)
  {
    const std::size_t first = std::min(line.find_first_not_of(Blanks), line.size());
    const std::size_t last = std::min(line.find_first_of(Blanks, first), line.size());
    const std::string_view word = line.substr(first, last - first);
    line.remove_prefix(last);
    return word;
  }

  std::string_view line() const { return this->Line; }
  int number() const { return this->Number; }
  std::string where() const { return this->File.string() + " line " + std::to_string(this->Number); }

  static constexpr const char* Blanks = " \t\r\v\f";

private:
  fs::path File;
  std::ifstream Stream;
  std::string Line;
  int Number = 0;
};

std::string_view trimmed(std::string_view text)
{
  const std::size_t first = std::min(text.find_first_not_of(LineReader::Blanks), text.size());
  const std::size_t last = text.find_last_not_of(LineReader::Blanks);
  return first == text.size() ? std::string_view() : text.substr(first, last + 1 - first);
}

/** An image's first line. */
ColmapImage imageOf(const LineReader& lines)
{
  std::string_view rest = lines.line();
  std::array<std::string, 9> words; // number, pose, camera
  for (std::string& word : words)
  {
    word = LineReader::takeWord(rest);
  }
  ColmapImage image;
  image.name = trimmed(rest); // with its blanks
  image.line = lines.number();
  image.where = lines.where();
  if (image.name.empty())
  {
    throw InvalidInput(image.where + ": expected number, quaternion (4), translation (3), camera and name of an image, found " +
                       inQuotes(lines.line()));
  }
  for (std::size_t i = 0; i < image.pose.size(); ++i)
  {
    image.pose[i] = number(words[i + 1], image.where, poseName(i, image.name));
  }
  image.camera = wholeNumber(words[8], image.where, "the camera of image " + inQuotes(image.name));
  return image;
}

/** An image's second line. That it holds points is seen by their number, and by the last word, which in a first line would be a name. */
void checkPoints(const LineReader& lines, const std::string& image)
{
  std::size_t count = 0;
  std::string_view rest = lines.line(), last;
  for (std::string_view word = LineReader::takeWord(rest); !word.empty(); word = LineReader::takeWord(rest))
  {
    ++count;
    last = word;
  }
  if (count % 3 != 0 || (count > 0 && !parseFinite(last)))
  {
    throw InvalidInput(lines.where() + ": expected the points of image " + inQuotes(image) +
                       ", x, y and number each, or an empty line; found " + inQuotes(lines.line()));
  }
}

/** A binary file's numbers, one after another. */
class ByteReader
{
public:
  explicit ByteReader(const fs::path& file)
      : File(file), Stream(file, std::ios::binary)
  {
    std::error_code error;
    if (!fs::is_regular_file(file, error))
    {
      throw InvalidInput(file.string() + ": there is no such file");
    }
    this->Left = fs::file_size(file, error);
    if (error || !this->Stream)
    {
      throw InvalidInput(file.string() + ": cannot be read");
    }
  }

  std::uint64_t unsignedNumber(int bytes)
  {
    std::array<unsigned char, 8> buffer{};
    this->take(std::uint64_t(bytes));
    this->Stream.read(reinterpret_cast<char*>(buffer.data()), bytes);
    if (!this->Stream)
    {
      throw InvalidInput(this->where() + ": cannot be read");
    }
    std::uint64_t value = 0;
    for (std::size_t i = buffer.size(); i-- > 0;)
    {
      value = value << 8 | buffer[i];
    }
    return value;
  }

  double real()
  {
    const std::uint64_t bits = this->unsignedNumber(8);
    double value;
    static_assert(sizeof(value) == sizeof(bits));
    std::memcpy(&value, &bits, sizeof(value));
    return value;
  }

  /** A number of things of at least so many bytes each. */
  std::uint64_t count(std::uint64_t least, const char* what)
  {
    const std::uint64_t found = this->unsignedNumber(8);
    if (found > this->Left / least)
    {
      throw InvalidInput(this->where() + ": announces " + std::to_string(found) + " " + what + ", but " + std::to_string(this->Left) +
                         " bytes are left");
    }
    return found;
  }

  /** Up to a zero byte. */
  std::string text()
  {
    constexpr std::size_t Longest = 65536; // a path is shorter
    std::string text;
    while (const auto c = char(this->unsignedNumber(1)))
    {
      if (text.size() == Longest)
      {
        throw InvalidInput(this->where() + ": its name " + inQuotes(text) + " is longer than " + std::to_string(Longest) + " bytes");
      }
      text.push_back(c);
    }
    return text;
  }

  void pass(std::uint64_t bytes)
  {
    this->take(bytes);
    this->Stream.seekg(std::streamoff(bytes), std::ios::cur);
  }

  void expectEnd()
  {
    if (this->Left > 0)
    {
      throw InvalidInput(this->File.string() + ": " + std::to_string(this->Left) + " bytes follow what it announces");
    }
  }

  /** What is read next, for messages: camera or image, from 1. */
  void enter(const char* what, std::uint64_t index) { this->Place = std::string(" ") + what + " " + std::to_string(index + 1); }
  std::string where() const { return this->File.string() + this->Place; }

private:
  void take(std::uint64_t bytes)
  {
    if (bytes > this->Left)
    {
      throw InvalidInput(this->where() + ": the file ends within it");
    }
    this->Left -= bytes;
  }

  fs::path File;
  std::ifstream Stream;
  std::uintmax_t Left = 0;
  std::string Place;
};

} // namespace

std::vector<ColmapCamera> readTextColmapCameras(const fs::path& file)
{
  std::vector<ColmapCamera> cameras;
  for (const TextLine& line : readTextLines(file))
  {
    ColmapCamera camera;
    camera.where = file.string() + " line " + std::to_string(line.number);
    if (line.tokens.size() < 4)
    {
      throw InvalidInput(camera.where + ": expected number, model, width, height and parameters of a camera, found " +
                         std::to_string(line.tokens.size()) + " words, the first " + inQuotes(line.tokens[0]));
    }
    camera.number = wholeNumber(line.tokens[0], camera.where, "the camera's number");
    const std::string& name = line.tokens[1];
    const auto model = std::find_if(Models.begin(), Models.end(), [&](const ColmapModel& known) { return name == known.name; });
    camera.model = checkedModel(model == Models.end() ? nullptr : &*model, inQuotes(name), camera.where, camera.number);
    const std::string of = " of camera " + std::to_string(camera.number);
    camera.width = wholeNumber(line.tokens[2], camera.where, "the width" + of);
    camera.height = wholeNumber(line.tokens[3], camera.where, "the height" + of);
    if (line.tokens.size() != 4 + std::size_t(camera.model->parameters))
    {
      throw InvalidInput(camera.where + ": camera " + std::to_string(camera.number) + " has " + std::to_string(line.tokens.size() - 4) +
                         " parameters; " + name + " has " + std::to_string(camera.model->parameters));
    }
    for (std::size_t i = 4; i < line.tokens.size(); ++i)
    {
      camera.parameters.push_back(number(line.tokens[i], camera.where, "parameter " + std::to_string(i - 3) + of));
    }
    cameras.push_back(std::move(camera));
  }
  return cameras;
}

std::vector<ColmapImage> readTextColmapImages(const fs::path& file)
{
  std::vector<ColmapImage> images;
  for (LineReader lines(file); lines.next();)
  {
    const std::string_view line = trimmed(lines.line());
    if (line.empty() || line[0] == '#')
    {
      continue;
    }
    images.push_back(imageOf(lines));
    if (lines.next())
    {
      checkPoints(lines, images.back().name);
    }
  }
  return images;
}

std::vector<ColmapCamera> readBinaryColmapCameras(const fs::path& file)
{
  constexpr std::uint64_t least = 4 + 4 + 8 + 8 + 3 * 8;
  ByteReader bytes(file);
  std::vector<ColmapCamera> cameras;
  const std::uint64_t count = bytes.count(least, "cameras");
  for (std::uint64_t n = 0; n < count; ++n)
  {
    ColmapCamera& camera = cameras.emplace_back();
    bytes.enter("camera", n);
    camera.where = bytes.where();
    camera.number = std::uint32_t(bytes.unsignedNumber(4));
    const std::uint64_t model = bytes.unsignedNumber(4);
    const ColmapModel* known = model < Models.size() ? &Models[std::size_t(model)] : nullptr;
    camera.model = checkedModel(known, known ? inQuotes(known->name) : "of number " + std::to_string(model), camera.where, camera.number);
    camera.width = bytes.unsignedNumber(8);
    camera.height = bytes.unsignedNumber(8);
    for (int i = 0; i < camera.model->parameters; ++i)
    {
      const double value = bytes.real();
      camera.parameters.push_back(finite(value, formatNumber(value), camera.where,
                                         "parameter " + std::to_string(i + 1) + " of camera " + std::to_string(camera.number)));
    }
  }
  bytes.expectEnd();
  return cameras;
}

std::vector<ColmapImage> readBinaryColmapImages(const fs::path& file)
{
  constexpr std::uint64_t least = 4 + 7 * 8 + 4 + 1 + 8, point = 24;
  ByteReader bytes(file);
  std::vector<ColmapImage> images;
  const std::uint64_t count = bytes.count(least, "images");
  for (std::uint64_t n = 0; n < count; ++n)
  {
    ColmapImage& image = images.emplace_back();
    bytes.enter("image", n);
    image.where = bytes.where();
    bytes.unsignedNumber(4);
    for (double& value : image.pose)
    {
      value = bytes.real();
    }
    image.camera = std::uint32_t(bytes.unsignedNumber(4));
    image.name = bytes.text();
    for (std::size_t i = 0; i < image.pose.size(); ++i)
    {
      finite(image.pose[i], formatNumber(image.pose[i]), image.where, poseName(i, image.name));
    }
    bytes.pass(point * bytes.count(point, "points"));
  }
  bytes.expectEnd();
  return images;
}

} // namespace silhouette
