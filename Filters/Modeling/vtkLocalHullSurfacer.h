// SPDX-License-Identifier: BSD-3-Clause
/**
 * @class   vtkLocalHullSurfacer
 * @brief   a closed, clean surface from an imperfect one and the octree of silhouettes
 *
 * Makes a marching-cubes surface of silhouettes whole. Whatever the silhouettes, the result is closed,
 * oriented outwards, edge- and vertex-manifold and free of self-intersections; it crosses or encloses every
 * octant of the last generation that survived the carving, and has no more components than these have.
 *
 * | port | data set | array | type, components | meaning |
 * | --- | --- | --- | --- | --- |
 * | input 0 | vtkPolyData, triangles | | | the imperfect surface, from vtkVotingMarchingCubes |
 * | input 1 | vtkHyperTreeGrid | | | first output of vtkSilhouetteOctreeSource |
 * | input 2 (optional) | vtkPartitionedDataSetCollection | | | its second output: the views; without, the same promise, less accuracy |
 * | output 0 | vtkPolyData, triangles, normals outwards | points `Normals` | float, 3 | the surface; normals where GenerateNormals is on |
 * | | | field `Survivors` | 64-bit unsigned, 1 | octants of the last generation that survived |
 * | | | field `CoveredOctants` | 64-bit unsigned, 1 | of these, the ones without an inside corner at first |
 * | | | field `CoveringCorners` | 64-bit unsigned, 1 | corners labelled inside for their sake |
 * | | | field `Bridges` | 64-bit unsigned, 1 | joints between components of the survivors |
 * | | | field `CavitiesFilled` | 64-bit unsigned, 1 | cavities labelled inside |
 * | | | field `IgnoredPoints` | 64-bit unsigned, 1 | input points that lie on no lattice edge |
 * | | | field `MovedToMiddle` | 64-bit unsigned, 1 | points moved to the middle of their edge against a self-intersection |
 * | output 1 | vtkPolyData, triangles | cells `HullId` | int, 1 | the local hulls, each a closed convex part |
 *
 * The input surface's field data pass through: `IntersectionOctants`, `LostNoCorner`, `LostAllCorners`,
 * `Vertices` and `Faces` are those of the marching-cubes surface.
 *
 * The hulls cost a run of Qhull each and are computed only when asked for: by Update(1), or by a filter that
 * is connected to the second output. Update() alone leaves that output empty, and asking for it later does
 * not compute the surface again.
 *
 * Steps: a globally consistent inside or outside label for each lattice corner; every survivor covered,
 * pieces joined; the marching-cubes table over all mixed cells; crossings from the surface where it has them,
 * else from the views, else where the covering asks.
 *
 * Cost: proportional to the octants of the last generation; memory: about 200 bytes for each.
 *
 * Limits: an empty octree gives an empty surface without a message. Errors: octree and views that do not
 * belong together; a surface with cells other than triangles; a parameter out of range; single precision too
 * coarse for the depth.
 *
 * AbortExecute is honoured: the output is then empty, without an error. VTK does not run an aborted or failed
 * filter again by itself: call Modified() to ask for it.
 *
 * See D. Shin and T. Tjahjadi, "Local hull-based surface construction of volumetric data from silhouettes",
 * IEEE Transactions on Image Processing 17 (8), 2008.
 *
 * @sa vtkSilhouetteOctreeSource vtkVotingMarchingCubes vtkSilhouetteEvaluator
 */
#ifndef vtkLocalHullSurfacer_h
#define vtkLocalHullSurfacer_h

#include "vtkPolyDataAlgorithm.h"
#include "vtkSilhouetteFiltersModelingModule.h" // for the export macro

class VTKSILHOUETTEFILTERSMODELING_EXPORT vtkLocalHullSurfacer : public vtkPolyDataAlgorithm
{
public:
  static vtkLocalHullSurfacer* New();
  vtkTypeMacro(vtkLocalHullSurfacer, vtkPolyDataAlgorithm);
  void PrintSelf(ostream& os, vtkIndent indent) override;

