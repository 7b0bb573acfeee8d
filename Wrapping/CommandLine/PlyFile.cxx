// SPDX-License-Identifier: BSD-3-Clause
#include "PlyFile.h"

#include "ExitCodes.h"

#include "vtkCellArray.h"
#include "vtkNew.h"
#include "vtkPoints.h"
#include "vtkPolyData.h"

#include <algorithm>
#include <array>
#include <charconv>
#include <cstdint>
#include <cstring>
#include <fstream>
#include <iterator>
#include <map>
#include <sstream>
#include <string>
#include <vector>

namespace silhouette::program
{
namespace
{

/** How a number is stored. */
struct PlyType
{
  int size = 0;    ///< bytes; 0: no such type
  char kind = 'u'; ///< 'i'nteger with a sign, 'u' without, 'f'loating
};

PlyType typeOf(const std::string& name)
{
  static const std::map<std::string, PlyType> types = { { "char", { 1, 'i' } }, { "int8", { 1, 'i' } }, { "uchar", { 1, 'u' } },
    { "uint8", { 1, 'u' } }, { "short", { 2, 'i' } }, { "int16", { 2, 'i' } }, { "ushort", { 2, 'u' } }, { "uint16", { 2, 'u' } },
    { "int", { 4, 'i' } }, { "int32", { 4, 'i' } }, { "uint", { 4, 'u' } }, { "uint32", { 4, 'u' } }, { "float", { 4, 'f' } },
    { "float32", { 4, 'f' } }, { "double", { 8, 'f' } }, { "float64", { 8, 'f' } } };
  const auto found = types.find(name);
  return found != types.end() ? found->second : PlyType();
}

struct PlyProperty
{
  std::string name;
  bool isList = false;
  PlyType count; ///< of a list's length
  PlyType value;
};

struct PlyElement
{
  std::string name;
  std::size_t count = 0;
  std::vector<PlyProperty> properties;

  /** Place of a property, or -1. */
  int find(const std::string& property) const
  {
    const auto found =
      std::find_if(this->properties.begin(), this->properties.end(), [&](const PlyProperty& one) { return one.name == property; });
    return found != this->properties.end() ? int(found - this->properties.begin()) : -1;
  }
};

/** The whole of a file, read from its beginning to its end. */
class PlyFile
{
public:
  explicit PlyFile(const std::filesystem::path& file)
    : File(file)
  {
    std::ifstream stream(file, std::ios::binary);
    this->Content.assign(std::istreambuf_iterator<char>(stream), std::istreambuf_iterator<char>());
  }

  vtkSmartPointer<vtkPolyData> read()
  {
    this->readHeader();
    bool hasPoints = false;
    for (const PlyElement& element : this->Elements)
    {
      hasPoints = hasPoints || element.name == "vertex";
      this->PointCount = element.name == "vertex" ? element.count : this->PointCount;
    }
    if (!hasPoints)
    {
      this->fail("it has no element vertex");
    }
    auto mesh = vtkSmartPointer<vtkPolyData>::New();
    for (const PlyElement& element : this->Elements)
    {
      if (element.name == "vertex")
      {
        this->readPoints(element, mesh);
      }
      else if (element.name == "face")
      {
        this->readFaces(element, mesh);
      }
      else
      {
        this->forItems(element, [] {});
      }
    }
    return mesh;
  }

private:
  [[noreturn]] void fail(const std::string& why) const
  {
    throw ProgramError(FileFailed, "cannot read mesh " + this->File.string() + ": " + why);
  }

  std::string line()
  {
    const std::size_t end = std::min(this->Content.find('\n', this->At), this->Content.size());
    std::string text = this->Content.substr(this->At, end - this->At);
    this->At = std::min(end + 1, this->Content.size());
    return text;
  }

  void readHeader()
  {
    if (this->line().compare(0, 3, "ply") != 0)
    {
      this->fail("it does not begin with 'ply'");
    }
    bool hasFormat = false;
    while (this->At < this->Content.size())
    {
      const std::string text = this->line();
      std::istringstream words(text);
      std::string word;
      words >> word;
      if (word == "end_header")
      {
        return hasFormat ? void() : this->fail("its header names no format");
      }
      hasFormat = hasFormat || word == "format";
      if (!this->understands(word, words))
      {
        this->fail("its header is broken: '" + text.substr(0, 60) + "'");
      }
    }
    this->fail("it ends too soon, within its header");
  }

  bool understands(const std::string& word, std::istringstream& words)
  {
    if (word == "format")
    {
      std::string format;
      words >> format;
      this->IsText = format == "ascii";
      this->IsBigEndian = format == "binary_big_endian";
      return this->IsText || this->IsBigEndian || format == "binary_little_endian";
    }
    if (word == "element")
    {
      constexpr long long most = 0x7fffffff;
      PlyElement element;
      long long count = -1;
      words >> element.name >> count;
      element.count = std::size_t(count);
      this->Elements.push_back(element);
      return words && count >= 0 && count <= most;
    }
    return word != "property" || this->understandsProperty(words); // comments, and whatever readers pass over
  }

  bool understandsProperty(std::istringstream& words)
  {
    PlyProperty property;
    std::string type, count;
    words >> type;
    property.isList = type == "list";
    if (property.isList)
    {
      words >> count >> type;
      property.count = typeOf(count);
    }
    words >> property.name;
    property.value = typeOf(type);
    const bool isCounted = !property.isList || (property.count.size > 0 && property.count.kind != 'f');
    if (!words || this->Elements.empty() || property.value.size == 0 || !isCounted)
    {
      return false;
    }
    this->Elements.back().properties.push_back(property);
    return true;
  }

