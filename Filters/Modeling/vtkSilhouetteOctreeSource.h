// SPDX-License-Identifier: BSD-3-Clause
/**
 * @class   vtkSilhouetteOctreeSource
 * @brief   carve the octree of an object's silhouettes
 *
 * Grows an octree, generation by generation, from a cube that holds the object: an octant that the
 * silhouettes call background is carved, one that they call object is kept, the others are subdivided to the
 * last generation. The result is VTK's own octree, a vtkHyperTreeGrid.
 *
 * | port | data set | array | type, components | meaning |
 * | --- | --- | --- | --- | --- |
 * | input 0 (optional) | vtkPartitionedDataSetCollection of vtkImageData | point scalars | unsigned char, 1 | the silhouettes: object where above 127, or where not 0 if the image's greatest value is 1 |
 * | | | field `Projection` | 12 values | each view's 3 x 4 matrix, row by row |
 * | output 0 | vtkHyperTreeGrid | cells `State` | unsigned char, 1 | 0 background (masked), 1 intersection, 2 inside |
 * | | | cells `Generation` | unsigned char, 1 | subdivisions of the root cube |
 * | | | cells `LatticeCode` | 64-bit unsigned, 1 | Morton code within the generation |
 * | | | field `Depth`, `TreeGeneration`, `NumberOfViews`, `BackgroundVotes`, `OutsidePolicy` | int, 1 | what the octree was made with |
 * | | | field `RootCube` | double, 1 | four values: origin and edge of the root cube |
 * | | | field `ViewsFingerprint`, `OctantsTested`, `ViewTests` | 64-bit unsigned, 1 | names the views; counts of the work |
 * | | | field `InsideOctants`, `IntersectionOctants` | 64-bit unsigned, 1 | inside octants of all generations, intersection octants of the last |
 * | | | field `CarvedByView` | double, 1 | a value a view: share of the root cube that the view carved |
 * | | | field `Piece`, `NumberOfPieces` | int, 1 | the piece of the octree that this is; the counts and shares above are the piece's, and add up |
 * | | | field `Dilation` | int, 1 | pixels by which the silhouettes were dilated; 0 without AutomaticTolerance |
 * | | | field `UncoveredShare`, `StrictUncoveredShare` | double, 1 | with AutomaticTolerance: share of the silhouettes' pixels, mean over the views, in parts that no octant covers, of this octree and of one with BackgroundVotes and without dilation |
 * | output 1 | vtkPartitionedDataSetCollection | as the input, further field arrays too | | the views used, prepared: filters further down do no work on them twice; dilated ones where `Dilation` is above 0 |
 *
 * A matrix P maps a world point to a pixel, w (u, v, 1) = P (X, Y, Z, 1), with w > 0 in front of the camera,
 * u to the right, v down, the centre of the top-left pixel at (0, 0); the images are in VTK's own order,
 * bottom row first. Matrices are taken as they are, sign included. Views of the input come first, those of
 * AddView() follow; their images may differ in size.
 *
 * Steps: the views are checked and their pixels summed; the root cube is found, or taken from Bounds; each
 * octant is tested in each view, first by its bounding box, then by its exact polygon; a view that is decided
 * for an octant is not asked again for its descendants.
 *
 * Cost: proportional to the pairs of octant and view at the silhouettes' borders, about four times as many
 * for each unit of Depth. Memory: about 16 bytes an octant while carving, 10 in the output, and 1.2 bytes a
 * pixel.
 *
 * Errors (message, empty outputs): no views; an image that is not a silhouette; a matrix that is missing, has
 * other than 12 values, is not finite or of rank below 3; a parameter out of range; automatic bounds of views
 * that do not bound the object; nothing survives. Warnings, output made: a silhouette that is all object or
 * is cut by its image's border; one view with given bounds; a camera inside the root cube; an object that is
 * cut by it; views that are mirrored or not metric, or have the object behind them; with AutomaticTolerance
 * more than a twentieth of the silhouettes uncovered.
 *
 * AbortExecute is honoured: the outputs are then empty, without an error. VTK does not run an aborted or
 * failed filter again by itself: call Modified() to ask for it.
 *
 * Pieces: asked for piece p of n (vtkAlgorithm::UpdatePiece(), or ParaView's engine on each rank), the source
 * carves the trees of that piece alone, from all views. It finds these by a coarse carve of its
 * own, without asking other processes; with AutomaticTolerance the whole is carved first. Piece 0 does so each time; other pieces
 * take over bounds, division and tolerance from the piece made before with the same views and settings, and give no warning again. That nothing
 * survives is an error where the coarse carve shows it; a piece without survivors is none. The second of
 * 2^31 - 1 pieces, which filters ask for that need nothing, is empty without any view being read.
 *
 * Limits: XML files keep the cell arrays but not the field data, and need
 * SetDataModeToBinary(); an octree read from one cannot go through the surface filters.
 *
 * See D. Shin and T. Tjahjadi, "Local hull-based surface construction of volumetric data from silhouettes",
 * IEEE Transactions on Image Processing 17 (8), 2008; R. Szeliski, "Rapid octree
 * construction from image sequences", CVGIP: Image Understanding 58 (1), 1993.
 *
 * @sa vtkSilhouetteCaptureReader vtkSilhouetteExtractor vtkVotingMarchingCubes vtkLocalHullSurfacer
 */
