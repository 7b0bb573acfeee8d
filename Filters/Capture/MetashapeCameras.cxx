// SPDX-License-Identifier: BSD-3-Clause
#include "MetashapeCameras.h"

#include "CameraGeometry.h"
#include "Error.h"
#include "FileBytes.h"
#include "TextParsing.h"

#include <Eigen/LU>

#include <pugixml.hpp>

#include <algorithm>
#include <cmath>
#include <map>

namespace silhouette
{
namespace
{

/** x -> scale rotation x + translation. */
struct Similarity
{
  Matrix3 rotation = Matrix3::Identity();
  Vector3 translation = Vector3::Zero();
  double scale = 1.0;
};

struct Sensor
{
  Matrix3 intrinsics = Matrix3::Identity(); ///< integer family
  std::optional<LensDistortion> lens;
  int width = 0;
  int height = 0;
};

/** The document, and which line a node is on. */
struct Document
{
  std::filesystem::path file;
  std::string text;
  pugi::xml_document xml;
  std::vector<std::size_t> lineEnds;

  std::string where(const pugi::xml_node& node) const { return this->file.string() + " line " + std::to_string(this->line(node)); }
  int line(const pugi::xml_node& node) const
  {
    const auto offset = std::size_t(std::max<std::ptrdiff_t>(node.offset_debug(), 0));
    return 1 + int(std::lower_bound(this->lineEnds.begin(), this->lineEnds.end(), offset) - this->lineEnds.begin());
  }
};

void parse(const std::filesystem::path& file, Document& document)
{
  document.file = file;
  document.text = readBytes(file);
  for (std::size_t i = 0; i < document.text.size(); ++i)
  {
    if (document.text[i] == '\n')
    {
      document.lineEnds.push_back(i);
    }
  }
  const pugi::xml_parse_result result = document.xml.load_buffer(document.text.data(), document.text.size());
  if (!result)
  {
    const auto end = std::lower_bound(document.lineEnds.begin(), document.lineEnds.end(), std::size_t(std::max<std::ptrdiff_t>(result.offset, 0)));
    throw InvalidInput(file.string() + " line " + std::to_string(1 + (end - document.lineEnds.begin())) + ": is no XML (" +
                       result.description() + ")");
  }
}

/** The numbers of a node's text, `count` of them. */
std::vector<double> numbersOf(const pugi::xml_node& node, std::size_t count, const std::string& where)
{
  std::string text = node.text().get();
  std::replace_if(text.begin(), text.end(), [](char c) { return c == '\n' || c == '\r' || c == '\t'; }, ' ');
  std::vector<double> numbers;
  for (const std::string& piece : splitText(text, ' '))
  {
    if (piece.empty())
    {
      continue;
    }
    const std::optional<double> number = parseFinite(piece);
    if (!number)
    {
      throw InvalidInput(where + ": " + inQuotes(piece) + " in <" + node.name() + "> is not a finite number");
    }
    numbers.push_back(*number);
  }
  if (numbers.size() != count)
  {
    throw InvalidInput(where + ": <" + node.name() + "> has " + std::to_string(numbers.size()) + " numbers, not " + std::to_string(count));
  }
  return numbers;
}

double numberOf(const pugi::xml_node& parent, const char* name, const std::string& where, double otherwise = 0.0)
{
  const pugi::xml_node node = parent.child(name);
  return node ? numbersOf(node, 1, where)[0] : otherwise;
}

/** A rotation times a scale, and a shift, from 16 numbers. */
Similarity similarityOf(const std::vector<double>& numbers, const std::string& where)
{
  using Matrix4 = Eigen::Matrix<double, 4, 4, Eigen::RowMajor>;
  const Matrix4 matrix = Eigen::Map<const Matrix4>(numbers.data());
  if (matrix.row(3) != Eigen::RowVector4d(0.0, 0.0, 0.0, 1.0))
  {
    throw InvalidInput(where + ": the last row of <transform> is not 0 0 0 1");
  }
  Similarity similarity;
  similarity.scale = std::cbrt(matrix.topLeftCorner<3, 3>().determinant());
  if (!(similarity.scale > 0.0) || !std::isfinite(similarity.scale))
  {
    throw InvalidInput(where + ": R is no rotation: " + formatMatrix(matrix.topLeftCorner<3, 3>()));
  }
  similarity.rotation = checkedRotation(matrix.topLeftCorner<3, 3>() / similarity.scale, where);
  similarity.translation = matrix.topRightCorner<3, 1>();
  return similarity;
}

/** Of a chunk or a component: rotation, translation and scale, any of them absent; PhotoScan wrote 16 numbers. */
Similarity worldOf(const pugi::xml_node& transform, const std::string& where)
{
  if (!transform.find_child([](const pugi::xml_node& node) { return node.type() == pugi::node_element; }))
  {
    return similarityOf(numbersOf(transform, 16, where), where);
  }
  Similarity world;
  if (const pugi::xml_node node = transform.child("rotation"))
  {
    world.rotation = checkedRotation(Eigen::Map<const Matrix3>(numbersOf(node, 9, where).data()), where);
  }
  if (const pugi::xml_node node = transform.child("translation"))
  {
    world.translation = Vector3(numbersOf(node, 3, where).data());
  }
  world.scale = numberOf(transform, "scale", where, 1.0);
  if (!(world.scale > 0.0))
  {
    throw InvalidInput(where + ": the scale is " + formatNumber(world.scale) + ", not above 0");
  }
  return world;
}

int sideOf(const pugi::xml_node& resolution, const char* side, const std::string& where)
{
  const std::string text = resolution.attribute(side).value();
  const int value = text.empty() ? 0 : parseCount(text).value_or(0);
  if (value == 0)
  {
    throw InvalidInput(where + ": the resolution's " + side + " is " + inQuotes(text) + ", not a whole number from 1 on");
  }
  return value;
}

void refuseTerms(const pugi::xml_node& calibration, std::initializer_list<const char*> names, const char* model, const std::string& where)
{
  for (const char* name : names)
  {
    const double value = numberOf(calibration, name, where);
    if (value != 0.0)
    {
      throw InvalidInput(where + ": " + name + " is " + formatNumber(value) + ", and OpenCV's " + model +
                         " model has no such term; undistort the images, and export their cameras");
    }
  }
}

LensDistortion distortionOf(const pugi::xml_node& calibration, bool isFisheye, bool isOlder, const std::string& where)
{
  const auto term = [&](const char* name) { return numberOf(calibration, name, where); };
  LensDistortion lens;
  if (isFisheye)
  {
    refuseTerms(calibration, { "p1", "p2", "p3", "p4" }, "fisheye", where);
    lens.model = LensDistortion::Model::Fisheye;
    lens.coefficients = { term("k1"), term("k2"), term("k3"), term("k4") };
    return lens;
  }
  refuseTerms(calibration, { "k4", "p3", "p4" }, "lens", where);
  lens.coefficients = { term("k1"), term("k2"), term(isOlder ? "p1" : "p2"), term(isOlder ? "p2" : "p1"), term("k3") };
  return lens;
}

pugi::xml_node calibrationOf(const pugi::xml_node& sensor)
{
  const pugi::xml_node adjusted = sensor.find_child_by_attribute("calibration", "class", "adjusted");
  return adjusted ? adjusted : sensor.child("calibration");
}

Sensor sensorOf(const pugi::xml_node& node, const std::string& where)
{
  const pugi::xml_node calibration = calibrationOf(node);
  const std::string type = calibration.attribute("type").as_string(node.attribute("type").as_string("frame"));
  const bool isFisheye = type == "fisheye" || type == "equidistant_fisheye";
  if (!isFisheye && type != "frame")
  {
    throw InvalidInput(where + ": is of the type " + inQuotes(type) + "; frame and (equidistant) fisheye are read");
  }
  if (!calibration)
  {
    throw InvalidInput(where + ": has no <calibration>");
  }
  const pugi::xml_node own = calibration.child("resolution");
  const pugi::xml_node resolution = own ? own : node.child("resolution");
  Sensor sensor;
  sensor.width = sideOf(resolution, "width", where);
  sensor.height = sideOf(resolution, "height", where);
  const bool isOlder = bool(calibration.child("fx"));
  const double f = numberOf(calibration, "f", where);
  const double halfWidth = 0.5 * sensor.width, halfHeight = 0.5 * sensor.height;
  Matrix3& K = sensor.intrinsics;
  K(0, 0) = isOlder ? numberOf(calibration, "fx", where) : f + numberOf(calibration, "b1", where);
  K(1, 1) = isOlder ? numberOf(calibration, "fy", where) : f;
  K(0, 1) = numberOf(calibration, isOlder ? "skew" : "b2", where);
  // Corner family to integer.
  K(0, 2) = (isOlder ? numberOf(calibration, "cx", where, halfWidth) : halfWidth + numberOf(calibration, "cx", where)) - 0.5;
  K(1, 2) = (isOlder ? numberOf(calibration, "cy", where, halfHeight) : halfHeight + numberOf(calibration, "cy", where)) - 0.5;
  checkedIntrinsics(K, where);
  LensDistortion lens = distortionOf(calibration, isFisheye, isOlder, where);
  lens.intrinsics = K;
  sensor.lens = lens.isAny() ? std::optional(lens) : std::nullopt;
  return sensor;
}

/** What a chunk's cameras look up, each read when first asked for: a sensor that no camera has may be of any type. */
class Chunk
{
public:
  Chunk(const Document& document, const pugi::xml_node& node)
    : Source(document)
    , Node(node)
  {
  }

