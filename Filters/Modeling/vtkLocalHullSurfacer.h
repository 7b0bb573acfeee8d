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
 * | | | field `CoveredOctants` | 64-bit unsigned, 1 | of these, the ones that had no inside corner after the corrections, and were given one |
 * | | | field `CoveringCorners` | 64-bit unsigned, 1 | corners labelled inside for their sake |
 * | | | field `Bridges` | 64-bit unsigned, 1 | joints between components of the survivors |
 * | | | field `CavitiesFilled` | 64-bit unsigned, 1 | cavities labelled inside |
 * | | | field `IgnoredPoints` | 64-bit unsigned, 1 | input points that lie on no lattice edge |
 * | | | fields `HandleCorners`, `TunnelCorners` | 64-bit unsigned, 1 | lattice points labelled inside to join handles that noise had cut; to fill narrow tunnels |
 * | | | field `DroppedOctants` | 64-bit unsigned, 1 | survivors given up as islands and debris, in octants of the last generation's size |
 * | | | field `DroppedLeaves` | 64-bit unsigned, 1 | `LatticeCode` of those of the last generation, ascending; absent where there are none |
 * | | | field `Deficit` | double, 1 | the silhouettes' mean deficit before any correction, in leaf octants; 0 without views |
 * | | | field `Shift` | double, 1 | how far the silhouettes' contours are shifted against the surface's before any correction, mean over the views, in leaf octants; 0 without views |
 * | | | field `Alignment` | double, 1 | mean length of the views' shifts, in pixels; 0 where they were not shifted |
 * | | | field `RepairedPixels` | 64-bit unsigned, 1 | pixels of the silhouettes that were changed: filled, or erased as salt |
 * | | | field `MovedToMiddle` | 64-bit unsigned, 1 | points moved to the middle of their edge against a self-intersection |
 * | output 1 | vtkPolyData, triangles | cells `HullId` | int, 1 | the local hulls, each a closed convex part: in Robust mode of the input surface, before any correction and with islands kept (ThinHulls' are not among them), in Thesis mode those that the surface is made of |
 *
 * The input surface's field data pass through: `IntersectionOctants`, `LostNoCorner`, `LostAllCorners`,
 * `Vertices` and `Faces` are those of the marching-cubes surface.
 *
 * The hulls cost a run of Qhull each and are computed only when asked for: by Update(1), or by a filter that
 * is connected to the second output. Update() alone leaves that output empty, and asking for it later does
 * not compute the surface again.
 *
 * Steps in Robust mode: silhouettes repaired and aligned; debris and islands given up; a globally consistent inside or
 * outside label for each lattice corner, corrected by what the views agree on; every survivor covered, pieces
 * joined; the marching-cubes table over all mixed cells; crossings from the surface where it has them, else
 * from the views, else where the covering asks; thin parts made round. In Thesis mode: the sliced volume's
 * convex parts, chains of them, one convex hull for each chain, and their union on the lattice. The promise
 * holds in both; without islands given up, it is for every survivor, else for those that are kept.
 *
 * Cost: proportional to the octants of the last generation; memory: about 200 bytes for each.
 *
 * Pieces: covering, joints and corrections are decided over the whole, so a piece asks for the whole of its
 * inputs, and gives an even share of the surface's triangles, in order, and of the hulls; the counts are the
 * whole's. The shares add up to the whole. Memory and time are those of the whole for every piece. Where each
 * rank of the Controller asks for its own of as many pieces as there are ranks, this is done once: the first
 * rank alone asks for its inputs, makes the whole, which takes it the whole's time and memory, and sends the
 * others their shares; they ask their inputs for nothing, wait, and hold their share alone. All ranks must
 * then update together, as with every filter that has a controller. Where the first rank fails or is stopped,
 * all are: with its message, or, where its inputs failed, with one that names it, and empty outputs.
 *
 * Limits: an empty octree gives an empty surface without a message. Errors: octree and views that do not
 * belong together; a surface with cells other than triangles; a parameter that mode and outputs asked for use, out of range; single precision too
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

class vtkMultiProcessController;

class VTKSILHOUETTEFILTERSMODELING_EXPORT vtkLocalHullSurfacer : public vtkPolyDataAlgorithm
{
public:
  static vtkLocalHullSurfacer* New();
  vtkTypeMacro(vtkLocalHullSurfacer, vtkPolyDataAlgorithm);
  void PrintSelf(ostream& os, vtkIndent indent) override;

  /** How the surface is made. */
  enum Modes
  {
    ROBUST = 0, ///< consistent labels, corrected by what the views agree on; every survivor covered
    THESIS = 1  ///< one hull for each chain of slices, combined
  };

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
   * Survivors' components that are no further apart than this are joined; leaf octants, at least 0, default
   * 2. Larger joins more, so that a thin part that the carving broke stays in one piece.
   */
  vtkSetMacro(BridgeGap, int);
  vtkGetMacro(BridgeGap, int);
  ///@}

  ///@{
  /**
   * How the surface is made: ROBUST (default), consistent labels corrected by what the views agree on;
   * THESIS, one convex hull for each chain of slices, combined. The second output gives the hulls of the same
   * mode.
   */
  vtkSetClampMacro(Mode, int, ROBUST, THESIS);
  vtkGetMacro(Mode, int);
  void SetModeToRobust() { this->SetMode(ROBUST); }
  void SetModeToThesis() { this->SetMode(THESIS); }
  ///@}

  ///@{
  /**
   * Islands, components of the survivors (26-neighbourhood) with fewer octants than this share of the largest
   * one's, are given up and counted, `DroppedOctants`; 0 to 1, default 0, which keeps all. Larger gives up
   * larger ones. Above 0, where silhouettes are repaired (RepairSilhouettes, Robust mode, with views), so is debris: octants of
   * the last generation that only pixels uphold which the repair finds false, as salt does near the object.
   * Islands are then those of what is left.
   */
  vtkSetMacro(IslandShare, double);
  vtkGetMacro(IslandShare, double);
  ///@}

  ///@{
  /**
   * Whether to repair silhouettes: speckles, filled in the object and erased in the background, and what a single
   * view cuts deep and wide out of the object, filled. Default on. Only in Robust mode, with views.
   */
  vtkSetMacro(RepairSilhouettes, bool);
  vtkGetMacro(RepairSilhouettes, bool);
  vtkBooleanMacro(RepairSilhouettes, bool);
  ///@}

  ///@{
  /**
   * Whether to shift views against an error of their cameras where one is measured. Default on. Only in
   * Robust mode, with views.
   */
  vtkSetMacro(AlignViews, bool);
  vtkGetMacro(AlignViews, bool);
  vtkBooleanMacro(AlignViews, bool);
  ///@}

  ///@{
  /**
   * Whether to move the surface to where the views agree on average, where noise has made silhouettes too
   * small. Default on. Only in Robust mode, with views.
   */
  vtkSetMacro(CorrectField, bool);
  vtkGetMacro(CorrectField, bool);
  vtkBooleanMacro(CorrectField, bool);
  ///@}

  ///@{
  /**
   * Whether to round parts thinner than an octant into hulls of the balls that fit into the silhouettes.
   * Default on. Only in Robust mode, with views.
   */
  vtkSetMacro(ThinHulls, bool);
  vtkGetMacro(ThinHulls, bool);
  vtkBooleanMacro(ThinHulls, bool);
  ///@}

  ///@{
  /**
   * Whether to join handles that noise has cut: ends that the corrected field nearly joins, or whose surviving
   * octants touch, and that are far from each other through the solid. Default on. Only in Robust mode, with views, where
   * the surface is corrected.
   */
  vtkSetMacro(JoinHandles, bool);
  vtkGetMacro(JoinHandles, bool);
  vtkBooleanMacro(JoinHandles, bool);
  ///@}

  ///@{
  /**
   * JoinHandles: how far outside by the corrected field a joint may lie; octants for each octant of the silhouettes'
   * deficit, at least 0, default 1. Larger joins more.
   */
  vtkSetMacro(HandleReach, double);
  vtkGetMacro(HandleReach, double);
  ///@}

  ///@{
  /**
   * Whether to fill narrow tunnels through the solid, which noise and the grid leave. Default on. Only in Robust mode.
   */
  vtkSetMacro(FillTunnels, bool);
  vtkGetMacro(FillTunnels, bool);
  vtkBooleanMacro(FillTunnels, bool);
  ///@}

  ///@{
  /**
   * FillTunnels: a passage is narrow where no cube of this edge fits into it; leaf octants, 1 to 8, default 3. Larger
   * fills wider ones.
   */
  vtkSetMacro(TunnelWidth, int);
  vtkGetMacro(TunnelWidth, int);
  ///@}

  ///@{
  /**
   * JoinHandles, FillTunnels and bridges: the length that tells the object's own loops from those of noise; share of the
   * octants along the root cube's side, at least 0, default 1/3. A narrow tunnel with a longer loop of solid around it stays, ends with a
   * longer way between them through the solid are joined. Larger fills more tunnels and joins fewer handles.
   */
  vtkSetMacro(LoopLength, double);
  vtkGetMacro(LoopLength, double);
  ///@}

  ///@{
  /**
   * RepairSilhouettes: the largest area of a speckle, a region of background that the object encloses; squared leaf
   * octants, 0 to 1e9, default 0.5; a pixel is one in any case. Of object, regions of at most this area, a pixel in
   * any case, and of 8 pixels at most are speckles where more than a pixel is between them and any other object. Larger
   * takes larger ones.
   */
  vtkSetMacro(SpeckleArea, double);
  vtkGetMacro(SpeckleArea, double);
  ///@}

  ///@{
  /**
   * RepairSilhouettes: all speckles are left alone where the pixels of those that the other views dispute are no more
   * than this share of the object's; 0 to 1, default 0.0001. So are they where the other views dispute fewer than half.
   * Larger repairs less.
   */
  vtkSetMacro(SpeckleShare, double);
  vtkGetMacro(SpeckleShare, double);
  ///@}

  ///@{
  /**
   * RepairSilhouettes: how deep in one view's background a corner lies that this view alone rejects; leaf
   * octants, 0 to 1e9, default 0.1. At least 85 over the square of the number of views is asked for, whatever is set:
   * with fewer than 30 views more than the default. Larger finds fewer blobs.
   */
  vtkSetMacro(BlobDepth, double);
  vtkGetMacro(BlobDepth, double);
  ///@}

  ///@{
  /**
   * RepairSilhouettes: the mean depth, along the view, of what it alone cuts away; share of the object's
   * extent, 0 to 1, default 0.125. At least 3 over the number of views is asked for, whatever is set: with fewer than
   * 24 views more than the default. Larger finds fewer blobs.
   */
  vtkSetMacro(BlobChord, double);
  vtkGetMacro(BlobChord, double);
  ///@}

  ///@{
  /**
   * RepairSilhouettes: the least number of corners that a blob rejects; at least 1, default 8. Larger finds
   * fewer blobs.
   */
  vtkSetMacro(BlobCorners, int);
  vtkGetMacro(BlobCorners, int);
  ///@}

  ///@{
  /**
   * CorrectField: silhouettes whose deficit is at most this, and whose shift is small too, are taken as they are;
   * leaf octants, at least 0, default 0.035. Larger corrects less.
   */
  vtkSetMacro(SmallestDeficit, double);
  vtkGetMacro(SmallestDeficit, double);
  ///@}

  ///@{
  /**
   * CorrectField: silhouettes whose contours' mean shift against the surface's is at most this, and whose deficit
   * is small too, are taken as they are; leaf octants, at least 0, default 0.025. Cameras' errors raise it before
   * the deficit. It counts from half of SmallestDeficit on, and if it is more than a tenth of a pixel. Larger
   * corrects less.
   */
  vtkSetMacro(SmallestShift, double);
  vtkGetMacro(SmallestShift, double);
  ///@}

  ///@{
  /**
   * CorrectField: a surface that fills more than this share of its convex hull gets the hull for the base of its
   * field; at least 0, default 0.97, 1 or more for none.
   */
  vtkSetMacro(HullConvexity, double);
  vtkGetMacro(HullConvexity, double);
  ///@}

  ///@{
  /**
   * CorrectField: share of the views that may cut deeper than the model's surface does; the n-th least distance counts, n being
   * this share of the views, at least 2, and no further out than twice the deficit. 0 to 1, default 0.11. Larger
   * keeps more of what is nearly as thin as the noise. The share is that of depth 7 and less deep ones; deeper it is in inverse
   * proportion to 2^depth.
   */
  vtkSetMacro(ModelDissent, double);
  vtkGetMacro(ModelDissent, double);
  ///@}

  ///@{
  /**
   * CorrectField: standard deviation of the field's smoothing, for each octant of deficit; leaf octants, at
   * least 0, default 10. Larger is smoother.
   */
  vtkSetMacro(Smoothing, double);
  vtkGetMacro(Smoothing, double);
  ///@}

  ///@{
  /**
   * CorrectField: the smoothing's largest standard deviation at depth 7, in proportion to 2^depth for others;
   * leaf octants, at least 0, default 3. Larger is smoother where the silhouettes are worst.
   */
  vtkSetMacro(GreatestSmoothing, double);
  vtkGetMacro(GreatestSmoothing, double);
  ///@}

  ///@{
  /**
   * CorrectField: the most that smoothing changes the field, for each octant of deficit, so that thin parts
   * stay; leaf octants, at least 0, default 0.7. Larger smooths more.
   */
  vtkSetMacro(Gentleness, double);
  vtkGetMacro(Gentleness, double);
  ///@}

  ///@{
  /**
   * AlignViews: where chance explains more than this share of the squares of the views' shifts, as noisy contours do and wrong
   * cameras do not, no view is shifted; at least 0, default 0.2. Larger shifts more readily.
   */
  vtkSetMacro(ShiftNoise, double);
  vtkGetMacro(ShiftNoise, double);
  ///@}

  ///@{
  /** AlignViews: rounds of shifting, 1 to 100, default 3. Larger comes closer and costs in proportion. */
  vtkSetMacro(Alignments, int);
  vtkGetMacro(Alignments, int);
  ///@}

  ///@{
  /**
   * CorrectField: views whose contour passes a point within about this distance are heard there; at depth 7,
   * in proportion to 2^depth for others; leaf octants, above 0, default 0.6. Larger averages more views.
   */
  vtkSetMacro(ContourReach, double);
  vtkGetMacro(ContourReach, double);
  ///@}

  ///@{
  /**
   * CorrectField: where survivors stick out of the corrected surface it is raised to a tenth of an octant beneath the silhouettes' own, within about this distance of
   * them, instead of being covered by a corner each; leaf octants, 0 for none up to 8, default 1.5. Larger blends in more widely.
   */
  vtkSetMacro(RaiseWidth, double);
  vtkGetMacro(RaiseWidth, double);
  ///@}

  ///@{
  /**
   * ThinHulls: the least radius of a ball; leaf octants, above 0 to ThinLargestRadius, default 0.12. Larger makes
   * thinner parts fatter.
   */
  vtkSetMacro(ThinSmallestRadius, double);
  vtkGetMacro(ThinSmallestRadius, double);
  ///@}

  ///@{
  /**
   * ThinHulls: the largest radius of a ball; leaf octants, ThinSmallestRadius to 1, default 0.5. Larger lets balls
   * fill more of their octant.
   */
  vtkSetMacro(ThinLargestRadius, double);
  vtkGetMacro(ThinLargestRadius, double);
  ///@}

  ///@{
  /**
   * ThinHulls: how far a point moves at most; leaf octants, 0 to 1, default 0.9. Larger follows the balls
   * further; 0 moves none.
   */
  vtkSetMacro(ThinReach, double);
  vtkGetMacro(ThinReach, double);
  ///@}

  ///@{
  /**
   * Thesis mode: slices are perpendicular to x, y or z for 0, 1 or 2; -1 (default): the axis with the fewest
   * parts a slice.
   */
  vtkSetMacro(SliceAxis, int);
  vtkGetMacro(SliceAxis, int);
  ///@}

  ///@{
  /**
   * Thesis mode: how deep a background cell's centre may lie in the hull of a slice's part; leaf octants, at
   * least 0, default 0.5. Larger gives fewer parts, which bridge more of a concavity.
   */
  vtkSetMacro(SliceTolerance, double);
  vtkGetMacro(SliceTolerance, double);
  ///@}

  ///@{
  /**
   * Thesis mode: how deep below its hull a chain's surface may lie; leaf octants, at least 0, default 0.5.
   * Larger gives fewer and larger hulls, which bridge more of a concavity.
   */
  vtkSetMacro(ChainTolerance, double);
  vtkGetMacro(ChainTolerance, double);
  ///@}

  ///@{
  /**
   * Thesis mode: how much of the smaller of two parts in neighbouring slices the other must overlap for them
   * to be chained; share, above 0 to 1, default 0.5. Larger chains less.
   */
  vtkSetMacro(ChainOverlap, double);
  vtkGetMacro(ChainOverlap, double);
  ///@}

  ///@{
  /**
   * How deep an outside corner of the lattice may lie in a local hull; leaf octants, at least 0, default 0.5.
   * Only for the second output in Robust mode: larger gives fewer and larger hulls, which bridge more of a
   * concavity.
   */
  vtkSetMacro(HullTolerance, double);
  vtkGetMacro(HullTolerance, double);
  ///@}

  ///@{
  /**
   * Edge of the blocks that the hulls' seeds lie in, leaf octants, at least 1, default 4. Only for the second
   * output in Robust mode: larger gives fewer seeds and hulls that keep less detail, sooner.
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
  /**
   * The processes among which the surface is shared out, see "Pieces" above; default: the global controller.
   * Null, or one of a single process: each process makes by itself what it is asked for.
   */
  virtual void SetController(vtkMultiProcessController* controller);
  vtkGetObjectMacro(Controller, vtkMultiProcessController);
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
  int ModifyRequest(vtkInformation* request, int when) override;

protected:
  vtkLocalHullSurfacer();
  ~vtkLocalHullSurfacer() override;

  int FillInputPortInformation(int port, vtkInformation* info) override;
  int RequestUpdateExtent(vtkInformation* request, vtkInformationVector** inputs,
                          vtkInformationVector* outputs) override;
  int RequestData(vtkInformation* request, vtkInformationVector** inputs,
                  vtkInformationVector* outputs) override;

  bool FillCavities;
  double CoverOffset;
  int BridgeGap;
  double HullTolerance;
  int SeedBlock;
  int Mode;
  double IslandShare;
  bool RepairSilhouettes;
  bool AlignViews;
  bool CorrectField;
  bool ThinHulls;
  bool JoinHandles;
  double HandleReach;
  bool FillTunnels;
  int TunnelWidth;
  double LoopLength;
  double SpeckleArea;
  double SpeckleShare;
  double BlobDepth;
  double BlobChord;
  int BlobCorners;
  double SmallestDeficit;
  double SmallestShift;
  double HullConvexity;
  double ModelDissent;
  double Smoothing;
  double GreatestSmoothing;
  double Gentleness;
  double ShiftNoise;
  int Alignments;
  double ContourReach;
  double RaiseWidth;
  double ThinSmallestRadius;
  double ThinLargestRadius;
  double ThinReach;
  int SliceAxis;
  double SliceTolerance;
  double ChainTolerance;
  double ChainOverlap;
  vtkMultiProcessController* Controller = nullptr;
  bool GenerateNormals = false;
  int OutputPointsPrecision = DOUBLE_PRECISION;

private:
  vtkLocalHullSurfacer(const vtkLocalHullSurfacer&) = delete;
  void operator=(const vtkLocalHullSurfacer&) = delete;

  class vtkInternals;
};

#endif