  ///@{
  /**
   * Whether to fill cavities, so that each component is one closed shell. Default on; without it a cavity's
   * wall is one more component.
   */
  vtkSetMacro(FillCavities, bool);
  vtkGetMacro(FillCavities, bool);
  vtkBooleanMacro(FillCavities, bool);
  ///@}

  ///@{
  /**
   * How far the surface stands off a corner that covers a lost octant, in leaf octants, 0.01 to 0.99, default
   * 0.03. Larger makes thin parts thicker. Out of range is an error of Update().
   */
  vtkSetMacro(CoverOffset, double);
  vtkGetMacro(CoverOffset, double);
  ///@}

  ///@{
  /**
   * Survivors' components that are no further apart than this are joined; leaf octants, at least 0, default 2. Larger
   * joins more, so that a thin part that the carving broke stays in one piece.
   */
  vtkSetMacro(BridgeGap, int);
  vtkGetMacro(BridgeGap, int);
  ///@}

  ///@{
  /**
   * How deep an outside corner of the lattice may lie in a local hull; leaf octants, at least 0, default 0.5. Only for
   * the second output: larger gives fewer and larger hulls, which bridge more of a concavity.
   */
  vtkSetMacro(HullTolerance, double);
  vtkGetMacro(HullTolerance, double);
  ///@}

  ///@{
  /**
   * Edge of the blocks that the hulls' seeds lie in, leaf octants, at least 1, default 4. Only for the second
   * output: larger gives fewer seeds and hulls that keep less detail, sooner.
   */
  vtkSetMacro(SeedBlock, int);
  vtkGetMacro(SeedBlock, int);
  ///@}

  ///@{
  /** Whether to give points normals, the area-weighted mean of their triangles' normals. Default off. */
  vtkSetMacro(GenerateNormals, bool);
  vtkGetMacro(GenerateNormals, bool);
  vtkBooleanMacro(GenerateNormals, bool);
  ///@}

  ///@{
  /**
   * Precision of the points: vtkAlgorithm::SINGLE_PRECISION, DOUBLE_PRECISION (default) or DEFAULT_PRECISION
   * (double). Single halves the memory of the points; it is an error where it is too coarse for the depth.
   */
  vtkSetClampMacro(OutputPointsPrecision, int, SINGLE_PRECISION, DEFAULT_PRECISION);
  vtkGetMacro(OutputPointsPrecision, int);
  ///@}

  ///@{
  /** The second port's input: the octree. */
  void SetOctreeConnection(vtkAlgorithmOutput* octree) { this->SetInputConnection(1, octree); }
  void SetOctreeData(vtkDataObject* octree) { this->SetInputData(1, octree); }
  ///@}

  ///@{
  /** The third port's input: the views. */
  void SetViewsConnection(vtkAlgorithmOutput* views) { this->SetInputConnection(2, views); }
  void SetViewsData(vtkDataObject* views) { this->SetInputData(2, views); }
  ///@}

  vtkTypeBool ProcessRequest(vtkInformation* request, vtkInformationVector** inputs,
                             vtkInformationVector* outputs) override;

protected:
  vtkLocalHullSurfacer();
  ~vtkLocalHullSurfacer() override = default;

  int FillInputPortInformation(int port, vtkInformation* info) override;
  int RequestData(vtkInformation* request, vtkInformationVector** inputs,
                  vtkInformationVector* outputs) override;

  bool FillCavities;
  double CoverOffset;
  int BridgeGap;
  double HullTolerance;
  int SeedBlock;
  bool GenerateNormals = false;
  int OutputPointsPrecision = DOUBLE_PRECISION;

private:
  vtkLocalHullSurfacer(const vtkLocalHullSurfacer&) = delete;
  void operator=(const vtkLocalHullSurfacer&) = delete;
};

#endif
