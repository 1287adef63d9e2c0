extern "C" {
#include <apriltag/apriltag.h>
#include <apriltag/tag16h5.h>
#include <apriltag/tag25h9.h>
#include <apriltag/tag36h10.h>
#include <apriltag/tagCircle21h7.h>
#include <apriltag/tagStandard41h12.h>
}

#include <cstdlib>

#include "anatomy/base/error.h"
#include "ar/boards/board.h"

namespace palpa::ar {
namespace {

struct Family {
  const char* name;
  apriltag_family_t* (*create)();
  void (*destroy)(apriltag_family_t*);
};

constexpr Family kFamilies[] = {
    {"tag16h5", tag16h5_create, tag16h5_destroy},
    {"tag25h9", tag25h9_create, tag25h9_destroy},
    {"tag36h10", tag36h10_create, tag36h10_destroy},
    {"tagCircle21h7", tagCircle21h7_create, tagCircle21h7_destroy},
    {"tagStandard41h12", tagStandard41h12_create, tagStandard41h12_destroy}};

}  // namespace

const std::vector<std::string>& foreignTagFamilies() {
  static const std::vector<std::string> names = [] {
    std::vector<std::string> all;
    for (const Family& family : kFamilies) all.emplace_back(family.name);
    return all;
  }();
  return names;
}

cv::Mat drawForeignTag(const std::string& name, int id) {
  for (const Family& known : kFamilies) {
    if (name != known.name) continue;
    const std::unique_ptr<apriltag_family_t, void (*)(apriltag_family_t*)> family(known.create(),
                                                                                  known.destroy);
    if (id < 0 || id >= static_cast<int>(family->ncodes)) break;
    image_u8_t* drawn = apriltag_to_image(family.get(), static_cast<unsigned>(id));
    cv::Mat tag = cv::Mat(drawn->height, drawn->width, CV_8U, drawn->buf,
                          static_cast<std::size_t>(drawn->stride))
                      .clone();
    std::free(drawn->buf);
    std::free(drawn);
    return tag;
  }
  throw UsageError("has no such tag", name + " " + std::to_string(id), "See foreignTagFamilies");
}

}  // namespace palpa::ar
