// SPDX-License-Identifier: BSD-3-Clause
/**
 * Meshes of known shape, and an Execution on several threads, for the tests of the evaluation.
 */
#pragma once

#include "Execution.h"
#include "Mesh.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <thread>
#include <utility>
#include <vector>

namespace silhouette::test
{

/** Cuts each loop in pieces of uneven length and runs them on threads of their own. */
class ThreadedExecution : public Execution
{
public:
  explicit ThreadedExecution(int threads)
    : Threads(threads)
  {
  }
  void forRanges(std::size_t count, std::size_t grain, const Range& work) override
  {
    std::vector<std::thread> workers;
    std::size_t first = 0;
    for (int t = 0; t < this->Threads && first < count; ++t)
    {
      const std::size_t share = std::max<std::size_t>({ 1, grain, (count - first) / (t + 2) });
      const std::size_t last = t + 1 == this->Threads ? count : std::min(count, first + share);
      workers.emplace_back([&work, first, last] { work(first, last); });
      first = last;
    }
    for (std::thread& worker : workers)
    {
      worker.join();
    }
  }
  int threads() const override { return this->Threads; }

private:
  int Threads;
};

/** Stops when it is asked for the `last`-th time whether to, counted from 0. */
class StoppedAt : public Execution
{
public:
  explicit StoppedAt(int last)
    : Last(last)
  {
  }
  bool cancelled() const override { return this->Asked++ >= this->Last; }
  int asked() const { return this->Asked; }

private:
  int Last;
  mutable int Asked = 0;
};

/** Cancelled from the start; remembers whether progress ever fell. */
class CancelledExecution : public Execution
{
public:
  bool cancelled() const override { return true; }
};

/** Checks that progress is monotone and remembers the last. */
class ProgressExecution : public Execution
{
public:
  void progress(double fraction) override
  {
    this->Monotone = this->Monotone && fraction >= this->Last && fraction <= 1.0;
    this->Last = fraction;
  }
  bool Monotone = true;
  double Last = 0.0;
};

/** Corner c of the box is at bit 0 x, bit 1 y, bit 2 z. 12 triangles, oriented outwards. */
inline Mesh boxMesh(const Eigen::Vector3d& low, const Eigen::Vector3d& high)
{
  Mesh mesh;
  for (int c = 0; c < 8; ++c)
  {
    mesh.points.emplace_back((c & 1 ? high : low)[0], (c & 2 ? high : low)[1], (c & 4 ? high : low)[2]);
  }
  mesh.triangles = { { 0, 2, 3 }, { 0, 3, 1 }, { 4, 5, 7 }, { 4, 7, 6 }, { 0, 1, 5 }, { 0, 5, 4 },
    { 2, 6, 7 }, { 2, 7, 3 }, { 0, 4, 6 }, { 0, 6, 2 }, { 1, 3, 7 }, { 1, 7, 5 } };
  return mesh;
}

inline Mesh boxMesh(double low, double high)
{
  return boxMesh(Eigen::Vector3d::Constant(low), Eigen::Vector3d::Constant(high));
}

inline Mesh tetrahedron(const Eigen::Vector3d& offset, double size)
{
  Mesh mesh;
  mesh.points = { offset, offset + Eigen::Vector3d(size, 0, 0), offset + Eigen::Vector3d(0, size, 0),
    offset + Eigen::Vector3d(0, 0, size) };
  mesh.triangles = { { 0, 2, 1 }, { 0, 1, 3 }, { 0, 3, 2 }, { 1, 2, 3 } };
  return mesh;
}

/** A sphere of 20 * 4^subdivisions triangles about the origin; its points lie on the sphere. */
inline Mesh sphereMesh(int subdivisions, double radius)
{
  const double g = (1.0 + std::sqrt(5.0)) / 2.0;
  Mesh mesh;
  mesh.points = { { -1, g, 0 }, { 1, g, 0 }, { -1, -g, 0 }, { 1, -g, 0 }, { 0, -1, g }, { 0, 1, g },
    { 0, -1, -g }, { 0, 1, -g }, { g, 0, -1 }, { g, 0, 1 }, { -g, 0, -1 }, { -g, 0, 1 } };
  mesh.triangles = { { 0, 11, 5 }, { 0, 5, 1 }, { 0, 1, 7 }, { 0, 7, 10 }, { 0, 10, 11 }, { 1, 5, 9 },
    { 5, 11, 4 }, { 11, 10, 2 }, { 10, 7, 6 }, { 7, 1, 8 }, { 3, 9, 4 }, { 3, 4, 2 }, { 3, 2, 6 },
    { 3, 6, 8 }, { 3, 8, 9 }, { 4, 9, 5 }, { 2, 4, 11 }, { 6, 2, 10 }, { 8, 6, 7 }, { 9, 8, 1 } };
  for (int s = 0; s < subdivisions; ++s)
  {
    std::map<std::pair<int, int>, int> middles;
    const auto middle = [&](int a, int b)
    {
      const auto found = middles.emplace(std::minmax(a, b), int(mesh.points.size()));
      if (found.second)
      {
        mesh.points.push_back(mesh.points[a] + mesh.points[b]);
        mesh.points.back().normalize();
      }
      return found.first->second;
    };
    for (auto& p : mesh.points)
    {
      p.normalize();
    }
    std::vector<Triangle> finer;
    for (const auto& [a, b, c] : mesh.triangles)
    {
      const int ab = middle(a, b), bc = middle(b, c), ca = middle(c, a);
      finer.insert(finer.end(), { { a, ab, ca }, { b, bc, ab }, { c, ca, bc }, { ab, bc, ca } });
    }
    mesh.triangles = finer;
  }
  for (auto& p : mesh.points)
  {
    p = radius * p.normalized();
  }
  return mesh;
}

/** A torus about the z axis, of n x m quadrilaterals cut in two. */
inline Mesh torusMesh(int n, int m, double greatRadius, double smallRadius)
{
  Mesh mesh;
  const double pi = std::acos(-1.0);
  for (int i = 0; i < n; ++i)
  {
    for (int j = 0; j < m; ++j)
    {
      const double u = 2 * pi * i / n, v = 2 * pi * j / m;
      const double r = greatRadius + smallRadius * std::cos(v);
      mesh.points.emplace_back(r * std::cos(u), r * std::sin(u), smallRadius * std::sin(v));
      const int i1 = (i + 1) % n, j1 = (j + 1) % m;
      mesh.triangles.push_back({ i * m + j, i1 * m + j, i1 * m + j1 });
      mesh.triangles.push_back({ i * m + j, i1 * m + j1, i * m + j1 });
    }
  }
  return mesh;
}

/** Both meshes side by side; their points stay apart. */
inline Mesh joined(Mesh a, const Mesh& b)
{
  const auto offset = std::int32_t(a.points.size());
  a.points.insert(a.points.end(), b.points.begin(), b.points.end());
  for (const auto& t : b.triangles)
  {
    a.triangles.push_back({ t[0] + offset, t[1] + offset, t[2] + offset });
  }
  return a;
}

} // namespace silhouette::test
