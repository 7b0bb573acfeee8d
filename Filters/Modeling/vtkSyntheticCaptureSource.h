// SPDX-License-Identifier: BSD-3-Clause
/**
 * @class   vtkSyntheticCaptureSource
 * @brief   photograph a known solid with known cameras, with noise of a known strength
 *
 * Makes a capture with its truth: the silhouettes and shaded photographs of a shape or of a given mesh, and
 * the cameras, each with the kinds of noise that real captures suffer from.
 *
 * | port | data set | array | type, components | meaning |
 * | --- | --- | --- | --- | --- |
 * | input 0 (optional) | vtkPolyData, triangles | | | the solid; takes the place of Shape |
 * | output 0 | vtkPartitionedDataSetCollection of vtkImageData | point scalars | unsigned char, 1 | the silhouettes, with their noise: 255 object, 0 background |
 * | | | field `Projection` | double, 12 | the view's 3 x 4 matrix as reported, with the camera noise |
 * | | | field `IsMask` | int, 1 | 1 |
 * | output 1 | vtkPolyData, triangles | | | the truth |
 * | output 2 | vtkPartitionedDataSetCollection of vtkImageData | point scalars | unsigned char, 3 | the photographs, without noise, on a plain background |
 * | | | field `Projection` | double, 12 | as in output 0 |
 *
 * Steps: the cameras are placed on three rings around the mesh's bounding sphere, z upwards; each view is
 * rendered (a pixel is object where its centre lies in a projected triangle); contour noise comes first, then
 * blobs, then pixels. What is drawn depends on Seed, the kind of noise and the view's number alone.
 *
 * Cost, in orders of magnitude: 0.1 s a view for each megapixel, as much again with contour noise, and 0.01 s for
 * each 100,000 triangles. Memory: 9 bytes a pixel and view. All views are given to every piece.
 *
 * Errors (message, empty outputs): a setting out of range; a mesh that is empty, not finite or not of
 * triangles. AbortExecute is honoured: the outputs are then empty, without an error. VTK does not run an
 * aborted or failed filter again by itself: call Modified() to ask for it.
 *
 * @sa vtkSilhouetteOctreeSource vtkSilhouetteEvaluator
 */
#ifndef vtkSyntheticCaptureSource_h
#define vtkSyntheticCaptureSource_h

#include "vtkPartitionedDataSetCollectionAlgorithm.h"
#include "vtkSilhouetteFiltersModelingModule.h" // for the export macro

class vtkPolyData;

