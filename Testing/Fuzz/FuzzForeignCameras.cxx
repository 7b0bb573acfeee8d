// SPDX-License-Identifier: BSD-3-Clause
/**
 * Camera files of other programs, with any bytes in them: InvalidInput, or views with finite matrices. Whole files are made
 * first and then spoilt here and there: plain bytes would seldom get past a parser's first line.
 */
#include "Error.h"
#include "MetashapeCameras.h"
#include "NeusCameras.h"
#include "NumpyArchiveTesting.h"
#include "OpenCVCameras.h"
#include "PmvsCameras.h"

#include <cstdlib>
#include <fstream>
#include <unistd.h>

using namespace silhouette;

namespace
{

const char* const Yaml = R"(%YAML:1.0
---
camera_matrix: !!opencv-matrix
   rows: 3
   cols: 3
   dt: d
   data: [ 100., 0., 50., 0., 100., 40., 0., 0., 1. ]
dist: [ 0.1, -2.e-2, 0., 1e-3 ]
image_width: 100
image_height: 80
views:
   - { image:"a.png", rvec:[ 0., .1, 0. ], t:[ 0., 0., 5. ] }
   -
      name: "b.png"
      R: [ [ 1, 0, 0 ], [ 0, 1, 0 ], [ 0, 0, 1 ] ]
      tvec: [ 1, 2, 3 ]
)";
const char* const Json = R"({"K": [[100.0, 0, 50], [0, 100, 40], [0, 0, 1]], "dist": [[0.1], [0], [0], [1e-05]],
 "views": [{"image": "a.png", "R": [0, 0.1, 0], "t": [0, 0, 5]}, {"image": "b.png", "P": [1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0], "dist": []}]}
)";
const char* const Xml = R"(<?xml version="1.0"?>
<opencv_storage><K type_id="opencv-matrix"><rows>3</rows><cols>3</cols><dt>d</dt><data>100. 0. 50. 0. 100. 40. 0. 0. 1.</data></K>
<views><_><image>"a.png"</image><R>1 0 0 0 1 0 0 0 1</R><t>0 0 5</t></_></views></opencv_storage>
)";
const char* const Metashape = R"(<?xml version="1.0" encoding="UTF-8"?>
<document version="2.0.0"><chunk label="Chunk 1" enabled="true"><sensors next_id="1"><sensor id="0" type="frame">
<resolution width="100" height="80"/><calibration type="frame" class="adjusted"><resolution width="100" height="80"/>
<f>100</f><cx>1</cx><cy>-2</cy><b1>0.5</b1><b2>0.25</b2><k1>0.1</k1><p1>0.001</p1></calibration></sensor></sensors>
<components><component id="0"><transform><rotation>1 0 0 0 1 0 0 0 1</rotation><translation>0 0 1</translation><scale>2</scale></transform></component></components>
<cameras><group id="0"><camera id="0" sensor_id="0" component_id="0" label="a.png"><transform>1 0 0 0 0 1 0 0 0 0 1 -5 0 0 0 1</transform></camera></group>
<camera id="1" sensor_id="0" label="b.png"/></cameras></chunk></document>
)";
const char* const Contour = "CONTOUR\n100 0 50 0\n0 100 40 0\n0 0 1 5\n";

/** Bytes of the input, and then zeros. */
struct Source
{
  const std::uint8_t* at;
  const std::uint8_t* end;
  unsigned next() { return this->at < this->end ? *this->at++ : 0; }
  unsigned below(std::size_t bound) { return bound == 0 ? 0 : (this->next() << 8 | this->next()) % unsigned(bound); }
};

/** A few places overwritten, cut out, doubled, or with a piece of syntax or a number put in. */
std::string spoilt(std::string text, Source& source)
{
  static const char* const pieces[] = { "[", "]", "{", "}", "<", "</", ">", "\n", "- ", ":", ",", "\"", "!!binary |", "$base64$", "1e999", "-", "nan", ".Inf",
                                        "99999999999999999999", "-1", "0x", "&amp;", "<![CDATA[", "<!--", "\xff\xfe", "\\u0000", "'", "#", "|", "%", "cols: 9",
                                        "&a ", "*a", "? ", "!!str ", "\\ud83d\\ude00" };
  for (unsigned left = 1 + source.next() % 6; left > 0; --left)
  {
    const std::size_t at = source.below(text.size() + 1);
    switch (source.next() % 5)
    {
    case 0: text.insert(at, pieces[source.below(sizeof(pieces) / sizeof(*pieces))]); break;
    case 1: text.erase(at, source.next()); break;
    case 2: text.insert(at, text.substr(source.below(text.size() + 1), source.next())); break;
    case 3: at < text.size() ? text[at] = char(source.next()) : 0; break;
    default: text.resize(source.next() % 4 == 0 ? at : text.size());
    }
  }
  return text;
}

/** Spoilt within the array, whose checksum is right, or as a file. */
std::string spoiltArchive(Source& source)
{
  const bool isInside = source.next() % 2 == 0;
  const std::string npy = npyMatrix({ 100, 0, 50, 0, 0, 100, 40, 0, 0, 0, 1, 5, 0, 0, 0, 1 });
  const std::string zip = zipBytes({ { "world_mat_0.npy", isInside ? spoilt(npy, source) : npy, source.next() % 2 == 0 } });
  return isInside ? zip : spoilt(zip, source);
}

template <typename Read> void check(const Read& read, const std::filesystem::path& path)
{
  try
  {
    for (const NamedProjection& view : read(path).views)
    {
      if (!view.projection.allFinite() || view.name.empty() || (view.lens && !view.lens->intrinsics.allFinite()))
      {
        std::abort();
      }
    }
  }
  catch (const Error&)
  {
  }
}

} // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size)
{
  Source source = { data, data + size };
  const auto folder = std::filesystem::temp_directory_path() / ("silhouette-fuzz-foreign-" + std::to_string(getpid()));
  const unsigned kind = source.next() % 6;
  const char* const texts[] = { Yaml, Json, Xml, Metashape, Contour };
  const char* const names[] = { "a.yml", "a.json", "a.xml", "b.xml", "txt/00000000.txt", "cameras.npz" };
  for (const char* made : { "txt", "visualize", "image" })
  {
    std::filesystem::create_directories(folder / made);
  }
  std::ofstream(folder / "visualize" / "00000000.png") << 'x';
  std::ofstream(folder / "image" / "000.png") << 'x';
  const std::filesystem::path file = folder / names[kind];
  std::ofstream(file, std::ios::binary) << (kind == 5 ? spoiltArchive(source) : spoilt(texts[kind], source));
  isOpenCVCameras(file);
  isMetashapeCameras(file);
  isPmvsCameras(file);
  neusFile(file);
  kind < 3 ? check(readOpenCVCameras, file) : kind == 3 ? check(readMetashapeCameras, file)
    : kind == 4                                         ? check(readPmvsCameras, file)
                                                        : check(readNeusCameras, file);
  std::filesystem::remove_all(folder);
  return 0;
}
