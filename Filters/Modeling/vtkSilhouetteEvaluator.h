// SPDX-License-Identifier: BSD-3-Clause
/**
 * @class   vtkSilhouetteEvaluator
 * @brief   judge a surface: is it sound, does it explain the silhouettes, how far is it from the truth
 *
 * Counts what is wrong with a surface as the border of a solid, renders it in each view and compares that
 * with the view's silhouette, and measures its distance to the truth where there is one.
 *
 * | port | data set | array | type, components | meaning |
 * | --- | --- | --- | --- | --- |
 * | input 0 | vtkPolyData, triangles | | | the surface |
 * | input 1 | vtkPartitionedDataSetCollection of vtkImageData | point scalars | unsigned char, 1 | the views: silhouettes, with the field `Projection` |
 * | input 2 (optional) | vtkPolyData, triangles | | | the truth |
 * | input 3 (optional) | vtkHyperTreeGrid | | | the octree that the surface was made from |
 * | output 0 | vtkTable, a row a view | `Name` | string | the view's |
 * | | | `IoU`, `XOR` | double | intersection over union; differing pixels as a share of the silhouette's |
 * | | | `FalseObject`, `FalseBackground`, `SilhouettePixels`, `MeshPixels` | 64-bit unsigned | pixels |
 *
 * Field data of the table, one value each, beside those of the surface, which pass through:
 *
 * | names | type | meaning |
 * | --- | --- | --- |
 * | `Views`; `MeanIoU`, `MeanXOR`; `TotalIoU`, `TotalXOR`; `FalseObject`, `FalseBackground` | int; double; double; 64-bit unsigned | over the views: means; all pixels added up |
 * | `Points`, `UnusedPoints`, `Triangles`, `OpenEdges`, `NonManifoldEdges`, `NonManifoldVertices`, `InconsistentEdges`, `SelfIntersections`, `Components` | 64-bit unsigned | counts; self-intersections are pairs of triangles |
 * | `Genus` | int | absent where the surface is open or not manifold |
 * | `Volume`, `Area` | double | in the capture's unit, cubed and squared |
 * | `Closed`, `Sound` | int, 0 or 1 | sound: closed, manifold, consistent, free of self-intersections, of positive volume |
 * | `MeshToTruthMean`, `TruthToMeshMean`, `MeshToTruthMaximum`, `TruthToMeshMaximum` | double | with a truth: distances in the capture's unit |
 * | `TruthMean`, `TruthRMS`, `TruthHausdorff`, `SampleSpacing` | double | with a truth: over both directions, in the capture's unit |
 * | `LostSurface`; `LeafEdge` | 64-bit unsigned; double | with an octree: octants of the last generation that survived and that the surface neither crosses nor encloses, without those that it says were given up (its field `DroppedLeaves`, of vtkLocalHullSurfacer); their edge |
 *
 * Steps: exact predicates for the self-intersections; a pixel of the rendered surface is object where its
 * centre lies in a projected triangle; distances are from samples by area to the nearest point of a triangle.
 *
 * Cost: self-intersections and distances take most, some seconds a million triangles. Memory: about 200 bytes
 * a triangle.
 *
 * Pieces: the first piece judges the whole of its inputs; the table of any other is empty, and asks them for
 * nothing.
 *
 * Limits: points are one by index alone: merge those of formats without shared points first
 * (vtkCleanPolyData). Errors (message, empty output): a surface or a truth without triangles, or with other
 * cells; what a view lacks; an incomplete octree. AbortExecute is honoured: the output is then empty, without
 * an error. VTK does not run an aborted or failed filter again by itself: call Modified() to ask for it.
 *
 * @sa vtkLocalHullSurfacer vtkVotingMarchingCubes vtkSyntheticCaptureSource
 */
#ifndef vtkSilhouetteEvaluator_h
#define vtkSilhouetteEvaluator_h

#include "vtkSilhouetteFiltersModelingModule.h" // for the export macro
#include "vtkTableAlgorithm.h"

class VTKSILHOUETTEFILTERSMODELING_EXPORT vtkSilhouetteEvaluator : public vtkTableAlgorithm
{
public:
  static vtkSilhouetteEvaluator* New();
  vtkTypeMacro(vtkSilhouetteEvaluator, vtkTableAlgorithm);
  void PrintSelf(ostream& os, vtkIndent indent) override;

  ///@{
  /**
   * Distance between the samples of the comparison with the truth, in the unit of the capture; above 0, or 0
   * (default): the octree's leaf edge where there is an octree, else a 512th of the truth's longest side.
   * Larger is faster and coarser.
   */
  vtkSetMacro(SampleSpacing, double);
  vtkGetMacro(SampleSpacing, double);
  ///@}

  ///@{
  /** The second port's input: the views. */
  void SetViewsConnection(vtkAlgorithmOutput* views) { this->SetInputConnection(1, views); }
  void SetViewsData(vtkDataObject* views) { this->SetInputData(1, views); }
  ///@}

  ///@{
  /** The third port's input: the truth. */
  void SetTruthConnection(vtkAlgorithmOutput* truth) { this->SetInputConnection(2, truth); }
  void SetTruthData(vtkDataObject* truth) { this->SetInputData(2, truth); }
  ///@}

  ///@{
  /** The fourth port's input: the octree. */
  void SetOctreeConnection(vtkAlgorithmOutput* octree) { this->SetInputConnection(3, octree); }
  void SetOctreeData(vtkDataObject* octree) { this->SetInputData(3, octree); }
  ///@}

protected:
  vtkSilhouetteEvaluator();
  ~vtkSilhouetteEvaluator() override = default;

  int FillInputPortInformation(int port, vtkInformation* info) override;
  int RequestUpdateExtent(vtkInformation* request, vtkInformationVector** inputs,
                          vtkInformationVector* outputs) override;
  int RequestData(vtkInformation* request, vtkInformationVector** inputs,
                  vtkInformationVector* outputs) override;

  double SampleSpacing = 0.0;

private:
  vtkSilhouetteEvaluator(const vtkSilhouetteEvaluator&) = delete;
  void operator=(const vtkSilhouetteEvaluator&) = delete;
};

#endif
