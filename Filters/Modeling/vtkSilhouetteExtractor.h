// SPDX-License-Identifier: BSD-3-Clause
/**
 * @class   vtkSilhouetteExtractor
 * @brief   make silhouettes of photographs
 *
 * Tells object from background in each view's image: by a chroma key, the distance to a background colour, a
 * threshold or the alpha channel, then by polarity, morphology, the largest region and the filling of holes.
 *
 * | port | data set | array | type, components | meaning |
 * | --- | --- | --- | --- | --- |
 * | input 0 | vtkPartitionedDataSetCollection of vtkImageData | point scalars | unsigned char, 1 to 4 | grey; grey, alpha; red, green, blue; red, green, blue, alpha |
 * | | | field `Projection` | 12 values | the view's 3 x 4 matrix |
 * | | | field `IsMask` (optional) | int, 1 | 1: the image is a mask |
 * | | | field `SignIsFree` (optional) | int, 1 | 1: the matrix may have the other sign |
 * | output 0 | vtkPartitionedDataSetCollection of vtkImageData | point scalars `Silhouette` | unsigned char, 1 | 255 object, 0 background |
 * | | | field `Projection` | double, 12 | as in the input, but for a free sign, as are the names |
 * | | | fields `IsMask`, `SignIsFree` | int, 1 | as in the input, where it has them; `SignIsFree` stays 1 once the sign is settled: it tells that it was settled here, not by the camera file |
 *
 * Steps: a pixel is background where ANY criterion that is set says so; then InvertPolarity; then the
 * morphology, in the order in which it was added; then the largest region; then holes. Without a criterion
 * the images must be silhouettes already: an alpha channel that is not opaque everywhere, a mask, or an image
 * of two values. Where the signs of all matrices are free, as those of a P list are, each is made positive at the
 * point nearest the rays through the silhouettes' centroids.
 *
 * Colours, excess, tolerance and threshold are on a scale of 0 to 1, a channel's value / 255.
 *
 * Cost: a few passes over the pixels, more for morphology of a large radius; views are worked on side by
 * side. Memory: a few bytes a pixel. All views are given to every piece.
 *
 * Errors (message naming the view, empty output): an image of another type or number of components; neither a
 * criterion nor a silhouette; a key on a grey image; UseAlpha without an alpha channel; a setting out of
 * range. AbortExecute is honoured: the output is then empty, without an error. VTK does not run an aborted or
 * failed filter again by itself: call Modified() to ask for it.
 *
 * @sa vtkSilhouetteCaptureReader vtkSilhouetteOctreeSource
 */
#ifndef vtkSilhouetteExtractor_h
#define vtkSilhouetteExtractor_h

#include "vtkPartitionedDataSetCollectionAlgorithm.h"
#include "vtkSilhouetteFiltersModelingModule.h" // for the export macro

#include <memory> // for std::unique_ptr

