// SPDX-License-Identifier: BSD-3-Clause
/**
 * Cameras as Agisoft's Metashape, and PhotoScan before it, export them in XML.
 *
 * | camera axes X, Y, Z | what is stored | pixel family | distortion | masks |
 * | --- | --- | --- | --- | --- |
 * | right, down, forward | 4 x 4, the camera to the chunk, rows; rotation, translation and scale, the chunk to the world | corner | k1 k2 k3 p1 p2; fisheye: k1 k2 k3 k4 | none, they are in its project |
 *
 *     document/chunk/sensors/sensor@id,type/calibration@type,class   the one of class `adjusted`, else the first
 *         resolution@width,height   f cx cy b1 b2 k1 k2 k3 k4 p1 p2  numbers; what is not there is 0
 *     document/chunk/cameras//camera@id,sensor_id,component_id,label,enabled/transform
 *     document/chunk/components/component@id/transform               where there is one it stands for the chunk's
 *     document/chunk/transform
 *
 * With (x, y) = (X / Z, Y / Z) distorted to (x', y'), u = width / 2 + cx + (f + b1) x' + b2 y' and v = height / 2 + cy + f y'.
 * Metashape's p1 is OpenCV's p2, and the other way round. PhotoScan's older calibrations, known by `fx`, have
 * u = cx + fx x' + skew y', v = cy + fy y', and p1 and p2 as OpenCV.
 *
 * A view is named by the camera's label, which Metashape gives with the image's ending or without. The world is what Metashape
 * shows: a georeferenced chunk's is geocentric, in metres. Cameras without a transform (not aligned, or the followers of a rig)
 * and those switched off are left out, with a warning that counts them.
 */
#pragma once

#include "CameraFiles.h"

namespace silhouette
{

/** Does the file begin as an XML document with a chunk? Looks at 64 KiB; false where there is no such file. */
bool isMetashapeCameras(const std::filesystem::path& file);

/**
 * Read it. Throws InvalidInput, naming file, line and value: no XML; no chunk with cameras, or several; a camera without a label
 * or of a sensor that is not there; a number that is missing or not finite; a transform that is no rotation
 * and shift; a focal length or a scale that is not above 0; and what OpenCV's lens models do not have: k4 (but of a fisheye),
 * p3, p4, p1 and p2 of a fisheye, sensors that are neither `frame` nor equidistant `fisheye`. Cameras of several components are
 * refused where one of these has no transform. Cost: linear in the file.
 */
CameraFile readMetashapeCameras(const std::filesystem::path& file);

} // namespace silhouette
