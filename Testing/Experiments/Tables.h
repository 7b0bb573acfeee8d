// SPDX-License-Identifier: BSD-3-Clause
/**
 * The study's tables, in Markdown, from its rows.
 */
#pragma once

#include "Rows.h"
#include "VoteTable.h"

#include <string>
#include <vector>

namespace silhouette::experiments
{

/** Mean and spread of what is measured over the seeds. */
struct Summary
{
  std::size_t runs = 0;     ///< that have a value
  std::size_t failures = 0; ///< that have no surface
  double mean = 0.0;
  double deviation = 0.0; ///< standard, of a sample; 0 of one
};

/** A kind of noise and its strength: what the seeds of are taken together. */
struct Condition
{
  std::string noise;
  double strength = 0.0;
};

/** The conditions of the rows, the clean one first, in the order of the table of noises. */
std::vector<Condition> conditionsOf(const std::vector<Row>& rows);

Summary summarize(const std::vector<Row>& rows, const std::string& object, const Condition& condition,
                  const std::string& method, Column column);

/** The method of the family with the least mean error; empty where there is none. */
std::string bestOf(int family, const std::vector<Row>& rows, const std::string& object,
                   const Condition& condition);

/** The method with the least mean error of all; empty where there is none. */
std::string bestOfAll(const std::vector<Row>& rows, const std::string& object, const Condition& condition);

/** One object: errors by noise, of the methods that are run with the first seed alone or of the others. */
std::string errorTable(const std::vector<Row>& rows, const std::string& object, bool firstSeedOnly);
/** One object: soundness, topology and more of the methods that the page speaks of, by noise. */
std::string shapeTable(const std::vector<Row>& rows, const std::string& object);
/** Each method: in how many runs it is open, not manifold, ... */
std::string promiseTable(const std::vector<Row>& rows);
/**
 * Ratios of the local hulls' error to exact marching cubes' of the same run, beside what they are to reach.
 */
std::string targetTable(const std::vector<Row>& rows);
/** Times of the surfaces, as ratios to exact marching cubes. */
std::string timeTable(const std::vector<Row>& rows);
/** The local hulls without each of their stages, by noise. */
std::string ablationTable(const std::vector<Row>& rows);
/** The ratio of the local hulls' error to exact marching cubes', by depth and size of the images. */
std::string scalingTable(const std::vector<Row>& rows);
/** Flipped pixels: exact marching cubes and the local hulls, these with small islands kept and dropped. */
std::string islandTable(const std::vector<Row>& rows);
/** Runs without a surface and why; runs on thinned points. */
std::string noteTable(const std::vector<Row>& rows);

/** Table 6.1: the thesis's, the first of the tables and the nearest one. */
std::string voteCountTable(const std::vector<VoteTable>& tables);
/** Intersection octants by generation, of the first and the nearest table. */
std::string generationTable(const std::vector<VoteTable>& tables);
/** The nearest table to the thesis's. */
const VoteTable& nearestTable(const std::vector<VoteTable>& tables);

} // namespace silhouette::experiments
