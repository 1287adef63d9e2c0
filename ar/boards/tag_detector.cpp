#include "ar/boards/tag_detector.h"

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <mutex>
#include <new>
#include <tuple>

#include "anatomy/base/error.h"
#include "ar/boards/gray_picture.h"
#include "ar/boards/tag_grid.h"

namespace palpa::ar {

TagFamily makeTagFamily(int border_bits) {
  if (border_bits != 1 && border_bits != 2)
    throw UsageError("the border must be 1 or 2 cells wide", "tag family", "Use 1, or 2 (Kalibr).");
  TagFamily family(tag36h11_create(), &tag36h11_destroy);
  // The structure and its bit places are this caller's own; only the codes are the library's.
  const int wider = border_bits - 1;
  family->width_at_border += 2 * wider;
  family->total_width += 2 * wider;
  for (unsigned i = 0; i < family->nbits; ++i) {  // counted from the border's upper left cell
    family->bit_x[i] += unsigned(wider);
    family->bit_y[i] += unsigned(wider);
  }
  return family;
}

struct TagDetector::Library {
  explicit Library(const Settings& s) : settings(s), family(makeTagFamily(s.border_bits)) {}

  Settings settings;
  std::mutex mutex;
  TagFamily family;
  std::unique_ptr<apriltag_detector_t, decltype(&apriltag_detector_destroy)> detector{
      apriltag_detector_create(), &apriltag_detector_destroy};
};

namespace {

Tag toTag(const apriltag_detection_t& found) {
  Tag tag{};
  tag.id = found.id;
  for (int i = 0; i < 4; ++i) tag.corners[i] = {found.p[i][0] - 0.5, found.p[i][1] - 0.5};
  return tag;
}

bool before(const Tag& a, const Tag& b) {
  const auto key = [](const Tag& t) {
    return std::make_tuple(t.id, t.corners[0].y(), t.corners[0].x());
  };
  return key(a) < key(b);
}

}  // namespace

TagDetector::TagDetector(const Settings& settings) : library_(std::make_unique<Library>(settings)) {
  if (!(settings.decimate >= 1 && settings.decimate <= 8))
    throw UsageError("decimate must be 1 to 8", "tag detector", "Use 1 (exact) or 2 (fast).");
  apriltag_detector_add_family_bits(library_->detector.get(), library_->family.get(),
                                    settings.bits_corrected);
  library_->detector->nthreads = 1;
  library_->detector->quad_decimate = static_cast<float>(settings.decimate);
}

TagDetector::~TagDetector() = default;

namespace {

/// The library asks for memory and does not look whether it was given: where there is no room for
/// what it makes of a picture, it would take the program with it. Throws std::bad_alloc.
void requireRoom(std::size_t pixels) {
  constexpr std::size_t kBytesAPixel = 64;
  void* volatile room = std::malloc(kBytesAPixel * pixels);  // volatile: it is really asked for
  if (room == nullptr) throw std::bad_alloc();
  std::free(room);
}

}  // namespace

std::vector<Tag> TagDetector::detect(const cv::Mat& image) const {
  cv::Mat gray = grayPicture(image);
  requireRoom(gray.total());
  image_u8_t view = {gray.cols, gray.rows, static_cast<int>(gray.step[0]), gray.data};
  const std::lock_guard lock(library_->mutex);
  zarray_t* found = apriltag_detector_detect(library_->detector.get(), &view);
  std::vector<Tag> tags;
  for (int i = 0; i < zarray_size(found); ++i) {
    apriltag_detection_t* detection = nullptr;
    zarray_get(found, i, &detection);
    if (detection->decision_margin >= library_->settings.min_margin)
      tags.push_back(toTag(*detection));
  }
  apriltag_detections_destroy(found);
  std::sort(tags.begin(), tags.end(), before);
  return tags;
}

TagDetector::Settings boardTagSettings(double decimate, int border_bits) {
  return {decimate, 1, 10, border_bits};
}

std::vector<Tag> detectTags(const cv::Mat& gray, double decimate) {
  TagDetector::Settings settings;
  settings.decimate = decimate;
  return TagDetector(settings).detect(gray);
}

}  // namespace palpa::ar
