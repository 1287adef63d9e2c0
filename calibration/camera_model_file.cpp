#include <algorithm>
#include <cctype>
#include <nlohmann/json.hpp>
#include <opencv2/core.hpp>
#include <opencv2/core/utils/logger.hpp>
#include <vector>

#include "anatomy/base/error.h"
#include "anatomy/base/file_schema.h"
#include "anatomy/base/json_file.h"
#include "anatomy/base/whole_file.h"
#include "calibration/camera_model.h"

namespace palpa::calibration {
namespace {

namespace fs = std::filesystem;
using nlohmann::json;

constexpr int kVersion = 1;
constexpr std::uintmax_t kLargestFile = 4 << 20;  // bytes; a real one has a few thousand

constexpr int kLargestSide = 1 << 30;  // px; what is too large to be a picture is refused later
constexpr const char* kCameraRemedy =
    "Give a camera calibration: OpenCV's YAML or XML, or our JSON ('palpa calibrate camera' writes "
    "one)";

[[noreturn]] void refuse(const fs::path& file, const std::string& what) {
  throw Error(what, file.string(), kCameraRemedy);
}

std::string textOf(const fs::path& file) {
  std::error_code code;
  if (!fs::is_regular_file(file, code)) refuse(file, "no such file");
  if (fs::file_size(file, code) > kLargestFile || code) refuse(file, "too large for a calibration");
  std::optional<std::string> text = readWhole(file);
  if (!text) refuse(file, "cannot be read");
  return std::move(*text);
}

double number(const cv::FileNode& node, const std::string& field, const fs::path& file) {
  if (node.empty()) refuse(file, "field '" + field + "' is missing");
  if (!node.isInt() && !node.isReal()) refuse(file, "field '" + field + "' must be a number");
  return static_cast<double>(node);
}

int wholeNumber(const cv::FileNode& node, const std::string& field, const fs::path& file) {
  if (!node.empty() && !node.isInt()) refuse(file, "field '" + field + "' must be a whole number");
  return static_cast<int>(number(node, field, file));
}

struct Matrix {
  int rows = 0, cols = 0;
  std::vector<double> data;
};

/// Element by element, so that a damaged header never makes OpenCV allocate or assert.
Matrix matrix(const cv::FileNode& node, const std::string& field, const fs::path& file) {
  if (node.empty()) refuse(file, "field '" + field + "' is missing");
  if (!node.isMap()) refuse(file, "field '" + field + "' must be an opencv-matrix");
  Matrix m;
  m.rows = wholeNumber(node["rows"], field + ".rows", file);
  m.cols = wholeNumber(node["cols"], field + ".cols", file);
  for (const cv::FileNode& value : node["data"])
    m.data.push_back(number(value, field + ".data", file));
  if (m.rows < 1 || m.cols < 1 || m.data.size() != std::size_t(m.rows) * std::size_t(m.cols))
    refuse(file, "field '" + field + "' has another shape than its rows and cols say");
  return m;
}

void readIntrinsics(const cv::FileNode& node, CameraModel* camera, const fs::path& file) {
  const Matrix K = matrix(node, "camera_matrix", file);
  if (K.rows != 3 || K.cols != 3) refuse(file, "field 'camera_matrix' must be 3 x 3");
  const auto at = [&](int row, int col) { return K.data[std::size_t(3 * row + col)]; };
  if (at(0, 1) != 0 || at(1, 0) != 0 || at(2, 0) != 0 || at(2, 1) != 0 || at(2, 2) != 1)
    refuse(file, "field 'camera_matrix' must be [fx 0 cx; 0 fy cy; 0 0 1]; skew is not supported");
  camera->fx = at(0, 0);
  camera->fy = at(1, 1);
  camera->cx = at(0, 2);
  camera->cy = at(1, 2);
}

void readDistortion(const std::vector<double>& k, CameraModel* camera, const fs::path& file) {
  const std::size_t n = k.size();
  if (n != 4 && n != 5 && n != 8 && n != 12 && n != 14)
    refuse(file, "field 'distortion_coefficients' must hold 4 or 5 numbers: k1 k2 p1 p2 [k3]");
  for (std::size_t i = 0; i < n; ++i) {
    if (i < 5)
      camera->distortion[i] = k[i];
    else if (k[i] != 0)
      refuse(file,
             "field 'distortion_coefficients' uses the rational, thin-prism or tilted lens model; "
             "only k1 k2 p1 p2 k3 are supported");
  }
}

void refuseFisheye(const cv::FileNode& root, const fs::path& file) {
  const cv::FileNode fisheye = root["fisheye_model"], model = root["distortion_model"];
  const bool other = model.isString() && static_cast<std::string>(model) != "plumb_bob";
  if (other || (fisheye.isInt() && static_cast<int>(fisheye) != 0))
    refuse(file, "the fisheye and other lens models are not supported, only k1 k2 p1 p2 k3");
}

/// OpenCV's reader goes as deep as a text is nested, even to the end of the stack.
bool isNestedDeep(const std::string& text) {
  constexpr int kDeepest = 32;
  int depth = 0;
  for (std::size_t i = 0; i < text.size() && depth <= kDeepest; ++i) {
    const char c = text[i], next = i + 1 < text.size() ? text[i + 1] : ' ';
    const bool opens_tag = c == '<' && std::isalpha(static_cast<unsigned char>(next));
    const bool closes_tag = (c == '<' || c == '/') && next == (c == '<' ? '/' : '>');
    if (c == '[' || c == '{' || opens_tag) ++depth;
    if (c == ']' || c == '}' || closes_tag) depth = std::max(0, depth - 1);
  }
  return depth > kDeepest;
}

CameraModel fromOpenCv(const std::string& text, const fs::path& file) {
  if (isNestedDeep(text)) refuse(file, "is nested too deep");
  const cv::FileStorage storage(text, cv::FileStorage::READ | cv::FileStorage::MEMORY);
  if (!storage.isOpened()) refuse(file, "is neither YAML nor XML of OpenCV");
  const cv::FileNode root = storage.root();
  if (!root.isMap()) refuse(file, "holds no fields");
  CameraModel camera;
  refuseFisheye(root, file);
  camera.width = wholeNumber(root["image_width"], "image_width", file);
  camera.height = wholeNumber(root["image_height"], "image_height", file);
  readIntrinsics(root["camera_matrix"], &camera, file);
  const Matrix k = matrix(root["distortion_coefficients"], "distortion_coefficients", file);
  if (k.rows != 1 && k.cols != 1) refuse(file, "field 'distortion_coefficients' must be a vector");
  readDistortion(k.data, &camera, file);
  if (const cv::FileNode rms = root["avg_reprojection_error"]; !rms.empty())
    camera.rms_px = number(rms, "avg_reprojection_error", file);
  return camera;
}

JsonFile ownFile(const std::string& text, const fs::path& name) {
  JsonFile file = JsonFile::ofText(text, name.string(), kCameraRemedy);
  if (!file.json().is_object()) refuse(name, "is damaged: it holds no fields");
  if (file.has("type") && file.text("type") != "camera_model")
    file.refuse("type", "must be \"camera_model\"");
  return file;
}

CameraModel modelIn(const JsonFile& file, const fs::path& name) {
  file.text("type");
  if (file.text("unit") != "px") file.refuse("unit", "must be \"px\"");
  CameraModel camera;
  camera.width = file.integer("width", 0, kLargestSide);
  camera.height = file.integer("height", 0, kLargestSide);
  camera.fx = file.number("fx");
  camera.fy = file.number("fy");
  camera.cx = file.number("cx");
  camera.cy = file.number("cy");
  readDistortion(file.numbers("distortion"), &camera, name);
  camera.rms_px = file.number("rms_px");
  return camera;
}

CameraModel fromJson(const std::string& text, const fs::path& name) {
  const JsonFile file = readOwnFile([&] { return ownFile(text, name); });
  needKind(file, "camera", kVersion);
  return readOwnFile([&] { return modelIn(file, name); });
}

/// OpenCV tells of parse errors on standard error before it throws; ours are clearer.
class QuietOpenCv {
 public:
  QuietOpenCv() : before_(cv::utils::logging::setLogLevel(cv::utils::logging::LOG_LEVEL_SILENT)) {
    cv::redirectError([](int, const char*, const char*, const char*, int, void*) { return 0; });
  }
  ~QuietOpenCv() {
    cv::redirectError(nullptr);
    cv::utils::logging::setLogLevel(before_);
  }
  QuietOpenCv(const QuietOpenCv&) = delete;
  QuietOpenCv& operator=(const QuietOpenCv&) = delete;

