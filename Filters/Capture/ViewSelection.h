// SPDX-License-Identifier: BSD-3-Clause
/**
 * Which of a capture's views are used, from what a person typed.
 */
#pragma once

#include <string>
#include <vector>

namespace silhouette
{

/**
 * Indices, ascending and each once, of the views of `names` that `selection` names: pieces between commas,
 * each a name, a name without its extension, a zero-based index, or a range of indices with both ends
 * included
 * ("0,3,5-9", "a.png,b.png"). Names go before indices;
 * a name without its extension that is also the index of another view is neither. An empty selection is all of them. Throws
 * InvalidInput, quoting the piece: no such view, an index out of range, a range that runs backwards, a name
 * without extension that fits several views, or one view and another's index.
 */
std::vector<int> selectViews(const std::string& selection, const std::vector<std::string>& names);

} // namespace silhouette