class VTKSILHOUETTEFILTERSMODELING_EXPORT vtkSyntheticCaptureSource
    : public vtkPartitionedDataSetCollectionAlgorithm
{
public:
  static vtkSyntheticCaptureSource* New();
  vtkTypeMacro(vtkSyntheticCaptureSource, vtkPartitionedDataSetCollectionAlgorithm);
  void PrintSelf(ostream& os, vtkIndent indent) override;

  /** The solids; all lie in the cube from -1 to 1. */
  enum Shapes
  {
    JUG = 0,    ///< a jug with a handle: genus 1, concave, thin parts
    SPHERE = 1, ///< of radius 0.9
    TORUS = 2,  ///< of radii 0.6 and 0.25, tilted
    TWIG = 3,   ///< a bare twig of thin tubes
    PEBBLE = 4, ///< convex and rounded, tilted
    PUMPKIN = 5 ///< lobes with grooves, a curved stalk: concave
  };

  ///@{
  /** The solid, where the input gives none: JUG (default), SPHERE, TORUS, TWIG, PEBBLE or PUMPKIN. */
  vtkSetClampMacro(Shape, int, JUG, PUMPKIN);
  vtkGetMacro(Shape, int);
  void SetShapeToJug() { this->SetShape(JUG); }
  void SetShapeToSphere() { this->SetShape(SPHERE); }
  void SetShapeToTorus() { this->SetShape(TORUS); }
  void SetShapeToTwig() { this->SetShape(TWIG); }
  void SetShapeToPebble() { this->SetShape(PEBBLE); }
  void SetShapeToPumpkin() { this->SetShape(PUMPKIN); }
  ///@}

  ///@{
  /**
   * Fineness of the shape's mesh, relative to the default 1, 0.5 to 4. Larger is finer; the triangles grow
   * with its square.
   */
  vtkSetMacro(Refinement, double);
  vtkGetMacro(Refinement, double);
  ///@}

  ///@{
  /** Number of views, 1 to 10000, default 36. Larger carves closer and costs in proportion. */
  vtkSetMacro(NumberOfViews, int);
  vtkGetMacro(NumberOfViews, int);
  ///@}

  ///@{
  /** Width of the images, pixels, 1 to 16384, default 1024. Larger is finer. */
  vtkSetMacro(Width, int);
  vtkGetMacro(Width, int);
  ///@}

  ///@{
  /** Height of the images, pixels, 1 to 16384, default 1024. Larger is finer. */
  vtkSetMacro(Height, int);
  vtkGetMacro(Height, int);
  ///@}

  ///@{
  /** Any number, default 0: another one draws other noise of the same strength. */
  vtkSetMacro(Seed, vtkIdType);
  vtkGetMacro(Seed, vtkIdType);
  ///@}

  ///@{
  /** Standard deviation of the contours' displacement, smooth along them; pixels, 0 (default) to 1000. */
  vtkSetMacro(NoiseContour, double);
  vtkGetMacro(NoiseContour, double);
  ///@}

  ///@{
  /** Number of masks that discs are cut out of, 0 (default) to the number of views. */
  vtkSetMacro(NoiseBlobs, int);
  vtkGetMacro(NoiseBlobs, int);
  ///@}

  ///@{
  /** Share of each mask's pixels that flip, 0 (default) to 1. */
  vtkSetMacro(NoisePixels, double);
  vtkGetMacro(NoisePixels, double);
  ///@}

  ///@{
  /** Standard deviation of the principal points as reported; pixels, 0 (default) to 1e6. */
  vtkSetMacro(NoiseCamera, double);
  vtkGetMacro(NoiseCamera, double);
  ///@}

  ///@{
  /** Standard deviation of the turn about each camera's axes as reported; degrees, 0 (default) to 90. */
  vtkSetMacro(NoiseRotation, double);
  vtkGetMacro(NoiseRotation, double);
  ///@}

  ///@{
  /** The outputs by type: the truth, and the photographs. */
  vtkPolyData* GetTruthOutput();
  vtkPartitionedDataSetCollection* GetPhotographsOutput();
  ///@}

  /** A mesh to photograph, without a pipeline. */
  void SetInputData(vtkPolyData* mesh);

  vtkTypeBool ProcessRequest(vtkInformation* request, vtkInformationVector** inputs,
                             vtkInformationVector* outputs) override;

protected:
  vtkSyntheticCaptureSource();
  ~vtkSyntheticCaptureSource() override = default;

  int FillInputPortInformation(int port, vtkInformation* info) override;
  int FillOutputPortInformation(int port, vtkInformation* info) override;
  int RequestInformation(vtkInformation* request, vtkInformationVector** inputs,
                         vtkInformationVector* outputs) override;
  int RequestData(vtkInformation* request, vtkInformationVector** inputs,
                  vtkInformationVector* outputs) override;

  int Shape = JUG;
  double Refinement;
  int NumberOfViews;
  int Width;
  int Height;
  vtkIdType Seed;
  double NoiseContour;
  int NoiseBlobs;
  double NoisePixels;
  double NoiseCamera;
  double NoiseRotation;

private:
  vtkSyntheticCaptureSource(const vtkSyntheticCaptureSource&) = delete;
  void operator=(const vtkSyntheticCaptureSource&) = delete;
};

#endif
