#include "ar/codecs/codecs.h"

#include <dlfcn.h>

#include "anatomy/base/error.h"
#include "ar/codecs/opencv/loaded_codecs.h"

namespace palpa::ar {
namespace {

constexpr char kLibrary[] = "libpalpa_opencv_codecs.so";

const LoadedCodecs& load() {
  // Stays loaded: what it made may live until the process ends.
  void* library = ::dlopen(kLibrary, RTLD_NOW | RTLD_LOCAL);
  const void* table = library ? ::dlsym(library, kLoadedCodecs) : nullptr;
  if (!table) {
    const char* reason = ::dlerror();
    throw Error(std::string("cannot be loaded (") + (reason ? reason : "no reason given") + ")",
                std::string("the codecs of pictures and films, ") + kLibrary,
                "Install Palpa again, with all that it depends on");
  }
  return *static_cast<const LoadedCodecs*>(table);
}

const LoadedCodecs& codecs() {
  static const LoadedCodecs& loaded = load();
  return loaded;
}

}  // namespace

void loadCodecs() { codecs(); }

std::vector<std::uint8_t> encode(const char* ending, const cv::Mat& picture,
                                 const std::vector<int>& parameters) {
  std::vector<std::uint8_t> bytes;
  if (!codecs().encode(ending, picture, bytes, parameters)) bytes.clear();
  return bytes;
}

cv::Mat decode(const std::vector<char>& bytes, int flags) { return codecs().decode(bytes, flags); }

std::unique_ptr<cv::VideoCapture> makeVideoCapture() {
  return std::unique_ptr<cv::VideoCapture>(codecs().newCapture());
}

std::unique_ptr<cv::VideoWriter> makeVideoWriter() {
  return std::unique_ptr<cv::VideoWriter>(codecs().newWriter());
}

}  // namespace palpa::ar
