// SPDX-License-Identifier: BSD-3-Clause
/**
 * @class   vtkSilhouetteCaptureReader
 * @brief   read a capture: calibrated photographs, or their masks
 *
 * Reads the images and camera matrices of a folder or of a camera file: a P list (`projections.txt`: image name and the 3 x 4 matrix, a
 * line a view), Middlebury's `*_par.txt`, `transforms.json` of NeRF, Blender and nerfstudio, a COLMAP model, or cameras of OpenCV, Metashape, PMVS or NeuS. Lens
 * distortion is taken out of the images.
 *
 * | port | data set | array | type, components | meaning |
 * | --- | --- | --- | --- | --- |
 * | output 0 | vtkPartitionedDataSetCollection of vtkImageData, named by their files | point scalars | unsigned char, 1 to 4 | photographs or masks |
 * | | | field `Projection` | double, 12 | the view's 3 x 4 matrix, row by row |
 * | | | field `IsMask` | int, 1 | 1 where the image was found as a mask |
 * | | | field `SignIsFree` | int, 1 | 1 where the camera file leaves the matrix's sign open, as a P list does |
 * | output 1 | vtkPolyData, lines | cells `View` | int, 1 | the cameras: centre, image corners; the view's number |
 *
 * | format | pixel family | sign of w | lens | images |
 * | --- | --- | --- | --- | --- |
 * | P list | not stated: integer, (0, 0) is the first pixel's centre; an option | free: made positive at the object | none | `images/` and `masks/` with equal stems, or beside the camera file |
 * | Middlebury | not stated: integer; an option | positive in front | none | the same |
 * | transforms.json | corner: brought to integer | positive in front | k1 k2 p1 p2 k3; fisheye k1 to k4 | as the file names them, masks by `mask_path`; or as above |
 * | COLMAP: cameras and images, .bin or .txt | corner: brought to integer | positive in front | all models up to FULL_OPENCV, SIMPLE_RADIAL_FISHEYE, RADIAL_FISHEYE | as of a P list; beside the model, or beside the folder `sparse` that it lies in |
 * | OpenCV: cameras.yml, .yaml, .xml, .json | integer | positive in front; of P alone free | OpenCV's, and its fisheye | as of a P list |
 * | Metashape: *.xml | corner: brought to integer | positive in front | k1 k2 k3 p1 p2 b1 b2; fisheye k1 to k4 | as of a P list |
 * | PMVS: txt/00000000.txt | integer | free | none | `visualize/` and `masks/` |
 * | NeuS, IDR: cameras_sphere.npz, cameras.npz | integer | positive in front | none | `image/` and `mask/`, by sorted order |
 *
 * In a folder they are looked for in this order, COLMAP's in the folder, in `sparse`, then in `sparse/0`. The matrices of output 0 are of the integer family.
 *
 * Images are PNG, JPEG, PNM (P5, P6), BMP (8 or 24 bits) or TIFF; 16-bit values are brought to 8 bits. Where a
 * `*_good_silhouette_images.txt` exists only its views are read, unless Views says otherwise.
 *
 * Steps: the camera file is read and each view's files are found; images are decoded side by side, each by a
 * reader of its own; where a camera has a lens that bends, its image becomes that of one that does not, of the same focal lengths, principal point and size, masks of two
 * values keeping these; matrices of free sign are negated where the object would lie
 * behind the camera: the object is the point nearest the rays through the silhouettes' centroids, or through
 * the images' centres where they are photographs, of which vtkSilhouetteExtractor finds the silhouettes and
 * looks again.
 *
 * Cost and memory: the images'. All views are given to every piece; the cameras to the first.
 *
 * Limits: what comes to lie beyond an image that is undistorted is cut off, and it has at most 32766 pixels a side; no Exif rotation, of which a warning tells; files that change are not noticed: call
 * Modified(). Warnings, output made: images that no view finds, masks that none finds where a view has none, data that are damaged but were read. Errors
 * (message naming the file, empty outputs): no camera file (`projections.txt` comes first), several `*_par.txt` without it, a line that is not understood, a camera
 * model that is not read, the corner family asked for where the format states its own, a
 * missing or unreadable image, a mask of another size than its photograph, an image of another size than its camera is for. AbortExecute is honoured: the
 * outputs are then empty, without an error; VTK does not run an aborted or failed filter again by itself:
 * call Modified() to ask for it.
 *
 * @sa vtkSilhouetteExtractor vtkSilhouetteOctreeSource
 */
