// SPDX-License-Identifier: BSD-3-Clause
#include "MessageListener.h"

#include "vtkCallbackCommand.h"
#include "vtkObject.h"

namespace silhouette::modeling
{
namespace
{

/** A message without its preamble. */
std::string lastLine(const std::string& text)
{
  const std::size_t end = text.find_last_not_of(" \n\r");
  if (end == std::string::npos)
  {
    return {};
  }
  const std::size_t start = text.rfind('\n', end);
  const std::size_t first = start == std::string::npos ? 0 : start + 1;
  return text.substr(first, end - first + 1);
}

} // namespace

MessageListener::MessageListener(std::initializer_list<vtkObject*> objects)
{
  this->Command->SetClientData(this);
  this->Command->SetCallback(
      [](vtkObject*, unsigned long event, void* self, void* text)
      {
        auto* listener = static_cast<MessageListener*>(self);
        std::string& first = event == vtkCommand::ErrorEvent ? listener->Error : listener->Warning;
        if (first.empty())
        {
          first = text ? static_cast<const char*>(text) : "unknown reason";
        }
      });
  for (vtkObject* object : objects)
  {
    object->AddObserver(vtkCommand::ErrorEvent, this->Command);
    object->AddObserver(vtkCommand::WarningEvent, this->Command);
    this->Objects.emplace_back(object);
  }
}

MessageListener::~MessageListener()
{
  for (vtkObject* object : this->Objects)
  {
    object->RemoveObserver(this->Command);
  }
}

std::string MessageListener::error() const
{
  return lastLine(this->Error);
}

std::string MessageListener::warning() const
{
  return lastLine(this->Warning);
}

} // namespace silhouette::modeling
