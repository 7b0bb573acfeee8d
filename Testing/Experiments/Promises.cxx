// SPDX-License-Identifier: BSD-3-Clause
#include "Promises.h"

#include "Methods.h"

#include <cstdio>

namespace silhouette::experiments
{
namespace
{

std::string describe(const Row& row)
{
  return row.method + " on " + row.at.object + ", " + describeNoise(row.at.noise, row.at.strength) +
         ", seed " + std::to_string(row.at.seed);
}

const Row* sameCase(const std::vector<Row>& rows, const Row& row, const std::string& method)
{
  Row wanted = row;
  wanted.method = method;
  for (const Row& other : rows)
  {
    if (sameRun(other, wanted))
    {
      return &other;
    }
  }
  return nullptr;
}

void checkOrder(const Order& order, const std::vector<Row>& rows, const Row& row,
                std::vector<std::string>& found)
{
  const bool applies = row.method == order.better &&
                       (row.at.noise == CleanName) == (order.where == Where::Clean) &&
                       !(order.where == Where::NoisyButPixels && row.at.noise == "pixels");
  const Row* other = applies ? sameCase(rows, row, order.than) : nullptr;
  if (!other || !row.failure.empty() || !other->failure.empty())
  {
    return;
  }
  const double most = order.factor * other->value[Error] + order.allowance;
  if (!(row.value[Error] <= most))
  {
    char text[128];
    std::snprintf(text, sizeof text, ": error %.4f, more than %.4f (%s has %.4f)", row.value[Error], most,
                  order.than, other->value[Error]);
    found.push_back(describe(row) + text);
  }
}

} // namespace

const std::vector<Promise>& promises()
{
  static const std::vector<Promise> table = {
      {"open", [](const Row& r) { return r.value[Faces] > 0 && r.value[OpenEdges] == 0; }},
      {"not manifold",
       [](const Row& r) {
         return r.value[NonManifoldEdges] + r.value[NonManifoldVertices] + r.value[InconsistentEdges] == 0;
       }},
      {"inside out", [](const Row& r) { return r.value[Volume] > 0; }},
      {"self-intersecting", [](const Row& r) { return r.value[SelfIntersections] == 0; }},
      {"loses octants", [](const Row& r) { return r.value[Lost] == 0; }},
      {"in more pieces than the survivors",
       [](const Row& r) { return r.value[Pieces] <= r.value[SurvivorPieces]; }}};
  return table;
}

const std::vector<Promise>& islandPromises()
{
  static const std::vector<Promise> table = {
      {"in several pieces", [](const Row& r) { return r.value[Pieces] == 1; }},
      {"of another genus", [](const Row& r) { return r.value[Genus] == objectNamed(r.at.object).genus; }}};
  return table;
}

const std::vector<Order>& orders()
{
  static const std::vector<Order> table = {// better, than, where, factor, allowance in octants
                                           {"hulls-robust", "cubes-exact", Where::Clean, 1.0, 0.003},
                                           {"hulls-robust", "cubes-exact", Where::Noisy, 0.9, 0.0},
                                           {"hulls-robust", "consistent-1", Where::NoisyButPixels, 1.0, 0.0},
                                           {"hulls-robust", "consistent-2", Where::NoisyButPixels, 1.0, 0.0},
                                           {WithoutIslands, "cubes-exact", Where::Noisy, 0.6, 0.0},
                                           {WithoutIslands, "consistent-1", Where::Noisy, 0.6, 0.0},
                                           {WithoutIslands, "consistent-2", Where::Noisy, 0.6, 0.0},
                                           {WithoutIslands, "consistent-3", Where::Noisy, 0.6, 0.0}};
  return table;
}

bool isPromising(const Row& row)
{
  return methodNamed(row.method).family == Family::Hulls || row.method == WithoutIslands;
}

std::vector<std::string> violations(const std::vector<Row>& rows)
{
  std::vector<std::string> found;
  for (const Row& row : rows)
  {
    if (!isPromising(row) || row.failure == NothingLeft)
    {
      continue;
    }
    if (!row.failure.empty())
    {
      found.push_back(describe(row) + ": " + row.failure);
      continue;
    }
    std::vector<Promise> all = promises();
    if (row.method == WithoutIslands && row.at.noise == "pixels")
    {
      all.insert(all.end(), islandPromises().begin(), islandPromises().end());
    }
    for (const Promise& promise : all)
    {
      if (!promise.kept(row))
      {
        found.push_back(describe(row) + ": " + promise.broken);
      }
    }
    for (const Order& order : orders())
    {
      checkOrder(order, rows, row, found);
    }
  }
  return found;
}

} // namespace silhouette::experiments
