// SPDX-License-Identifier: BSD-3-Clause
#include "ObjFile.h"

#include "ExitCodes.h"

#include "vtkCellArray.h"
#include "vtkCellArrayIterator.h"
#include "vtkNew.h"
#include "vtkPoints.h"
#include "vtkPolyData.h"

#include <fstream>
#include <limits>
#include <locale>
#include <sstream>
#include <vector>

namespace silhouette::program
{
namespace
{

[[noreturn]] void failLine(const std::filesystem::path& file, std::size_t number, const std::string& why)
{
  throw ProgramError(FileFailed, "cannot read mesh " + file.string() + ": line " + std::to_string(number) + ": " + why);
}

/** One line at a time, so that errors can say which. */
class ObjReader
{
public:
  explicit ObjReader(const std::filesystem::path& file)
    : File(file)
  {
    this->Points->SetDataTypeToDouble();
  }

  void readLine(const std::string& line)
  {
    ++this->Number;
    std::istringstream words(line);
    words.imbue(std::locale::classic());
    std::string keyword;
    words >> keyword;
    if (keyword == "v")
    {
      this->readPoint(words);
    }
    else if (keyword == "f")
    {
      this->readFace(words);
    }
  }

  vtkSmartPointer<vtkPolyData> mesh()
  {
    auto mesh = vtkSmartPointer<vtkPolyData>::New();
    mesh->SetPoints(this->Points);
    mesh->SetPolys(this->Faces);
    return mesh;
  }

private:
  void readPoint(std::istringstream& words)
  {
    double point[3];
    if (!(words >> point[0] >> point[1] >> point[2]))
    {
      failLine(this->File, this->Number, "expected three coordinates");
    }
    this->Points->InsertNextPoint(point);
  }

  void readFace(std::istringstream& words)
  {
    std::vector<vtkIdType> corners;
    std::string corner;
    while (words >> corner)
    {
      corners.push_back(this->pointOf(corner));
    }
    if (corners.size() < 3)
    {
      failLine(this->File, this->Number, "a face needs three points");
    }
    this->Faces->InsertNextCell(static_cast<vtkIdType>(corners.size()), corners.data());
  }

  /** "7", "7/1", "7//3" or "-1": the point's number from 1, or back from the last one so far. */
  vtkIdType pointOf(const std::string& corner)
  {
    const vtkIdType count = this->Points->GetNumberOfPoints();
    long long index = 0;
    std::istringstream number(corner.substr(0, corner.find('/')));
    number.imbue(std::locale::classic());
    number >> index;
    const long long id = index < 0 ? count + index : index - 1;
    if (number.fail() || !number.eof() || id < 0 || id >= count)
    {
      failLine(this->File, this->Number, "'" + corner + "' names none of the " + std::to_string(count) + " points");
    }
    return static_cast<vtkIdType>(id);
  }

  const std::filesystem::path& File;
  std::size_t Number = 0;
  vtkNew<vtkPoints> Points;
  vtkNew<vtkCellArray> Faces;
};

} // namespace

vtkSmartPointer<vtkPolyData> readObj(const std::filesystem::path& file)
{
  std::ifstream stream(file);
  ObjReader reader(file);
  std::string line;
  while (std::getline(stream, line))
  {
    reader.readLine(line);
  }
  return reader.mesh();
}

void writeObj(vtkPolyData* mesh, const std::filesystem::path& file)
{
  std::ofstream stream(file, std::ios::binary);
  stream.imbue(std::locale::classic());
  stream.precision(std::numeric_limits<double>::max_digits10);
  for (vtkIdType i = 0; i < mesh->GetNumberOfPoints(); ++i)
  {
    double point[3];
    mesh->GetPoint(i, point);
    stream << "v " << point[0] << ' ' << point[1] << ' ' << point[2] << '\n';
  }
  const auto faces = vtk::TakeSmartPointer(mesh->GetPolys()->NewIterator());
  for (faces->GoToFirstCell(); !faces->IsDoneWithTraversal(); faces->GoToNextCell())
  {
    vtkIdType size = 0;
    const vtkIdType* corners = nullptr;
    faces->GetCurrentCell(size, corners);
    stream << 'f';
    for (vtkIdType i = 0; i < size; ++i)
    {
      stream << ' ' << corners[i] + 1;
    }
    stream << '\n';
  }
  stream.close();
  if (!stream)
  {
    throw ProgramError(
      FileFailed, "cannot write mesh " + file.string() + ": not all of it was written; is the disk full?");
  }
}

} // namespace silhouette::program
