#include <opencv2/imgcodecs.hpp>
#include <opencv2/videoio.hpp>

#include "ar/codecs/opencv/loaded_codecs.h"

extern "C" const palpa::ar::LoadedCodecs palpa_loaded_codecs{
    .encode = cv::imencode,
    .decode = cv::imdecode,
    .newCapture = [] { return new cv::VideoCapture; },
    .newWriter = [] { return new cv::VideoWriter; },
};
