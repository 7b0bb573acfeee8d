// SPDX-License-Identifier: BSD-3-Clause
#include "OctreeConversion.h"

#include "Error.h"
#include "FieldValues.h"
#include "LargeArrays.h"
#include "vtkSilhouetteCompatibility.h"

#include "vtkBitArray.h"
#include "vtkCellData.h"
#include "vtkDoubleArray.h"
#include "vtkFieldData.h"
#include "vtkHyperTree.h"
#include "vtkHyperTreeGrid.h"
#include "vtkHyperTreeGridNonOrientedCursor.h"
#include "vtkNew.h"
#include "vtkTypeUInt64Array.h"
#include "vtkUnsignedCharArray.h"

#include <algorithm>
#include <cmath>
#include <sstream>
#include <string>
#include <utility>

namespace silhouette::modeling
{
namespace
{

/** The octants of one tree in one generation: a range, since a generation is in Morton order. */
struct TreeLevel
{
  std::size_t first = 0;
  std::size_t last = 0;
};

/** Octants of generation `g` that intersect, among its first `index`. */
std::size_t intersectionsBefore(const Generation& generation, std::size_t index)
{
  if (index < generation.size())
  {
    return generation.childBlock[index];
  }
  return generation.size() == 0
             ? 0
             : generation.childBlock.back() + (generation.state.back() == OctantState::Intersection);
}

/** The levels of the tree whose root is octant `root` of the tree generation. */
std::vector<TreeLevel> levelsOf(const Octree& octree, std::size_t root)
{
  std::vector<TreeLevel> levels = {{root, root + 1}};
  for (int g = octree.treeGeneration; g < octree.lattice.depth; ++g)
  {
    const Generation& generation = octree.generations[g];
    const TreeLevel next = {8 * intersectionsBefore(generation, levels.back().first),
                            8 * intersectionsBefore(generation, levels.back().last)};
    if (next.first == next.last)
    {
      break;
    }
    levels.push_back(next);
  }
  return levels;
}

void setAxes(const Octree& octree, vtkHyperTreeGrid* grid)
{
  const int trees = 1 << octree.treeGeneration;
  const std::int32_t step = octree.lattice.cells() >> octree.treeGeneration;
  grid->SetDimensions(trees + 1, trees + 1, trees + 1);
  grid->SetBranchFactor(2);
  for (int axis = 0; axis < 3; ++axis)
  {
    vtkNew<vtkDoubleArray> coordinates;
    coordinates->SetNumberOfValues(trees + 1);
    for (int i = 0; i <= trees; ++i)
    {
      coordinates->SetValue(i, octree.lattice.coordinate(axis, double(i) * step));
    }
    axis == 0 ? grid->SetXCoordinates(coordinates)
              : (axis == 1 ? grid->SetYCoordinates(coordinates) : grid->SetZCoordinates(coordinates));
  }
}

/** The cells' arrays and mask, filled tree by tree. */
class CellWriter
{
public:
  CellWriter(const Octree& octree, vtkHyperTreeGrid* grid) : Source(octree), Grid(grid)
  {
    vtkIdType count = 0;
    for (const Generation& generation : octree.generations)
    {
      count += static_cast<vtkIdType>(generation.size());
    }
    this->State->SetName("State");
    setTuples(this->State, count);
    this->GenerationNumber->SetName("Generation");
    setTuples(this->GenerationNumber, count);
    this->Code->SetName("LatticeCode");
    setTuples(this->Code, count);
    this->Mask->SetNumberOfValues(count);
  }

  void addTree(std::size_t root)
  {
    const std::vector<TreeLevel> levels = levelsOf(this->Source, root);
    const LatticePoint at = fromMorton(this->Source.generations[this->Source.treeGeneration].code[root]);
    vtkIdType index = 0;
    this->Grid->GetIndexFromLevelZeroCoordinates(index, at.i, at.j, at.k);
    vtkNew<vtkHyperTreeGridNonOrientedCursor> cursor;
    this->Grid->InitializeNonOrientedCursor(cursor, index, true);
    vtkHyperTree* tree = cursor->GetTree();
    tree->SetGlobalIndexStart(this->Next);
    if (levels.size() > 1)
    {
      this->subdivide(levels, tree);
    }
    for (std::size_t level = 0; level < levels.size(); ++level)
    {
      this->addCells(levels[level], this->Source.treeGeneration + int(level));
    }
  }