  double number(const PlyType& type) { return this->IsText ? this->textNumber() : this->binaryNumber(type); }

  double textNumber()
  {
    const char* const blanks = " \t\r\n\v\f";
    const std::size_t begin = std::min(this->Content.find_first_not_of(blanks, this->At), this->Content.size());
    this->At = std::min(this->Content.find_first_of(blanks, begin), this->Content.size());
    double value = 0.0;
    const char* const first = this->Content.data() + begin + (begin < this->At && this->Content[begin] == '+' ? 1 : 0);
    const char* const last = this->Content.data() + this->At;
    const auto parsed = std::from_chars(first, last, value);
    if (begin == this->At)
    {
      this->failEnded();
    }
    if (parsed.ec != std::errc() || parsed.ptr != last)
    {
      this->fail("'" + this->Content.substr(begin, std::min<std::size_t>(this->At - begin, 40)) + "' is no number (" + this->Where + ")");
    }
    return value;
  }

  template <typename Number>
  static double as(const std::array<char, 8>& bytes)
  {
    Number value;
    std::memcpy(&value, bytes.data(), sizeof value);
    return double(value);
  }

  double binaryNumber(const PlyType& type)
  {
    const auto size = std::size_t(type.size);
    if (size > this->Content.size() - this->At)
    {
      this->failEnded();
    }
    std::array<char, 8> bytes{};
    std::copy_n(this->Content.data() + this->At, size, bytes.begin());
    this->At += size;
    const std::uint16_t one = 1;
    const bool isLittleMachine = *reinterpret_cast<const unsigned char*>(&one) == 1;
    if (this->IsBigEndian == isLittleMachine)
    {
      std::reverse(bytes.begin(), bytes.begin() + type.size);
    }
    if (type.kind == 'f')
    {
      return type.size == 8 ? as<double>(bytes) : as<float>(bytes);
    }
    const bool isSigned = type.kind == 'i';
    switch (type.size)
    {
      case 4: return isSigned ? as<std::int32_t>(bytes) : as<std::uint32_t>(bytes);
      case 2: return isSigned ? as<std::int16_t>(bytes) : as<std::uint16_t>(bytes);
      default: return isSigned ? as<std::int8_t>(bytes) : as<std::uint8_t>(bytes);
    }
  }

  [[noreturn]] void failEnded() const { this->fail("it ends too soon, within " + this->Where); }

  /** Read an element's items one after another: the numbers of each property, of which `Values` holds them, then call `take()`. */
  template <typename Take>
  void forItems(const PlyElement& element, const Take& take)
  {
    this->Values.resize(element.properties.size());
    for (std::size_t item = 0; item < element.count && !element.properties.empty(); ++item)
    {
      this->Where = element.name + " " + std::to_string(item) + " of " + std::to_string(element.count);
      for (std::size_t p = 0; p < element.properties.size(); ++p)
      {
        this->readValues(element.properties[p], this->Values[p]);
      }
      take();
    }
  }

  void readValues(const PlyProperty& property, std::vector<double>& values)
  {
    values.clear();
    const double count = property.isList ? this->number(property.count) : 1.0;
    if (!(count >= 0.0))
    {
      this->fail("a list of " + std::to_string(long(count)) + " values (" + this->Where + ")");
    }
    for (double n = 0.0; n < count; ++n)
    {
      values.push_back(this->number(property.value));
    }
  }

  void readPoints(const PlyElement& element, vtkPolyData* mesh)
  {
    std::array<std::size_t, 3> places{};
    bool isDouble = false;
    for (std::size_t axis = 0; axis < 3; ++axis)
    {
      const std::string name(1, "xyz"[axis]);
      const int place = element.find(name);
      if (place < 0 || element.properties[std::size_t(place)].isList)
      {
        this->fail("its points have no " + name);
      }
      places[axis] = std::size_t(place);
      isDouble = isDouble || element.properties[places[axis]].value.size == 8;
    }
    vtkNew<vtkPoints> points;
    points->SetDataType(isDouble ? VTK_DOUBLE : VTK_FLOAT);
    this->forItems(element,
      [&] { points->InsertNextPoint(this->Values[places[0]][0], this->Values[places[1]][0], this->Values[places[2]][0]); });
    mesh->SetPoints(points);
  }

  void readFaces(const PlyElement& element, vtkPolyData* mesh)
  {
    const int place = std::max(element.find("vertex_indices"), element.find("vertex_index"));
    if (place < 0 || !element.properties[std::size_t(place)].isList)
    {
      this->fail("its faces have no list vertex_indices");
    }
    vtkNew<vtkCellArray> faces;
    std::vector<vtkIdType> corners;
    this->forItems(element,
      [&]
      {
        corners.clear();
        for (const double corner : this->Values[std::size_t(place)])
        {
          if (!(corner >= 0.0 && corner < double(this->PointCount)))
          {
            std::ostringstream index;
            index << corner;
            this->fail(this->Where + " names point " + index.str() + ", there are " + std::to_string(this->PointCount));
          }
          corners.push_back(vtkIdType(corner));
        }
        faces->InsertNextCell(vtkIdType(corners.size()), corners.data());
      });
    mesh->SetPolys(faces);
  }

  std::filesystem::path File;
  std::string Content;
  std::size_t At = 0;
  bool IsText = false;
  bool IsBigEndian = false;
  std::vector<PlyElement> Elements;
  std::size_t PointCount = 0;
  std::vector<std::vector<double>> Values; ///< of the item that was read last, by property
  std::string Where = "its header";        ///< for messages
};

} // namespace

vtkSmartPointer<vtkPolyData> readPly(const std::filesystem::path& file)
{
  return PlyFile(file).read();
}

} // namespace silhouette::program
