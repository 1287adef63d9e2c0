#include "apps/report/page/small_picture.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstdint>
#include <cstring>

#include <cairo/cairo.h>
#include <webp/encode.h>

#include "anatomy/base/error.h"

namespace palpa::report {
namespace {

static_assert(std::endian::native == std::endian::little, "Cairo's pixels are taken as B, G, R, x");

/// Of 100; type stays legible, grain of a camera goes.
constexpr float kQuality = 75;

cairo_status_t takePng(void* left, unsigned char* into, unsigned length) {
  auto& bytes = *static_cast<std::string_view*>(left);
  if (bytes.size() < length) return CAIRO_STATUS_READ_ERROR;
  std::memcpy(into, bytes.data(), length);
  bytes.remove_prefix(length);
  return CAIRO_STATUS_SUCCESS;
}

std::shared_ptr<cairo_surface_t> owned(cairo_surface_t* surface) {
  return {surface, cairo_surface_destroy};
}

/// `picture` so large, upon white where it is not opaque.
std::shared_ptr<cairo_surface_t> scaled(cairo_surface_t* picture, int wide, int high, double by) {
  auto surface = owned(cairo_image_surface_create(CAIRO_FORMAT_RGB24, wide, high));
  const std::unique_ptr<cairo_t, decltype(&cairo_destroy)> pen(cairo_create(surface.get()),
                                                               cairo_destroy);
  cairo_set_source_rgb(pen.get(), 1, 1, 1);
  cairo_paint(pen.get());
  cairo_scale(pen.get(), by, by);
  cairo_set_source_surface(pen.get(), picture, 0, 0);
  cairo_pattern_set_filter(cairo_get_source(pen.get()), CAIRO_FILTER_BEST);
  cairo_pattern_set_extend(cairo_get_source(pen.get()), CAIRO_EXTEND_PAD);
  cairo_paint(pen.get());
  cairo_surface_flush(surface.get());
  return surface;
}

int appendWebp(const std::uint8_t* data, std::size_t length, const WebPPicture* picture) {
  static_cast<std::string*>(picture->custom_ptr)
      ->append(reinterpret_cast<const char*>(data), length);
  return 1;
}

}  // namespace

SmallPicture::SmallPicture(std::string_view png) {
  constexpr std::string_view kSigns = "\x89PNG\r\n\x1a\n";
  if (!png.starts_with(kSigns)) return;
  auto surface = owned(cairo_image_surface_create_from_png_stream(takePng, &png));
  if (cairo_surface_status(surface.get()) != CAIRO_STATUS_SUCCESS) return;
  surface_ = std::move(surface);
  wide_ = cairo_image_surface_get_width(surface_.get());
  high_ = cairo_image_surface_get_height(surface_.get());
}

std::string SmallPicture::webp(int wide) const {
  const double by = std::min(1.0, static_cast<double>(wide) / wide_);
  WebPConfig config;
  WebPPicture picture;
  if (!WebPConfigPreset(&config, WEBP_PRESET_PICTURE, kQuality) || !WebPPictureInit(&picture))
    throw Error("is another than Palpa was built with", "the library libwebp",
                "Install Palpa again, with all that it depends on");
  picture.width = std::max(1, static_cast<int>(std::lround(by * wide_)));
  picture.height = std::max(1, static_cast<int>(std::lround(by * high_)));
  const auto small = scaled(surface_.get(), picture.width, picture.height, by);
  std::string bytes;
  picture.writer = appendWebp;
  picture.custom_ptr = &bytes;
  const bool good = cairo_surface_status(small.get()) == CAIRO_STATUS_SUCCESS &&
                    WebPPictureImportBGRX(&picture, cairo_image_surface_get_data(small.get()),
                                          cairo_image_surface_get_stride(small.get())) &&
                    WebPEncode(&config, &picture);
  WebPPictureFree(&picture);
  if (!good)
    throw Error("could not be made small", "a picture of the report", "Is there memory left?");
  return bytes;
}

}  // namespace palpa::report
