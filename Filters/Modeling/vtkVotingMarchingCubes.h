// SPDX-License-Identifier: BSD-3-Clause
/**
 * @class   vtkVotingMarchingCubes
 * @brief   marching cubes on the octree of silhouettes, with a vote of the views at each corner
 *
 * Contours the last generation of a vtkSilhouetteOctreeSource's octree: a corner is inside where enough views
 * say so. With all views (Share 1) this is plain marching cubes; with fewer, wrong views are outvoted.
 *
 * | port | data set | array | type, components | meaning |
 * | --- | --- | --- | --- | --- |
 * | input 0 | vtkHyperTreeGrid | | | first output of vtkSilhouetteOctreeSource |
 * | input 1 | vtkPartitionedDataSetCollection | | | its second output: the views |
 * | output 0 | vtkPolyData, triangles, normals outwards | points `InsideVotes` | unsigned short, 2 | inside votes at the inside and the outside end of the point's lattice edge |
 * | | | points `Normals` | float, 3 | where GenerateNormals is on |
 * | | | field `IntersectionOctants`, `LostNoCorner`, `LostAllCorners` | 64-bit unsigned, 1 | octants of the last generation; those without and those with eight inside corners |
 * | | | field `Vertices`, `Faces` | 64-bit unsigned, 1 | of the surface; the octree's field data pass through |
 *
 * A corner needs n inside votes, n the least integer at least Share times the number of views; views that see
 * nothing of it count as inside votes, a corner that no view sees is outside.
 *
 * Steps: the corners of the last generation's intersection octants are collected and voted on; one case
 * table, whose rule on a face depends on that face alone, gives the triangles; each vertex is put in the
 * middle of its lattice edge or where the votes fail along it.
 *
 * In the mode CONSISTENT the octree must allow exactly the background votes that the share leaves (views less
 * n; vtkSilhouetteOctreeSource::SetBackgroundVotes), and the surface is closed; FAITHFUL takes the strict
 * octree at any share, and the surface opens below share 1, as in the publication.
 *
 * Cost: proportional to the octants times the views. Memory: about 100 bytes an octant of the last
 * generation.
 *
 * Pieces: of a piece of the octree it gives the surface of that piece, without ghost cells, since a corner's
 * label depends on its position alone. The pieces' surfaces add up to the whole, triangle for triangle, and
 * point for point after merging coincident points; so do the counts.
 *
 * Limits: thin parts that hold no corner vanish (they are counted in `LostNoCorner`); vtkLocalHullSurfacer
 * keeps them. An empty octree gives an empty surface without a message. Errors: octree and views that do not
 * belong together; a share outside (0, 1]; an octree of other background votes than mode and share need;
 * single precision too coarse for the depth.
 *
 * AbortExecute is honoured: the output is then empty, without an error. VTK does not run an aborted or failed
 * filter again by itself: call Modified() to ask for it.
 *
 * See D. Shin and T. Tjahjadi, "Local hull-based surface construction of volumetric data from silhouettes",
 * IEEE Transactions on Image Processing 17 (8), 2008; the vote is equation 6.1 of the thesis behind it. The
 * exact placement follows C. Liang and K.-Y. K. Wong, "Exact visual hull from marching cubes", VISAPP 2008.
 *
 * @sa vtkSilhouetteOctreeSource vtkLocalHullSurfacer vtkSilhouetteEvaluator
 */
#ifndef vtkVotingMarchingCubes_h
#define vtkVotingMarchingCubes_h

#include "vtkPolyDataAlgorithm.h"
#include "vtkSilhouetteFiltersModelingModule.h" // for the export macro

class VTKSILHOUETTEFILTERSMODELING_EXPORT vtkVotingMarchingCubes : public vtkPolyDataAlgorithm
{
public:
  static vtkVotingMarchingCubes* New();
  vtkTypeMacro(vtkVotingMarchingCubes, vtkPolyDataAlgorithm);
  void PrintSelf(ostream& os, vtkIndent indent) override;

  /** Where a vertex lies on its lattice edge. */
  enum EdgePlacements
  {
    MIDDLE = 0, ///< in the middle
    EXACT = 1,  ///< at the first point, from the inside end, where the votes fail; pixels are squares
    SUB_PIXEL = 2 ///< the same by distances between pixels: nearer to smooth contours; labels, too, where they may be
  };

  /** Which octree the share goes with. */
  enum Modes
  {
    FAITHFUL = 0,  ///< the strict octree at any share; opens below share 1
    CONSISTENT = 1 ///< an octree of the same background votes; always closed
  };

  ///@{
  /**
   * Share of the views that must call a corner inside, above 0 to 1, default 1. Larger gives a smaller object
   * and believes single views more. Out of range is an error of Update().
   */
  vtkSetMacro(Share, double);
  vtkGetMacro(Share, double);
  ///@}

  ///@{
  /**
   * Where vertices lie on their lattice edges: EXACT (default), MIDDLE or SUB_PIXEL. SUB_PIXEL takes each
   * view's contour by its signed distances, bilinear between pixels, where EXACT follows the pixels' squares:
   * less of the silhouettes is missed, for a distance map of each view. In the mode CONSISTENT it also labels
   * by distances those corners all of whose octants are intersection octants of the last generation, so that
   * the triangles differ from EXACT's here and there; the surface stays closed.
   */
  vtkSetClampMacro(EdgePlacement, int, MIDDLE, SUB_PIXEL);
  vtkGetMacro(EdgePlacement, int);
  void SetEdgePlacementToMiddle() { this->SetEdgePlacement(MIDDLE); }
  void SetEdgePlacementToExact() { this->SetEdgePlacement(EXACT); }
  void SetEdgePlacementToSubPixel() { this->SetEdgePlacement(SUB_PIXEL); }
  ///@}

  ///@{
  /** CONSISTENT (default) or FAITHFUL; see the class. */
  vtkSetClampMacro(Mode, int, FAITHFUL, CONSISTENT);
  vtkGetMacro(Mode, int);
  void SetModeToFaithful() { this->SetMode(FAITHFUL); }
  void SetModeToConsistent() { this->SetMode(CONSISTENT); }
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
  /** The second port's input: the views. */
  void SetViewsConnection(vtkAlgorithmOutput* views) { this->SetInputConnection(1, views); }
  void SetViewsData(vtkDataObject* views) { this->SetInputData(1, views); }
  ///@}

protected:
  vtkVotingMarchingCubes();
  ~vtkVotingMarchingCubes() override = default;

  int FillInputPortInformation(int port, vtkInformation* info) override;
  int RequestData(vtkInformation* request, vtkInformationVector** inputs,
                  vtkInformationVector* outputs) override;

  double Share;
  int EdgePlacement;
  int Mode;
  bool GenerateNormals = false;
  int OutputPointsPrecision = DOUBLE_PRECISION;

private:
  vtkVotingMarchingCubes(const vtkVotingMarchingCubes&) = delete;
  void operator=(const vtkVotingMarchingCubes&) = delete;
};

#endif