 private:
  cv::utils::logging::LogLevel before_;
};

CameraModel parse(const std::string& text, const fs::path& file) {
  const std::size_t start = text.find_first_not_of(" \t\r\n");
  if (start == std::string::npos) refuse(file, "is empty");
  if (text.find('\0') != std::string::npos) refuse(file, "is damaged: binary data inside");
  if (text[start] == '{') return fromJson(text, file);
  if (text.compare(start, 5, "%YAML") != 0 && text.compare(start, 5, "<?xml") != 0)
    refuse(file, "is no calibration: it must start with %YAML, <?xml or {");
  // OpenCV 4.6 reads past the end of XML that is cut within its first line.
  if (text[start] == '<' &&
      (text.find("?>") == std::string::npos || text.find("</opencv_storage>") == std::string::npos))
    refuse(file, "is cut short: no </opencv_storage> at its end");
  const QuietOpenCv quiet;
  try {
    return fromOpenCv(text, file);
  } catch (const Error&) {
    throw;
  } catch (const std::exception&) {  // cv::Exception, bad_alloc: whatever a damaged file provokes
    refuse(file, "is damaged or cut short: it cannot be read to its end");
  }
}

json toJson(const CameraModel& camera) {
  return {{"type", "camera_model"},
          {"version", kVersion},
          {"unit", "px"},
          {"width", camera.width},
          {"height", camera.height},
          {"fx", camera.fx},
          {"fy", camera.fy},
          {"cx", camera.cx},
          {"cy", camera.cy},
          {"distortion", camera.distortion},
          {"rms_px", camera.rms_px}};
}

}  // namespace

CameraModel readCameraModel(const fs::path& file) {
  const CameraModel camera = parse(textOf(file), file);
  validate(camera, file.string());
  return camera;
}

void writeCameraModel(const CameraModel& model, const fs::path& file) {
  validate(model, file.string());
  writeWhole(file, toJson(model).dump(2) + "\n");
}

}  // namespace palpa::calibration
