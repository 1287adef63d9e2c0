#pragma once

#include <algorithm>
#include <cstdlib>
#include <fstream>
#include <map>
#include <set>
#include <sstream>
#include <string>
#include <vector>

#include "anatomy/geometry/pose.h"
#include "tests/support/scratch_folder.h"

namespace palpa::test {

/// What a program did with the test runtime of tests/openxr_runtime.
struct XrReport {
  std::map<std::string, int> calls;
  std::vector<std::string> open, complaints;
  struct Hand {
    Vec3 p = Vec3::Zero();  ///< in OpenXR's axes
    double trigger = 0;
  };
  std::vector<Hand> hands;
  bool written = false;
};

/// A picture that an eye was shown: RGBA, rows from the top.
struct XrPicture {
  int width = 0, height = 0;
  std::vector<unsigned char> rgba;
  const unsigned char* at(int u, int v) const {
    return &rgba[4 * (static_cast<std::size_t>(v) * width + u)];
  }
};

/// The test runtime as the computer's, for programs and for this process, as long as it lives.
/// `plan`: see tests/openxr_runtime/plan.h.
class TestXr {
 public:
  TestXr(const std::string& runtime_json, const std::string& plan) : folder_("openxr") {
    setenv("XR_RUNTIME_JSON", runtime_json.c_str(), 1);
    setenv("PALPA_TEST_XR",
           (plan + ";report=" + (folder_ / "report.txt").string() +
            ";pictures=" + folder_.path().string() + ";layers=" + (folder_ / "layers").string())
               .c_str(),
           1);
  }
  ~TestXr() {
    unsetenv("XR_RUNTIME_JSON");
    unsetenv("PALPA_TEST_XR");
  }
  std::filesystem::path folder() const { return folder_.path(); }

  /// Once the program has given its instance back.
  XrReport report() const {
    XrReport report;
    std::ifstream file(folder_ / "report.txt");
    report.written = static_cast<bool>(file);
    for (std::string line; std::getline(file, line);) {
      std::istringstream words(line);
      std::string kind, name;
      words >> kind;
      if (kind == "call") words >> name >> report.calls[name];
      if (kind == "open") report.open.push_back(line);
      if (kind == "complaint") report.complaints.push_back(line);
      if (kind != "hand") continue;
      XrReport::Hand hand;
      int frame = 0;
      words >> frame >> hand.p.x() >> hand.p.y() >> hand.p.z() >> hand.trigger;
      report.hands.push_back(hand);
    }
    return report;
  }

  XrPicture picture(int eye) const {
    XrPicture picture;
    std::ifstream file(folder_ / ("eye" + std::to_string(eye) + ".pam"), std::ios::binary);
    for (std::string word; file >> word && word != "ENDHDR";) {
      if (word == "WIDTH") file >> picture.width;
      if (word == "HEIGHT") file >> picture.height;
    }
    file.get();
    picture.rgba.resize(static_cast<std::size_t>(4) * picture.width * picture.height);
    file.read(reinterpret_cast<char*>(picture.rgba.data()),
              static_cast<std::streamsize>(picture.rgba.size()));
    return picture;
  }

 private:
  ScratchFolder folder_;
};

}  // namespace palpa::test