  const Sensor& sensor(const std::string& id, const std::string& camera)
  {
    const auto known = this->Sensors.find(id);
    if (known != this->Sensors.end())
    {
      return known->second;
    }
    const pugi::xml_node node = this->Node.child("sensors").find_child_by_attribute("sensor", "id", id.c_str());
    if (!node)
    {
      throw InvalidInput(camera + ": there is no sensor " + inQuotes(id));
    }
    return this->Sensors.emplace(id, sensorOf(node, this->Source.where(node) + ": sensor " + inQuotes(id))).first->second;
  }

  /** A component's transform leads to the world by itself; the chunk's is for those without. */
  const Similarity& world(const std::string& component)
  {
    const auto known = this->Worlds.find(component);
    if (known != this->Worlds.end())
    {
      return known->second;
    }
    pugi::xml_node node = this->Node.child("components").find_child_by_attribute("component", "id", component.c_str()).child("transform");
    this->HasSharedWorld = this->HasSharedWorld || !node;
    node = node ? node : this->Node.child("transform");
    const Similarity world = node ? worldOf(node, this->Source.where(node)) : Similarity();
    return this->Worlds.emplace(component, world).first->second;
  }

  /** Pieces that were aligned apart fit together only in the world. */
  void checkComponents() const
  {
    if (this->HasSharedWorld && this->Worlds.size() > 1)
    {
      throw InvalidInput(this->Source.file.string() + ": the cameras are of " + std::to_string(this->Worlds.size()) +
                         " components, and not every one has a transform to the world; export one");
    }
  }

private:
  const Document& Source;
  pugi::xml_node Node;
  std::map<std::string, Sensor> Sensors;
  std::map<std::string, Similarity> Worlds;
  bool HasSharedWorld = false;
};

NamedProjection viewOf(const Document& document, Chunk& chunk, const pugi::xml_node& camera)
{
  NamedProjection view;
  view.name = camera.attribute("label").value();
  view.line = document.line(camera);
  const std::string where = document.where(camera) + ": camera " + inQuotes(view.name);
  if (view.name.empty())
  {
    throw InvalidInput(where + ": the label is empty");
  }
  const Similarity pose = similarityOf(numbersOf(camera.child("transform"), 16, where), where);
  checkedRotation(pose.scale * pose.rotation, where); // the scale is the chunk's
  const Sensor& sensor = chunk.sensor(camera.attribute("sensor_id").value(), where);
  const Similarity& world = chunk.world(camera.attribute("component_id").value());
  const Matrix3 toCamera = (world.rotation * pose.rotation).transpose();
  const Vector3 centre = world.scale * (world.rotation * pose.translation) + world.translation;
  view.projection = composedProjection(sensor.intrinsics, toCamera, -(toCamera * centre), where);
  view.lens = sensor.lens;
  view.width = sensor.width;
  view.height = sensor.height;
  return view;
}

pugi::xml_node onlyChunk(const Document& document)
{
  pugi::xml_node only;
  int count = 0;
  for (const pugi::xml_node chunk : document.xml.child("document").children("chunk"))
  {
    if (chunk.child("cameras"))
    {
      only = chunk;
      ++count;
    }
  }
  if (count != 1)
  {
    throw InvalidInput(document.file.string() + ": has " + std::to_string(count) + " chunks with cameras; export one");
  }
  return only;
}

void warn(CameraFile& cameras, const std::vector<std::string>& labels, const std::string& why)
{
  if (!labels.empty())
  {
    cameras.warnings.push_back(cameras.files[0].string() + ": " + std::to_string(labels.size()) + (labels.size() == 1 ? " camera " : " cameras ") +
                               why + " left out, the first is " + inQuotes(labels[0]));
  }
}

} // namespace

bool isMetashapeCameras(const std::filesystem::path& file)
{
  const std::string bytes = fileBeginning(file, std::size_t(64) << 10);
  const std::string_view text = withoutLeadingBlanks(bytes);
  return text.substr(0, 1) == "<" && text.find("<document") != std::string_view::npos && text.find("<chunk") != std::string_view::npos;
}

CameraFile readMetashapeCameras(const std::filesystem::path& file)
{
  Document document;
  parse(file, document);
  const pugi::xml_node node = onlyChunk(document);
  Chunk chunk(document, node);
  CameraFile cameras;
  cameras.format = CameraFormat::Metashape;
  cameras.files = { file };
  std::vector<std::string> disabled, unaligned;
  pugi::xpath_node_set found = node.child("cameras").select_nodes(".//camera");
  found.sort();
  for (const pugi::xpath_node& one : found)
  {
    const pugi::xml_node camera = one.node();
    const std::string enabled = camera.attribute("enabled").as_string("true");
    if (enabled == "false" || enabled == "0")
    {
      disabled.emplace_back(camera.attribute("label").value());
    }
    else if (!camera.child("transform"))
    {
      unaligned.emplace_back(camera.attribute("label").value());
    }
    else
    {
      cameras.views.push_back(viewOf(document, chunk, camera));
    }
  }
  warn(cameras, unaligned, "without a transform (not aligned, or of a rig)");
  warn(cameras, disabled, "switched off");
  chunk.checkComponents();
  return cameras;
}

} // namespace silhouette