#ifndef vtkSilhouetteOctreeSource_h
#define vtkSilhouetteOctreeSource_h

#include "vtkAlgorithm.h"
#include "vtkSilhouetteFiltersModelingModule.h" // for the export macro

#include <memory> // for std::unique_ptr

class vtkHyperTreeGrid;
class vtkImageData;
class vtkPartitionedDataSetCollection;

class VTKSILHOUETTEFILTERSMODELING_EXPORT vtkSilhouetteOctreeSource : public vtkAlgorithm
{
public:
  static vtkSilhouetteOctreeSource* New();
  vtkTypeMacro(vtkSilhouetteOctreeSource, vtkAlgorithm);
  void PrintSelf(ostream& os, vtkIndent indent) override;

  /** What a view says beyond the sides of its image. */
  enum OutsidePolicies
  {
    BORDER = 0,    ///< abstains beyond a side that the silhouette touches, else background
    UNKNOWN = 1,   ///< abstains
    BACKGROUND = 2 ///< background
  };

  ///@{
  /**
   * Views one by one: a silhouette, its matrix row by row, and a name for messages (view numbers serve where
   * it is null). The image is kept by reference and may change; call its Modified() then.
   */
  void AddView(vtkImageData* silhouette, const double p[12], const char* name = nullptr);
  void RemoveAllViews();
  int GetNumberOfAddedViews();
  ///@}

  ///@{
  /**
   * Subdivisions of the root cube, 1 to 16, default 8. Each unit more halves the octants' edge, and takes
   * about four times the time and memory. Out of range is an error of Update().
   */
  vtkSetMacro(Depth, int);
  vtkGetMacro(Depth, int);
  ///@}

  ///@{
  /**
   * If above 0: instead of Depth, the least depth whose octants' edge is at most this, in the unit of the
   * capture. Default 0: Depth is used. Larger is coarser. Errors of Update(): negative, not finite, or so small that
   * a depth above 16 is needed.
   */
  vtkSetMacro(LeafEdge, double);
  vtkGetMacro(LeafEdge, double);
  ///@}

  ///@{
  /**
   * Whether the root cube is found from silhouettes and matrices (default), or is the smallest cube around
   * Bounds with the same centre.
   */
  vtkSetMacro(AutomaticBounds, bool);
  vtkGetMacro(AutomaticBounds, bool);
  vtkBooleanMacro(AutomaticBounds, bool);
  ///@}

  ///@{
  /**
   * A box that holds the object, xmin, xmax, ymin, ymax, zmin, zmax, in the unit of the capture; default -1,
   * 1 each. Used where AutomaticBounds is off. A larger box gives larger octants at the same Depth; a box
   * that does not hold the object cuts it, with a warning.
   */
  vtkSetVector6Macro(Bounds, double);
  vtkGetVector6Macro(Bounds, double);
  ///@}

