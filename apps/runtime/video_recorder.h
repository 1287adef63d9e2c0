#pragma once

#include <cstdint>
#include <filesystem>
#include <fstream>

#include "apps/runtime/bus.h"

namespace palpa::runtime {

/// A session's pictures beside their poses: "camera.mjpeg", JPEG after JPEG (any player shows it;
/// what is on the disk stays readable if the program is killed), and "camera.mjpeg.csv": number,
/// time of exposure (session, ns), source ("virtual camera": simulated), fault, tracking, pose of
/// the board in the camera (m, quaternion), as measured. One writer, on the camera's thread. A full
/// disk ends the recording, not the session: `trouble`.
class VideoRecorder {
 public:
  explicit VideoRecorder(const std::filesystem::path& folder);
  void add(const CameraView& view);
  std::uint64_t pictures() const { return pictures_; }
  const std::string& trouble() const { return trouble_; }  ///< empty: everything was kept

 private:
  std::filesystem::path film_;
  std::ofstream pictures_file_, table_;
  std::uint64_t pictures_ = 0;
  std::string trouble_;
};

}  // namespace palpa::runtime