class VTKSILHOUETTEFILTERSMODELING_EXPORT vtkSilhouetteExtractor
    : public vtkPartitionedDataSetCollectionAlgorithm
{
public:
  static vtkSilhouetteExtractor* New();
  vtkTypeMacro(vtkSilhouetteExtractor, vtkPartitionedDataSetCollectionAlgorithm);
  void PrintSelf(ostream& os, vtkIndent indent) override;

  /** The channel of the chroma key. */
  enum KeyChannels
  {
    NONE = -1,
    RED = 0,
    GREEN = 1,
    BLUE = 2
  };

  /** Morphology with a disc: the pixels within radius + 0.5 of the centre. */
  enum Operations
  {
    OPENING = 0, ///< erode, then dilate: removes specks
    CLOSING = 1, ///< dilate, then erode: closes gaps
    DILATE = 2,
    ERODE = 3
  };

  ///@{
  /** Chroma key: NONE (default), RED, GREEN or BLUE. */
  vtkSetClampMacro(KeyChannel, int, NONE, BLUE);
  vtkGetMacro(KeyChannel, int);
  void SetKeyChannelToNone() { this->SetKeyChannel(NONE); }
  void SetKeyChannelToRed() { this->SetKeyChannel(RED); }
  void SetKeyChannelToGreen() { this->SetKeyChannel(GREEN); }
  void SetKeyChannelToBlue() { this->SetKeyChannel(BLUE); }
  ///@}

  ///@{
  /**
   * Background where the key channel exceeds the larger of the other two by this or more; above 0 to 1,
   * default 0.08. Larger calls less background.
   */
  vtkSetMacro(KeyExcess, double);
  vtkGetMacro(KeyExcess, double);
  ///@}

  ///@{
  /** Whether pixels near BackgroundColor are background. Default off. */
  vtkSetMacro(UseBackgroundColor, bool);
  vtkGetMacro(UseBackgroundColor, bool);
  vtkBooleanMacro(UseBackgroundColor, bool);
  ///@}

  ///@{
  /** The background's colour: red, green, blue, 0 to 1 each; default 0, 0, 0. */
  vtkSetVector3Macro(BackgroundColor, double);
  vtkGetVector3Macro(BackgroundColor, double);
  ///@}

  ///@{
  /**
   * Background where the summed absolute difference to BackgroundColor is at most this; 0 to 3, default 0.3.
   * Larger calls more background.
   */
  vtkSetMacro(Tolerance, double);
  vtkGetMacro(Tolerance, double);
  ///@}

  ///@{
  /** Whether dark pixels, up to Threshold, are background. Default off. */
  vtkSetMacro(UseThreshold, bool);
  vtkGetMacro(UseThreshold, bool);
  vtkBooleanMacro(UseThreshold, bool);
  ///@}

  ///@{
  /**
   * Background where the largest channel is at most this; 0 to 1, default 0.5. Larger calls more background.
   */
  vtkSetMacro(Threshold, double);
  vtkGetMacro(Threshold, double);
  ///@}

  ///@{
  /** Whether pixels of alpha up to 127 of 255 are background. Default off. */
  vtkSetMacro(UseAlpha, bool);
  vtkGetMacro(UseAlpha, bool);
  vtkBooleanMacro(UseAlpha, bool);
  ///@}

  ///@{
  /** Whether object and background are swapped, before the morphology. Default off. */
  vtkSetMacro(InvertPolarity, bool);
  vtkGetMacro(InvertPolarity, bool);
  vtkBooleanMacro(InvertPolarity, bool);
  ///@}

  ///@{
  /**
   * The morphology, in the order in which it is carried out; default none. `operation` is OPENING, CLOSING,
   * DILATE or ERODE, `radius` is in pixels, at least 0. Larger radii remove or close more. All radii together, those
   * of opening and closing counted twice, are at most 1000 pixels; more is an error of Update().
   */
  void AddOperation(int operation, int radius);
  void ClearOperations();
  int GetNumberOfOperations();
  ///@}

  ///@{
  /** Whether only the largest 8-connected region of object is kept. Default off. */
  vtkSetMacro(LargestRegion, bool);
  vtkGetMacro(LargestRegion, bool);
  vtkBooleanMacro(LargestRegion, bool);
  ///@}

  ///@{
  /**
   * Holes of fewer pixels than this become object; at least 0, default 0: none. Larger fills larger holes.
   */
  vtkSetMacro(FillHoles, int);
  vtkGetMacro(FillHoles, int);
  ///@}

protected:
  vtkSilhouetteExtractor();
  ~vtkSilhouetteExtractor() override;

  int FillInputPortInformation(int port, vtkInformation* info) override;
  int RequestUpdateExtent(vtkInformation* request, vtkInformationVector** inputs,
                          vtkInformationVector* outputs) override;
  int RequestData(vtkInformation* request, vtkInformationVector** inputs,
                  vtkInformationVector* outputs) override;

  int KeyChannel = NONE;
  double KeyExcess;
  bool UseBackgroundColor = false;
  double BackgroundColor[3] = {0.0, 0.0, 0.0};
  double Tolerance;
  bool UseThreshold = false;
  double Threshold = 0.5;
  bool UseAlpha;
  bool InvertPolarity;
  bool LargestRegion;
  int FillHoles;

private:
  vtkSilhouetteExtractor(const vtkSilhouetteExtractor&) = delete;
  void operator=(const vtkSilhouetteExtractor&) = delete;

  class vtkInternals;
  std::unique_ptr<vtkInternals> Internals;
};

#endif