  void finish()
  {
    vtkCellData* cells = this->Grid->GetCellData();
    cells->AddArray(this->State);
    cells->AddArray(this->GenerationNumber);
    cells->AddArray(this->Code);
    cells->SetActiveScalars("State");
    this->Grid->SetMask(this->Mask);
  }

private:
  /** Every level but the last, a bit for each octant: has it children? */
  void subdivide(const std::vector<TreeLevel>& levels, vtkHyperTree* tree)
  {
    vtkIdType bits = 0;
    for (std::size_t level = 0; level + 1 < levels.size(); ++level)
    {
      bits += static_cast<vtkIdType>(levels[level].last - levels[level].first);
    }
    vtkNew<vtkBitArray> descriptor;
    descriptor->SetNumberOfValues(bits);
    vtkIdType bit = 0;
    for (std::size_t level = 0; level + 1 < levels.size(); ++level)
    {
      const auto& states = this->Source.generations[std::size_t(this->Source.treeGeneration) + level].state;
      for (std::size_t i = levels[level].first; i < levels[level].last; ++i)
      {
        descriptor->SetValue(bit++, states[i] == OctantState::Intersection);
      }
    }
    tree->BuildFromBreadthFirstOrderDescriptor(descriptor, bits, 0);
  }

  void addCells(const TreeLevel& level, int g)
  {
    const Generation& generation = this->Source.generations[g];
    for (std::size_t i = level.first; i < level.last; ++i, ++this->Next)
    {
      this->State->SetValue(this->Next, static_cast<unsigned char>(generation.state[i]));
      this->GenerationNumber->SetValue(this->Next, static_cast<unsigned char>(g));
      this->Code->SetValue(this->Next, generation.code[i]);
      this->Mask->SetValue(this->Next, generation.state[i] == OctantState::Background);
    }
  }