#ifndef vtkSilhouetteCaptureReader_h
#define vtkSilhouetteCaptureReader_h

#include "vtkPartitionedDataSetCollectionAlgorithm.h"
#include "vtkSilhouetteFiltersModelingModule.h" // for the export macro

class vtkPolyData;

class VTKSILHOUETTEFILTERSMODELING_EXPORT vtkSilhouetteCaptureReader
    : public vtkPartitionedDataSetCollectionAlgorithm
{
public:
  static vtkSilhouetteCaptureReader* New();
  vtkTypeMacro(vtkSilhouetteCaptureReader, vtkPartitionedDataSetCollectionAlgorithm);
  void PrintSelf(ostream& os, vtkIndent indent) override;

  /** Which of a view's files is read. */
  enum ImageChoices
  {
    MASKS_WHERE_PRESENT = 0, ///< the mask, or else the photograph
    PHOTOGRAPHS = 1,
    MASKS = 2
  };

  /** Where the camera file's pixel coordinates put the centre of the first pixel. */
  enum PixelFamilies
  {
    INTEGER = 0, ///< at (0, 0)
    CORNER = 1   ///< at (0.5, 0.5)
  };

  ///@{
  /** The folder of the capture, or its camera file. */
  vtkSetFilePathMacro(FileName);
  vtkGetFilePathMacro(FileName);
  ///@}

  ///@{
  /**
   * The views to read, by number from 0, range or image name: "0,3,5-9", "a.png,b.png". Null or empty
   * (default): all, or the good silhouettes where the capture lists them.
   */
  vtkSetStringMacro(Views);
  vtkGetStringMacro(Views);
  ///@}

  ///@{
  /** Which images are read: MASKS_WHERE_PRESENT (default), PHOTOGRAPHS or MASKS. */
  vtkSetClampMacro(ImageChoice, int, MASKS_WHERE_PRESENT, MASKS);
  vtkGetMacro(ImageChoice, int);
  void SetImageChoiceToMasksWherePresent() { this->SetImageChoice(MASKS_WHERE_PRESENT); }
  void SetImageChoiceToPhotographs() { this->SetImageChoice(PHOTOGRAPHS); }
  void SetImageChoiceToMasks() { this->SetImageChoice(MASKS); }
  ///@}

  ///@{
  /** The pixel coordinates of a camera file whose format does not state them: INTEGER (default) or CORNER; half a pixel apart. CORNER is an error with a format that does. */
  vtkSetClampMacro(PixelFamily, int, INTEGER, CORNER);
  vtkGetMacro(PixelFamily, int);
  void SetPixelFamilyToInteger() { this->SetPixelFamily(INTEGER); }
  void SetPixelFamilyToCorner() { this->SetPixelFamily(CORNER); }
  ///@}

  /** 1 where `fileName` is a capture's folder or camera file. Decodes no image. */
  static int CanReadFile(VTK_FILEPATH const char* fileName);

  /** The second output: the cameras. */
  vtkPolyData* GetCamerasOutput();

  vtkTypeBool ProcessRequest(vtkInformation* request, vtkInformationVector** inputs,
                             vtkInformationVector* outputs) override;

protected:
  vtkSilhouetteCaptureReader();
  ~vtkSilhouetteCaptureReader() override;

  int FillOutputPortInformation(int port, vtkInformation* info) override;
  int RequestInformation(vtkInformation* request, vtkInformationVector** inputs,
                         vtkInformationVector* outputs) override;
  int RequestData(vtkInformation* request, vtkInformationVector** inputs,
                  vtkInformationVector* outputs) override;

  char* FileName = nullptr;
  char* Views = nullptr;
  int ImageChoice = MASKS_WHERE_PRESENT;
  int PixelFamily = INTEGER;

private:
  vtkSilhouetteCaptureReader(const vtkSilhouetteCaptureReader&) = delete;
  void operator=(const vtkSilhouetteCaptureReader&) = delete;
};

#endif
