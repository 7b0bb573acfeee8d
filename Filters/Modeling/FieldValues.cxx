// SPDX-License-Identifier: BSD-3-Clause
#include "FieldValues.h"

#include "Error.h"

#include "vtkDataArray.h"
#include "vtkDataObject.h"
#include "vtkDoubleArray.h"
#include "vtkFieldData.h"
#include "vtkIntArray.h"
#include "vtkNew.h"
#include "vtkTypeUInt64Array.h"

namespace silhouette::modeling
{
namespace
{

template <typename Array, typename Value>
void setValues(vtkDataObject* data, const char* name, const Value* values, std::size_t count)
{
  vtkNew<Array> array;
  array->SetName(name);
  array->SetNumberOfComponents(1);
  array->SetNumberOfTuples(static_cast<vtkIdType>(count));
  for (std::size_t i = 0; i < count; ++i)
  {
    array->SetValue(static_cast<vtkIdType>(i), values[i]);
  }
  data->GetFieldData()->AddArray(array);
}

} // namespace

void setField(vtkDataObject* data, const char* name, int value)
{
  setValues<vtkIntArray>(data, name, &value, 1);
}

void setField(vtkDataObject* data, const char* name, std::uint64_t value)
{
  setValues<vtkTypeUInt64Array>(data, name, &value, 1);
}

void setField(vtkDataObject* data, const char* name, double value)
{
  setValues<vtkDoubleArray>(data, name, &value, 1);
}

void setField(vtkDataObject* data, const char* name, const std::vector<double>& values)
{
  setValues<vtkDoubleArray>(data, name, values.data(), values.size());
}

void setField(vtkDataObject* data, const char* name, const std::vector<std::uint64_t>& values)
{
  setValues<vtkTypeUInt64Array>(data, name, values.data(), values.size());
}

std::vector<double> getField(vtkDataObject* data, const char* name, std::size_t count,
                             const std::string& what)
{
  vtkDataArray* array = data->GetFieldData() ? data->GetFieldData()->GetArray(name) : nullptr;
  if (!array || array->GetNumberOfValues() < static_cast<vtkIdType>(count))
  {
    throw InvalidInput(what + " has no field array " + name + " of " + std::to_string(count) +
                       " values; was it made by vtkSilhouetteOctreeSource, and its field data kept?");
  }
  std::vector<double> values(static_cast<std::size_t>(array->GetNumberOfValues()));
  for (std::size_t i = 0; i < values.size(); ++i)
  {
    values[i] = array->GetVariantValue(static_cast<vtkIdType>(i)).ToDouble();
  }
  return values;
}

std::uint64_t getUnsignedField(vtkDataObject* data, const char* name, const std::string& what)
{
  getField(data, name, 1, what);
  // A double holds 53 bits only: a fingerprint has 64.
  return data->GetFieldData()->GetArray(name)->GetVariantValue(0).ToUnsignedLongLong();
}

std::vector<std::uint64_t> getUnsignedFields(vtkDataObject* data, const char* name, const std::string& what)
{
  vtkDataArray* array = data->GetFieldData() ? data->GetFieldData()->GetArray(name) : nullptr;
  vtkTypeUInt64Array* integers = vtkTypeUInt64Array::SafeDownCast(array);
  if (array && !integers)
  {
    throw InvalidInput(what + " has a field array " + name + " of type " + array->GetDataTypeAsString() +
                       "; unsigned 64-bit integers are needed");
  }
  return integers ? std::vector<std::uint64_t>(integers->GetPointer(0),
                                               integers->GetPointer(0) + integers->GetNumberOfValues())
                  : std::vector<std::uint64_t>();
}

int getIntegerField(vtkDataObject* data, const char* name, int otherwise)
{
  vtkDataArray* array = data->GetFieldData() ? data->GetFieldData()->GetArray(name) : nullptr;
  return array && array->GetNumberOfValues() > 0 ? array->GetVariantValue(0).ToInt() : otherwise;
}

} // namespace silhouette::modeling
