#pragma once

#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include <opencv2/videoio.hpp>

/// Pictures and films as files, by OpenCV's codecs. These are not linked but loaded when they are
/// first needed, once in a process, from any thread: with them come FFmpeg and GDAL, half of the
/// shared libraries that the program would start with. All throw Error where they are missing.
namespace palpa::ar {

/// Now, so that nothing is left to fail or to take its time later.
void loadCodecs();

/// `picture` (BGR or gray) as the bytes of a file with this ending (".jpg", ".png"); empty where it
/// has no pixels or the format cannot hold it. `parameters`: pairs, cv::ImwriteFlags.
std::vector<std::uint8_t> encode(const char* ending, const cv::Mat& picture,
                                 const std::vector<int>& parameters = {});

/// The other way (`flags`: cv::ImreadModes); empty for what is no picture. An absurd header throws
/// cv::Exception.
cv::Mat decode(const std::vector<char>& bytes, int flags);

/// A camera or a film to be opened; a film to be written. Their methods are virtual, and so loaded
/// with them.
std::unique_ptr<cv::VideoCapture> makeVideoCapture();
std::unique_ptr<cv::VideoWriter> makeVideoWriter();

/// Four letters as cameras and films name their coding.
constexpr int fourcc(const char (&letters)[5]) {
  return letters[0] | letters[1] << 8 | letters[2] << 16 | letters[3] << 24;
}

}  // namespace palpa::ar