  const Octree& Source;
  vtkHyperTreeGrid* Grid;
  vtkNew<vtkUnsignedCharArray> State;
  vtkNew<vtkUnsignedCharArray> GenerationNumber;
  vtkNew<vtkTypeUInt64Array> Code;
  vtkNew<vtkBitArray> Mask;
  vtkIdType Next = 0;
};

void storeParameters(const Octree& octree, vtkHyperTreeGrid* grid)
{
  const RootCube& root = octree.lattice.root;
  std::uint64_t inside = 0;
  for (int g = 0; g <= octree.lattice.depth; ++g)
  {
    inside += octree.count(OctantState::Inside, g);
  }
  setField(grid, "Depth", octree.lattice.depth);
  setField(grid, "RootCube",
           std::vector<double>{root.origin[0], root.origin[1], root.origin[2], root.edge});
  setField(grid, "TreeGeneration", octree.treeGeneration);
  setField(grid, "NumberOfViews", octree.viewCount);
  setField(grid, "BackgroundVotes", octree.backgroundVotes);
  setField(grid, "OutsidePolicy", int(octree.outside));
  setField(grid, "ViewsFingerprint", octree.fingerprint);
  setField(grid, "OctantsTested", octree.statistics.octantsTested);
  setField(grid, "ViewTests", octree.statistics.viewTests);
  setField(grid, "CarvedByView", octree.statistics.carvedByView);
  setField(grid, "InsideOctants", inside);
  setField(grid, "IntersectionOctants",
           std::uint64_t(octree.count(OctantState::Intersection, octree.lattice.depth)));
}

constexpr const char* GridName = "the octree";

int fieldInRange(vtkHyperTreeGrid* grid, const char* name, int least, int greatest)
{
  const double value = getField(grid, name, 1, GridName)[0];
  if (!(value >= least && value <= greatest))
  {
    throw InvalidInput(std::string(GridName) + "'s field array " + name + " holds " + std::to_string(value) +
                       ", " + std::to_string(least) + " to " + std::to_string(greatest) + " is possible");
  }
  return int(value);
}

void readParameters(vtkHyperTreeGrid* grid, Octree& octree)
{
  octree.lattice.depth = fieldInRange(grid, "Depth", 1, MaximumDepth);
  octree.treeGeneration = fieldInRange(grid, "TreeGeneration", 0, octree.lattice.depth);
  octree.viewCount = fieldInRange(grid, "NumberOfViews", 1, 0xffff);
  octree.backgroundVotes = fieldInRange(grid, "BackgroundVotes", 0, octree.viewCount - 1);
  octree.outside = OutsidePolicy(fieldInRange(grid, "OutsidePolicy", 0, 2));
  octree.fingerprint = getUnsignedField(grid, "ViewsFingerprint", GridName);
  const std::vector<double> root = getField(grid, "RootCube", 4, GridName);
  if (!std::all_of(root.begin(), root.end(), [](double value) { return std::isfinite(value); }) || !(root[3] > 0.0))
  {
    std::ostringstream text;
    text << GridName << "'s field array RootCube holds " << root[0] << " " << root[1] << " " << root[2] << " " << root[3]
         << "; a corner and an edge above 0, all finite, are possible";
    throw InvalidInput(text.str());
  }
  octree.lattice.root = {{root[0], root[1], root[2]}, root[3]};
  octree.statistics.octantsTested = getUnsignedField(grid, "OctantsTested", GridName);
  octree.statistics.viewTests = getUnsignedField(grid, "ViewTests", GridName);
  octree.statistics.carvedByView = getField(grid, "CarvedByView", 0, GridName);
}

template <typename Array> Array* cellArray(vtkHyperTreeGrid* grid, const char* name, vtkIdType count)
{
  auto* array = Array::SafeDownCast(grid->GetCellData()->GetAbstractArray(name));
  if (!array || array->GetNumberOfComponents() != 1 || (count >= 0 && array->GetNumberOfValues() != count))
  {
    throw InvalidInput(std::string(GridName) + " has no cell array " + name +
                       " of the type and length that vtkSilhouetteOctreeSource gives it");
  }
  return array;
}

/** Bring a generation's octants into the order of their codes. A grid of our own has them in it. */
void sortOctants(Generation& generation)
{
  if (std::is_sorted(generation.code.begin(), generation.code.end()))
  {
    return;
  }
  std::vector<std::pair<std::uint64_t, OctantState>> octants;
  for (std::size_t i = 0; i < generation.size(); ++i)
  {
    octants.emplace_back(generation.code[i], generation.state[i]);
  }
  std::sort(octants.begin(), octants.end());
  for (std::size_t i = 0; i < octants.size(); ++i)
  {
    generation.code[i] = octants[i].first;
    generation.state[i] = octants[i].second;
  }
}

[[noreturn]] void throwIncomplete(int generation, std::uint64_t code)
{
  throw InvalidInput(std::string(GridName) + " is incomplete: octants of generation " +
                     std::to_string(generation) + " are missing or doubled at lattice code " +
                     std::to_string(code) + "; a filtered or cut grid is no longer an octree of silhouettes");
}

/** Give each intersection octant its block of children, and check that all eight are there. */
void linkChildren(Octree& octree)
{
  for (int g = octree.treeGeneration; g <= octree.lattice.depth; ++g)
  {
    Generation& generation = octree.generations[g];
    const Generation* children = g < octree.lattice.depth ? &octree.generations[g + 1] : nullptr;
    std::uint32_t blocks = 0;
    generation.childBlock.reserve(generation.size());
    for (std::size_t i = 0; i < generation.size(); ++i)
    {
      generation.childBlock.push_back(blocks);
      if (generation.state[i] != OctantState::Intersection)
      {
        continue;
      }
      for (std::size_t c = 0; children && c < 8; ++c)
      {
        const std::uint64_t code = generation.code[i] << 3 | c;
        const std::size_t at = 8 * std::size_t(blocks) + c;
        if (at >= children->size() || children->code[at] != code)
        {
          throwIncomplete(g + 1, code);
        }
      }
      ++blocks;
    }
    if (children && children->size() != 8 * std::size_t(blocks))
    {
      throwIncomplete(g + 1, children->code.back());
    }
  }
}

} // namespace

void storeOctree(const Octree& octree, vtkHyperTreeGrid* grid)
{
  grid->Initialize();
  setAxes(octree, grid);
  CellWriter writer(octree, grid);
  for (std::size_t root = 0; root < octree.generations[octree.treeGeneration].size(); ++root)
  {
    writer.addTree(root);
  }
  writer.finish();
  storeParameters(octree, grid);
}

Octree octreeOf(vtkHyperTreeGrid* grid)
{
  Octree octree;
  readParameters(grid, octree);
  auto* states = cellArray<vtkUnsignedCharArray>(grid, "State", -1);
  const vtkIdType count = states->GetNumberOfValues();
  const unsigned char* generations =
      cellArray<vtkUnsignedCharArray>(grid, "Generation", count)->GetPointer(0);
  const vtkTypeUInt64* codes = cellArray<vtkTypeUInt64Array>(grid, "LatticeCode", count)->GetPointer(0);
  octree.generations.resize(std::size_t(octree.lattice.depth) + 1);
  for (vtkIdType cell = 0; cell < count; ++cell)
  {
    const int g = generations[cell];
    if (g < octree.treeGeneration || g > octree.lattice.depth || states->GetValue(cell) > 2 ||
        codes[cell] >> 3 * g)
    {
      throw InvalidInput(std::string(GridName) + "'s cell " + std::to_string(cell) + " has generation " +
                         std::to_string(g) + ", state " + std::to_string(states->GetValue(cell)) +
                         " and lattice code " + std::to_string(codes[cell]) +
                         ", which do not fit its depth of " + std::to_string(octree.lattice.depth));
    }
    octree.generations[g].code.push_back(codes[cell]);
    octree.generations[g].state.push_back(OctantState(states->GetValue(cell)));
  }
  for (Generation& generation : octree.generations)
  {
    sortOctants(generation);
  }
  if (getIntegerField(grid, "NumberOfPieces", 1) == 1 &&
      octree.generations[octree.treeGeneration].size() != std::size_t(1) << 3 * octree.treeGeneration)
  {
    throwIncomplete(octree.treeGeneration, octree.generations[octree.treeGeneration].size());
  }
  linkChildren(octree);
  return octree;
}

bool isEmpty(vtkHyperTreeGrid* grid)
{
  return !grid || numberOfOctants(grid) == 0;
}

} // namespace silhouette::modeling
