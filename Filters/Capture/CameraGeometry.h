// SPDX-License-Identifier: BSD-3-Clause
/**
 * From K, R and t to a projection, and what has to hold of them. Every function throws InvalidInput, its text beginning with
 * `where`: the file and the view.
 */
#pragma once

#include "CameraFiles.h"

#include <Eigen/Core>

#include <string>

namespace silhouette
{

using Matrix3 = Eigen::Matrix<double, 3, 3, Eigen::RowMajor>;

/** K as it has to be: fx s cx, 0 fy cy, 0 0 1, focal lengths above 0. */
Matrix3 checkedIntrinsics(const Matrix3& intrinsics, const std::string& where);

/** R as it has to be: R R^T within 1e-3 of the identity, the determinant above 0. */
Matrix3 checkedRotation(const Matrix3& rotation, const std::string& where);

/** The matrix that turns about a vector by the vector's length, in radians. */
Matrix3 rotationAbout(const Vector3& vector);

/** K [R t], which has to be finite. */
Projection composedProjection(const Matrix3& intrinsics, const Matrix3& rotation, const Vector3& translation, const std::string& where);

/** A matrix for a message, row by row: 1 0 0, 0 1 0, 0 0 1. */
std::string formatMatrix(const Matrix3& matrix);

/** How messages call a view of a file without lines: "cameras.yml view 2 'b.png'", counted from 0. */
std::string viewOf(const std::filesystem::path& file, std::size_t index, const std::string& name);

} // namespace silhouette