  ///@{
  /** The same box by its lowest corner, as box widgets have it; the edges stay. Default -1 each. */
  void SetBoundsOrigin(double x, double y, double z);
  void SetBoundsOrigin(const double origin[3]) { this->SetBoundsOrigin(origin[0], origin[1], origin[2]); }
  void GetBoundsOrigin(double origin[3]);
  ///@}

  ///@{
  /** The same box by its edges; the lowest corner stays. Default 2 each. */
  void SetBoundsSize(double x, double y, double z);
  void SetBoundsSize(const double size[3]) { this->SetBoundsSize(size[0], size[1], size[2]); }
  void GetBoundsSize(double size[3]);
  ///@}

  ///@{
  /**
   * How many views may call an octant background without its being carved, 0 to the number of views less one;
   * default 0, the strict octree. Larger forgives more wrong silhouettes and gives a larger object.
   */
  vtkSetMacro(BackgroundVotes, int);
  vtkGetMacro(BackgroundVotes, int);
  ///@}

  ///@{
  /**
   * Whether to look if the octree covers the silhouettes, and where parts of them are left out, because they are thinner than
   * the noise and were cut (what noise takes off all round is left to the surface), to carve with the least tolerance that leaves at most 0.1 % of them in lost parts: background votes from
   * BackgroundVotes up to a tenth of the views (none of fewer than ten), and if these do not do it, silhouettes dilated by up to half
   * an octant besides. Default off. On, the octree's field `BackgroundVotes` says what was taken: a
   * vtkVotingMarchingCubes further down needs the share that this leaves, (views - votes) / views. Clean
   * silhouettes are carved as with off, with one measure more; others take three to ten carves.
   */
  vtkSetMacro(AutomaticTolerance, bool);
  vtkGetMacro(AutomaticTolerance, bool);
  vtkBooleanMacro(AutomaticTolerance, bool);
  ///@}

  ///@{
  /**
   * What a view says of points outside its image: BORDER (default), UNKNOWN or BACKGROUND. BACKGROUND carves
   * most, UNKNOWN least.
   */
  vtkSetClampMacro(OutsidePolicy, int, BORDER, BACKGROUND);
  vtkGetMacro(OutsidePolicy, int);
  void SetOutsidePolicyToBorder() { this->SetOutsidePolicy(BORDER); }
  void SetOutsidePolicyToUnknown() { this->SetOutsidePolicy(UNKNOWN); }
  void SetOutsidePolicyToBackground() { this->SetOutsidePolicy(BACKGROUND); }
  ///@}

  ///@{
  /** The outputs by type: the octree, and the views used. */
  vtkHyperTreeGrid* GetOutput();
  vtkPartitionedDataSetCollection* GetViewsOutput();
  ///@}

  /** The views as a data object, without a pipeline. */
  void SetInputData(vtkPartitionedDataSetCollection* views);

  /** Also that of the images given by AddView(). */
  vtkMTimeType GetMTime() override;

  vtkTypeBool ProcessRequest(vtkInformation* request, vtkInformationVector** inputs,
                             vtkInformationVector* outputs) override;

protected:
  vtkSilhouetteOctreeSource();
  ~vtkSilhouetteOctreeSource() override;

  int FillInputPortInformation(int port, vtkInformation* info) override;
  int FillOutputPortInformation(int port, vtkInformation* info) override;
  int RequestData(vtkInformation* request, vtkInformationVector** inputs, vtkInformationVector* outputs);

  int Depth;
  double LeafEdge = 0.0;
  bool AutomaticBounds = true;
  double Bounds[6] = {-1.0, 1.0, -1.0, 1.0, -1.0, 1.0};
  int BackgroundVotes;
  bool AutomaticTolerance = false;
  int OutsidePolicy;

private:
  vtkSilhouetteOctreeSource(const vtkSilhouetteOctreeSource&) = delete;
  void operator=(const vtkSilhouetteOctreeSource&) = delete;

  class vtkInternals;
  std::unique_ptr<vtkInternals> Internals;
};

#endif
