// SPDX-License-Identifier: BSD-3-Clause
/**
 * Photographs of a mesh: what a synthetic capture shows beside its silhouettes.
 */
#pragma once

#include "Mesh.h"
#include "View.h"

#include <array>

namespace silhouette
{

/**
 * The photographs' plain background. Its blue exceeds the larger of red and green by 60 / 255 = 0.235 and no
 * object pixel's does at all: the chroma key `blue:0.1` (background where the excess is larger) gives back
 * the clean mask, pixel for pixel.
 */
constexpr std::array<std::uint8_t, 3> photographBackground = {96, 140, 200};

/** Unit normals, zero where there is none. */
struct ShadingNormals
{
  std::vector<Vector3> triangles;
  std::vector<Vector3> points; ///< of a sphere through the neighbours, where there is one
};

/** Throws InvalidInput as checkMesh does. Cost: one pass. */
ShadingNormals shadingNormals(const Mesh& mesh);

/**
 * The object as a camera sees it: where `mask`, the mesh's own silhouette, says object, the nearest
 * triangle's smooth normal (a sharp edge stays sharp), Lambert's law, a light above the camera's left
 * shoulder and some ambient; elsewhere photographBackground. Returns 3 * width * height bytes, red, green,
 * blue, the top row first.
 *
 * `normals` are shadingNormals(mesh), made once for all views. Throws InvalidInput where they or the mask are
 * of another size, or where a triangle is not wholly in front of the camera. Cost: triangles and pixels;
 * memory: 11 bytes a pixel and 24 a point.
 */
std::vector<std::uint8_t> shadePhotograph(const Mesh& mesh, const ShadingNormals& normals,
                                          const Projection& projection, const BinaryImage& mask);

} // namespace silhouette
