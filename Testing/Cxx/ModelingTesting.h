// SPDX-License-Identifier: BSD-3-Clause
/**
 * What the tests of the filters share: small captures of simple solids, and observers of errors, warnings and
 * progress.
 */
#pragma once

#include "vtkAlgorithm.h"
#include "vtkCallbackCommand.h"
#include "vtkCompositeDataSet.h"
#include "vtkDataArray.h"
#include "vtkDataObject.h"
#include "vtkDoubleArray.h"
#include "vtkExecutive.h"
#include "vtkFieldData.h"
#include "vtkImageData.h"
#include "vtkInformation.h"
#include "vtkInformationStringKey.h"
#include "vtkNew.h"
#include "vtkPartitionedDataSetCollection.h"
#include "vtkPointData.h"
#include "vtkPoints.h"
#include "vtkPolyData.h"
#include "vtkSMPTools.h"
#include "vtkSmartPointer.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <sstream>
#include <string>
#include <vector>

namespace silhouette::testing
{

using Matrix = std::array<double, 12>;

/** Hears errors and warnings of a filter and of its executive, which are thereby not printed. */
class Listener
{
public:
  explicit Listener(vtkAlgorithm* filter) : Objects({filter, filter->GetExecutive()})
  {
    this->Command->SetClientData(this);
    this->Command->SetCallback(
        [](vtkObject* from, unsigned long event, void* self, void* text)
        {
          auto* listener = static_cast<Listener*>(self);
          const std::string what = text ? static_cast<const char*>(text) : "";
          if (event == vtkCommand::WarningEvent)
          {
            listener->Warnings.push_back(what);
          }
          else if (vtkExecutive::SafeDownCast(from))
          {
            listener->ExecutiveErrors.push_back(what);
          }
          else
          {
            listener->Errors.push_back(what);
          }
        });
    for (const auto& object : this->Objects)
    {
      object->AddObserver(vtkCommand::ErrorEvent, this->Command);
      object->AddObserver(vtkCommand::WarningEvent, this->Command);
    }
  }
  ~Listener()
  {
    for (const auto& object : this->Objects)
    {
      object->RemoveObserver(this->Command);
    }
  }
  Listener(const Listener&) = delete;
  void operator=(const Listener&) = delete;

  std::vector<std::string> Errors;
  std::vector<std::string> ExecutiveErrors;
  std::vector<std::string> Warnings;

  /** How many of the warnings hold the text. */
  int warnings(const std::string& text) const
  {
    return int(std::count_if(this->Warnings.begin(), this->Warnings.end(),
                             [&](const std::string& warning)
                             { return warning.find(text) != std::string::npos; }));
  }
  bool silent() const
  {
    return this->Errors.empty() && this->ExecutiveErrors.empty() && this->Warnings.empty();
  }

private:
  vtkNew<vtkCallbackCommand> Command;
  std::vector<vtkSmartPointer<vtkObject>> Objects;
};

/** Cells, points, rows and views of a data object: none where it is empty. */
inline vtkIdType elements(vtkDataObject* data)
{
  auto* views = vtkPartitionedDataSetCollection::SafeDownCast(data);
  return views ? vtkIdType(views->GetNumberOfPartitionedDataSets())
               : data->GetNumberOfElements(vtkDataObject::CELL) +
                     data->GetNumberOfElements(vtkDataObject::POINT) +
                     data->GetNumberOfElements(vtkDataObject::ROW);
}

/**
 * Update of `port` (-1: of the first, and all are looked at) fails with one error of the filter, which holds
 * all the texts, and one of its executive; the output is empty.
 */
inline void expectError(vtkAlgorithm* filter, const std::vector<std::string>& texts, int port = -1)
{
  const Listener listener(filter);
  filter->Modified();
  filter->Update(std::max(port, 0));
  ASSERT_EQ(listener.Errors.size(), 1u);
  EXPECT_EQ(listener.ExecutiveErrors.size(), 1u);
  for (const std::string& text : texts)
  {
    EXPECT_NE(listener.Errors[0].find(text), std::string::npos)
        << "'" << text << "' is not in " << listener.Errors[0];
  }
  for (int i = 0; i < filter->GetNumberOfOutputPorts(); ++i)
  {
    EXPECT_TRUE((port >= 0 && port != i) || elements(filter->GetOutputDataObject(i)) == 0) << "output " << i;
  }
}

/** Takes down a filter's progress, and asks it to stop once a fraction is reached. */
class ProgressListener
{
public:
  explicit ProgressListener(vtkAlgorithm* filter, double stopAt = 2.0) : Filter(filter), StopAt(stopAt)
  {
    this->Command->SetClientData(this);
    this->Command->SetCallback(
        [](vtkObject*, unsigned long, void* self, void* fraction)
        {
          auto* listener = static_cast<ProgressListener*>(self);
          listener->Values.push_back(*static_cast<double*>(fraction));
          if (listener->Values.back() >= listener->StopAt)
          {
            listener->Filter->SetAbortExecute(1);
          }
        });
    filter->AddObserver(vtkCommand::ProgressEvent, this->Command);
  }
  ~ProgressListener() { this->Filter->RemoveObserver(this->Command); }
  ProgressListener(const ProgressListener&) = delete;
  void operator=(const ProgressListener&) = delete;

