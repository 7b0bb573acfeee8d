// SPDX-License-Identifier: BSD-3-Clause
#include "ViewSelection.h"

#include "Error.h"
#include "TextParsing.h"

#include <algorithm>
#include <filesystem>
#include <numeric>
#include <set>

namespace silhouette
{

namespace
{

/** Index of the view with this name or stem; -1 where there is none. */
int indexOfName(const std::string& piece, const std::vector<std::string>& names)
{
  const auto exact = std::find(names.begin(), names.end(), piece);
  if (exact != names.end())
  {
    return int(exact - names.begin());
  }
  int found = -1;
  for (std::size_t i = 0; i < names.size(); ++i)
  {
    if (std::filesystem::path(names[i]).replace_extension().generic_string() == piece)
    {
      if (found >= 0)
      {
        throw InvalidInput("views: " + inQuotes(piece) + " fits both " + inQuotes(names[std::size_t(found)]) +
                           " and " + inQuotes(names[i]));
      }
      found = int(i);
    }
  }
  return found;
}

/** Where images are called by numbers, one without its extension may be taken for an index. */
void checkIsNoIndex(const std::string& piece, int named, const std::vector<std::string>& names)
{
  const std::optional<int> index = parseCount(piece);
  if (index && *index != named && std::size_t(*index) < names.size() && names[std::size_t(named)] != piece)
  {
    throw InvalidInput("views: " + inQuotes(piece) + " is the image " + inQuotes(names[std::size_t(named)]) + ", and the index of " +
                       inQuotes(names[std::size_t(*index)]) + "; write the whole name, or " + piece + "-" + piece);
  }
}

int checkedIndex(int index, const std::string& piece, std::size_t count)
{
  if (std::size_t(index) >= count)
  {
    throw InvalidInput("views: " + inQuotes(piece) + " is out of range: the capture has views 0 to " +
                       std::to_string(count - 1));
  }
  return index;
}

/** Add an index, or a range of them; false where the piece is neither. */
bool addIndices(const std::string& piece, std::size_t count, std::set<int>& selected)
{
  const std::vector<std::string> ends = splitText(piece, '-');
  const std::optional<int> first = parseCount(ends[0]);
  const std::optional<int> last = parseCount(ends.back());
  if (ends.size() > 2 || !first || !last)
  {
    return false;
  }
  if (*last < *first)
  {
    throw InvalidInput("views: the range " + inQuotes(piece) + " runs backwards");
  }
  checkedIndex(*last, piece, count);
  for (int index = *first; index <= *last; ++index)
  {
    selected.insert(index);
  }
  return true;
}

} // namespace

std::vector<int> selectViews(const std::string& selection, const std::vector<std::string>& names)
{
  std::vector<int> all(names.size());
  std::iota(all.begin(), all.end(), 0);
  if (selection.find_first_not_of(" \t") == std::string::npos)
  {
    return all;
  }
  std::set<int> selected;
  for (const std::string& piece : splitText(selection, ','))
  {
    const int named = piece.empty() ? -1 : indexOfName(piece, names);
    if (named >= 0)
    {
      checkIsNoIndex(piece, named, names);
      selected.insert(named);
    }
    else if (!addIndices(piece, names.size(), selected))
    {
      throw InvalidInput("views: " + inQuotes(piece) +
                         " is neither the name of a view nor an index (as in 0,3,5-9) from 0 to " +
                         std::to_string(names.empty() ? 0 : names.size() - 1));
    }
  }
  return std::vector<int>(selected.begin(), selected.end());
}

} // namespace silhouette
