// SPDX-License-Identifier: BSD-3-Clause
/**
 * Named numbers in a data object's field data: how counts, the octree's parameters and the evaluator's totals
 * travel. Private to the module.
 */
#pragma once

#include <cstdint>
#include <string>
#include <vector>

class vtkDataObject;

namespace silhouette::modeling
{

void setField(vtkDataObject* data, const char* name, int value);
void setField(vtkDataObject* data, const char* name, std::uint64_t value);
void setField(vtkDataObject* data, const char* name, double value);
void setField(vtkDataObject* data, const char* name, const std::vector<double>& values);
void setField(vtkDataObject* data, const char* name, const std::vector<std::uint64_t>& values);

/** The values of a field array; throws InvalidInput, saying `what` lacks it, where it is not there. */
std::vector<double> getField(vtkDataObject* data, const char* name, std::size_t count,
                             const std::string& what);
std::uint64_t getUnsignedField(vtkDataObject* data, const char* name, const std::string& what);
/** All values of a field array of unsigned 64-bit integers, none where it is not there; throws InvalidInput, naming `what`, for another type. */
std::vector<std::uint64_t> getUnsignedFields(vtkDataObject* data, const char* name, const std::string& what);
/** An integer; `otherwise` where there is none. */
int getIntegerField(vtkDataObject* data, const char* name, int otherwise);

} // namespace silhouette::modeling
