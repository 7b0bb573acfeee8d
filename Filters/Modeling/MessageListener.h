// SPDX-License-Identifier: BSD-3-Clause
/**
 * What VTK objects complain of, for whoever uses them within a function. Private to the module.
 */
#pragma once

#include "vtkNew.h"
#include "vtkSmartPointer.h"

#include <initializer_list>
#include <string>
#include <vector>

class vtkCallbackCommand;
class vtkObject;

namespace silhouette::modeling
{

/** Takes down the errors and warnings of some objects, which are thereby not printed, as long as it lives; it keeps the objects. */
class MessageListener
{
public:
  explicit MessageListener(std::initializer_list<vtkObject*> objects);
  ~MessageListener();
  MessageListener(const MessageListener&) = delete;
  MessageListener& operator=(const MessageListener&) = delete;

  bool heardError() const { return !this->Error.empty(); }
  /** The first of them, without the preamble that VTK gives it; empty where there was none. */
  std::string error() const;
  std::string warning() const;

private:
  vtkNew<vtkCallbackCommand> Command;
  std::vector<vtkSmartPointer<vtkObject>> Objects;
  std::string Error;
  std::string Warning;
};

} // namespace silhouette::modeling
