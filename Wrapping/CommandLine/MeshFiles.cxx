// SPDX-License-Identifier: BSD-3-Clause
#include "MeshFiles.h"

#include "ExitCodes.h"
#include "MeshNumbers.h"
#include "ObjFile.h"
#include "PlyFile.h"
#include "Stages.h"
#include "StlFileCheck.h"

#include "vtkCommand.h"
#include "vtkExecutive.h"
#include "vtkNew.h"
#include "vtkPLYWriter.h"
#include "vtkPolyData.h"
#include "vtkSTLReader.h"
#include "vtkSTLWriter.h"
#include "vtkTriangleFilter.h"
#include "vtkWriter.h"
#include "vtkXMLPolyDataReader.h"
#include "vtkXMLPolyDataWriter.h"

#include <algorithm>
#include <cctype>
#include <fstream>

namespace silhouette::program
{
namespace
{

std::string formatOf(const std::filesystem::path& file)
{
  std::string extension = file.extension().string();
  std::transform(extension.begin(), extension.end(), extension.begin(),
    [](unsigned char letter) { return static_cast<char>(std::tolower(letter)); });
  return extension.empty() ? extension : extension.substr(1);
}

/** Keeps the first error of a reader or writer. */
class ErrorKeeper : public vtkCommand
{
public:
  static ErrorKeeper* New() { return new ErrorKeeper; }

  void Execute(vtkObject*, unsigned long, void* data) override
  {
    if (this->Message.empty())
    {
      this->Message = plainMessage(static_cast<const char*>(data));
    }
  }

  std::string Message;
};

/** Update a reader or writer; throws with the first of its errors. */
template <typename Filter, typename Action>
void runQuietly(Filter* filter, const std::string& intent, Action&& action)
{
  vtkNew<ErrorKeeper> errors;
  for (const unsigned long event : { vtkCommand::ErrorEvent, vtkCommand::WarningEvent })
  {
    filter->AddObserver(event, errors);
    filter->GetExecutive()->AddObserver(event, errors);
  }
  action();
  if (filter->GetErrorCode() != 0 && errors->Message.empty())
  {
    errors->Message = "not all of it went through; is the disk full, or the file broken?";
  }
  if (!errors->Message.empty())
  {
    throw ProgramError(FileFailed, intent + ": " + errors->Message);
  }
}

template <typename Reader>
vtkSmartPointer<vtkPolyData> readWith(const std::filesystem::path& file)
{
  vtkNew<Reader> reader;
  reader->SetFileName(file.c_str());
  runQuietly(reader.Get(), "cannot read mesh " + file.string(), [&] { reader->Update(); });
  return reader->GetOutput();
}

template <typename Writer>
void writeWith(vtkPolyData* mesh, const std::filesystem::path& file, void (*setUp)(Writer*))
{
  vtkNew<Writer> writer;
  writer->SetInputData(mesh);
  writer->SetFileName(file.c_str());
  setUp(writer);
  runQuietly(writer.Get(), "cannot write mesh " + file.string(), [&] { writer->Write(); });
}

/** Throws where a check has found a fault. */
void refuse(const std::filesystem::path& file, const std::string& fault)
{
  if (!fault.empty())
  {
    throw ProgramError(FileFailed, "cannot read mesh " + file.string() + ": " + fault);
  }
}

vtkSmartPointer<vtkPolyData> readByFormat(const std::filesystem::path& file)
{
  const std::string format = formatOf(file);
  if (format == "vtp")
  {
    return readWith<vtkXMLPolyDataReader>(file);
  }
  if (format == "ply")
  {
    return readPly(file);
  }
  if (format == "stl")
  {
    refuse(file, stlFault(file));
    return readWith<vtkSTLReader>(file);
  }
  if (format == "obj")
  {
    return readObj(file);
  }
  throw ProgramError(
    WrongArguments, "mesh " + file.string() + ": the extension says no format; known are " + MeshFormats);
}

} // namespace

bool isMeshFile(const std::filesystem::path& file)
{
  const std::string format = formatOf(file);
  return format == "vtp" || format == "ply" || format == "stl" || format == "obj";
}

bool keepsSinglePrecision(const std::filesystem::path& file)
{
  const std::string format = formatOf(file);
  return format == "ply" || format == "stl";
}

vtkSmartPointer<vtkPolyData> readMesh(const std::filesystem::path& file)
{
  std::error_code ignored;
  if (!std::filesystem::exists(file, ignored))
  {
    throw ProgramError(FileFailed, "cannot read mesh " + file.string() + ": no such file");
  }
  if (!std::filesystem::is_regular_file(file, ignored) || !std::ifstream(file))
  {
    throw ProgramError(FileFailed, "cannot read mesh " + file.string() + ": not a file that can be opened");
  }
  const vtkSmartPointer<vtkPolyData> read = readByFormat(file);
  refuse(file, pointsFault(read));
  refuse(file, cornersFault(read));
  vtkNew<vtkTriangleFilter> triangles;
  triangles->SetInputData(read);
  triangles->PassVertsOff();
  triangles->PassLinesOff();
  triangles->Update();
  vtkSmartPointer<vtkPolyData> mesh = triangles->GetOutput();
  if (mesh->GetNumberOfPolys() == 0)
  {
    throw ProgramError(FileFailed, "cannot read mesh " + file.string() + ": there is no face in it");
  }
  return mesh;
}

void writeMesh(vtkPolyData* mesh, const std::filesystem::path& file)
{
  const std::string format = formatOf(file);
  if (format == "vtp")
  {
    writeWith<vtkXMLPolyDataWriter>(mesh, file,
      [](vtkXMLPolyDataWriter* writer)
      {
        writer->SetDataModeToAppended();
        writer->SetCompressionLevel(1); // a third of the time, and 4 per cent more bytes
      });
  }
  else if (format == "ply")
  {
    writeWith<vtkPLYWriter>(mesh, file, [](vtkPLYWriter* writer) { writer->SetFileTypeToBinary(); });
  }
  else if (format == "stl")
  {
    writeWith<vtkSTLWriter>(mesh, file, [](vtkSTLWriter* writer) { writer->SetFileTypeToBinary(); });
  }
  else if (format == "obj")
  {
    writeObj(mesh, file);
  }
  else
  {
    throw ProgramError(
      WrongArguments, "mesh " + file.string() + ": the extension says no format; known are " + MeshFormats);
  }
}

} // namespace silhouette::program