  std::vector<double> Values;

private:
  vtkNew<vtkCallbackCommand> Command;
  vtkSmartPointer<vtkAlgorithm> Filter;
  double StopAt;
};

/** Progress is reported more than once, never falls and ends at 1. */
inline void expectProgress(vtkAlgorithm* filter, int port = 0)
{
  const ProgressListener listener(filter);
  filter->Modified();
  filter->Update(port);
  ASSERT_GT(listener.Values.size(), 3u);
  EXPECT_TRUE(std::is_sorted(listener.Values.begin(), listener.Values.end()));
  EXPECT_EQ(listener.Values.back(), 1.0);
}

/** A filter that is asked to stop gives empty outputs without a message, and the whole when asked again. */
inline void expectAbort(vtkAlgorithm* filter, double at, int port = 0)
{
  {
    const Listener listener(filter);
    const ProgressListener stop(filter, at);
    filter->Modified();
    filter->Update(port);
    EXPECT_TRUE(listener.silent());
    EXPECT_EQ(elements(filter->GetOutputDataObject(port)), 0);
    ASSERT_FALSE(stop.Values.empty());
    EXPECT_LT(stop.Values.back(), 1.0);
  }
  filter->Modified();
  filter->Update(port);
  EXPECT_GT(elements(filter->GetOutputDataObject(port)), 0);
}

inline std::string printed(vtkObject* object)
{
  std::ostringstream text;
  object->PrintSelf(text, vtkIndent());
  return text.str();
}

/** PrintSelf names each setting. */
inline void expectPrints(vtkObject* object, const std::vector<std::string>& names)
{
  const std::string text = printed(object);
  for (const std::string& name : names)
  {
    EXPECT_NE(text.find(name + ":"), std::string::npos) << name;
  }
}

/** A change advances the modification time. */
template <typename Change> void expectModifies(vtkObject* object, const Change& change)
{
  const vtkMTimeType before = object->GetMTime();
  change();
  EXPECT_GT(object->GetMTime(), before);
}

/** A field array's first value, as a number; NaN where there is no such array. */
inline double field(vtkDataObject* data, const char* name)
{
  vtkDataArray* array = data->GetFieldData()->GetArray(name);
  return array && array->GetNumberOfValues() > 0 ? array->GetTuple1(0) : std::nan("");
}

/** A camera at `distance` from the origin, on the circle around z, looking at the origin. */
inline Matrix ringCamera(double angle, double distance, int size, double focal)
{
  const double x = std::cos(angle), y = std::sin(angle), c = 0.5 * (size - 1);
  // right, down, forward
  const double axes[3][3] = {{-y, x, 0.0}, {0.0, 0.0, -1.0}, {-x, -y, 0.0}};
  Matrix p{};
  for (int i = 0; i < 3; ++i)
  {
    p[i] = focal * axes[0][i] + c * axes[2][i];
    p[4 + i] = focal * axes[1][i] + c * axes[2][i];
    p[8 + i] = axes[2][i];
  }
  p[3] = c * distance;
  p[7] = c * distance;
  p[11] = distance;
  return p;
}

/** An unsigned char image of one value. */
inline vtkSmartPointer<vtkImageData> plainImage(int width, int height, unsigned char value, int channels = 1)
{
  auto image = vtkSmartPointer<vtkImageData>::New();
  image->SetDimensions(width, height, 1);
  image->AllocateScalars(VTK_UNSIGNED_CHAR, channels);
  std::fill_n(static_cast<unsigned char*>(image->GetScalarPointer()), std::size_t(width) * height * channels,
              value);
  return image;
}

/** A disc of the given radius in pixels about the image's centre: 255 on 0. */
inline vtkSmartPointer<vtkImageData> discImage(int size, double radius)
{
  auto image = plainImage(size, size, 0);
  auto* pixel = static_cast<unsigned char*>(image->GetScalarPointer());
  const double c = 0.5 * (size - 1);
  for (int row = 0; row < size; ++row)
  {
    for (int column = 0; column < size; ++column, ++pixel)
    {
      *pixel = std::hypot(row - c, column - c) <= radius ? 255 : 0;
    }
  }
  return image;
}

/** Give an image its matrix. */
inline void setProjection(vtkImageData* image, const Matrix& p)
{
  vtkNew<vtkDoubleArray> array;
  array->SetName("Projection");
  array->SetNumberOfComponents(12);
  array->InsertNextTuple(p.data());
  image->GetFieldData()->AddArray(array);
}

inline void appendView(vtkPartitionedDataSetCollection* views, vtkImageData* image, const std::string& name)
{
  const unsigned int index = views->GetNumberOfPartitionedDataSets();
  views->SetNumberOfPartitionedDataSets(index + 1);
  views->SetPartition(index, 0, image);
  views->GetMetaData(index)->Set(vtkCompositeDataSet::NAME(), name.c_str());
}

constexpr int ImageSize = 96;
constexpr double CameraDistance = 5.0;
constexpr double Focal = 180.0;

/** Silhouettes of a sphere of radius 1 about the origin, seen from a ring: it bulges at the poles. */
inline vtkSmartPointer<vtkPartitionedDataSetCollection> ringViews(int count = 8)
{
  auto views = vtkSmartPointer<vtkPartitionedDataSetCollection>::New();
  const double radius = Focal / std::sqrt(CameraDistance * CameraDistance - 1.0);
  for (int i = 0; i < count; ++i)
  {
    auto image = discImage(ImageSize, radius);
    setProjection(image,
                  ringCamera(2.0 * 3.14159265358979 * i / count + 0.1, CameraDistance, ImageSize, Focal));
    appendView(views, image, "disc" + std::to_string(i) + ".png");
  }
  return views;
}

/** Signed volume of a triangle mesh. */
inline double volume(vtkPolyData* surface)
{
  double sum = 0.0;
  for (vtkIdType cell = 0; cell < surface->GetNumberOfCells(); ++cell)
  {
    vtkIdType size = 0;
    const vtkIdType* ids = nullptr;
    surface->GetCellPoints(cell, size, ids);
    double p[3][3];
    for (int c = 0; c < 3; ++c)
    {
      surface->GetPoint(ids[c], p[c]);
    }
    sum += p[0][0] * (p[1][1] * p[2][2] - p[1][2] * p[2][1]) -
           p[0][1] * (p[1][0] * p[2][2] - p[1][2] * p[2][0]) +
           p[0][2] * (p[1][0] * p[2][1] - p[1][1] * p[2][0]);
  }
  return sum / 6.0;
}

/** The bytes of an array, for comparisons to the last bit. */
inline std::string bytes(vtkDataArray* array)
{
  return array ? std::string(static_cast<const char*>(array->GetVoidPointer(0)),
                             std::size_t(array->GetNumberOfValues()) * array->GetDataTypeSize())
               : std::string("none");
}

/** Run `make` with 1, 2 and 8 threads: all give the same bytes. */
template <typename Make> void expectSameForThreads(const Make& make)
{
  std::vector<std::string> results;
  for (const int threads : {1, 2, 8})
  {
    vtkSMPTools::Initialize(threads);
    results.push_back(make());
  }
  vtkSMPTools::Initialize(0);
  EXPECT_FALSE(results[0].empty());
  EXPECT_EQ(results[0], results[1]);
  EXPECT_EQ(results[0], results[2]);
}

} // namespace silhouette::testing
