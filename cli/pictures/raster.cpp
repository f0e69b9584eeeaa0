#include "cli/pictures/raster.h"

#include <fmt/format.h>
#include <librsvg/rsvg.h>

#include <array>
#include <cmath>
#include <cstdint>
#include <memory>
#include <string_view>

#include "pintle/results.h"

namespace pintle::cli {
namespace {

struct Release {
  void operator()(cairo_surface_t* surface) const { cairo_surface_destroy(surface); }
  void operator()(cairo_t* pen) const { cairo_destroy(pen); }
  void operator()(RsvgHandle* handle) const { g_object_unref(handle); }
};
template <class T>
using Held = std::unique_ptr<T, Release>;

[[noreturn]] void fail(const std::string& why) {
  throw FileError(fmt::format("The picture could not be rasterised: {}.\n    A smaller --width or --dpi may help.", why));
}

void fail_if(GError* error) {
  if (!error) return;
  const std::string why = error->message;
  g_error_free(error);
  fail(why);
}

Held<cairo_surface_t> paint(const std::string& svg, double scale) {
  GError* error = nullptr;
  const Held<RsvgHandle> handle(rsvg_handle_new_from_data(reinterpret_cast<const guint8*>(svg.data()), svg.size(), &error));
  fail_if(error);
  gdouble width = 0, height = 0;
  rsvg_handle_get_intrinsic_size_in_pixels(handle.get(), &width, &height);
  const int columns = static_cast<int>(std::lround(width * scale)), rows = static_cast<int>(std::lround(height * scale));
  Held<cairo_surface_t> surface(cairo_image_surface_create(CAIRO_FORMAT_RGB24, columns, rows));
  if (const auto status = cairo_surface_status(surface.get())) fail(cairo_status_to_string(status));
  const Held<cairo_t> pen(cairo_create(surface.get()));
  const RsvgRectangle all{0, 0, static_cast<double>(columns), static_cast<double>(rows)};
  rsvg_handle_render_document(handle.get(), pen.get(), &all, &error);
  fail_if(error);
  if (const auto status = cairo_status(pen.get())) fail(cairo_status_to_string(status));
  cairo_surface_flush(surface.get());
  return surface;
}

cairo_status_t append(void* text, const unsigned char* bytes, unsigned int n) {
  static_cast<std::string*>(text)->append(reinterpret_cast<const char*>(bytes), n);
  return CAIRO_STATUS_SUCCESS;
}

std::string big_endian(std::uint32_t x) {
  std::string bytes;
  for (int shift = 24; shift >= 0; shift -= 8) bytes += static_cast<char>((x >> shift) & 0xff);
  return bytes;
}

/// The checksum of a PNG chunk: ISO 3309, polynomial 0xedb88320.
std::uint32_t check_sum(std::string_view bytes) {
  std::uint32_t sum = 0xffffffff;
  for (const char c : bytes) {
    sum ^= static_cast<unsigned char>(c);
    for (int bit = 0; bit < 8; ++bit) sum = sum & 1 ? sum >> 1 ^ 0xedb88320 : sum >> 1;
  }
  return ~sum;
}

/// The chunk with the pixels per metre, which follows the header of a PNG file.
std::string density_chunk(double dots_per_inch) {
  constexpr double kInch = 0.0254;  // [m]
  const std::string density = big_endian(static_cast<std::uint32_t>(std::lround(dots_per_inch / kInch)));
  const std::string content = "pHYs" + density + density + '\x01';
  return big_endian(9) + content + big_endian(check_sum(content));
}

}  // namespace

bool can_rasterise() { return true; }

Pixels pixels_of(const std::string& svg, double scale) {
  const auto surface = paint(svg, scale);
  Pixels pixels{cairo_image_surface_get_width(surface.get()), cairo_image_surface_get_height(surface.get()), {}};
  const std::size_t row = 4 * static_cast<std::size_t>(pixels.width), stride = static_cast<std::size_t>(cairo_image_surface_get_stride(surface.get()));
  pixels.bytes.reserve(row * static_cast<std::size_t>(pixels.height));
  const unsigned char* from = cairo_image_surface_get_data(surface.get());
  for (int y = 0; y < pixels.height; ++y, from += stride) pixels.bytes.insert(pixels.bytes.end(), from, from + row);
  for (std::size_t i = 3; i < pixels.bytes.size(); i += 4) pixels.bytes[i] = 255;
  return pixels;
}

std::string png_of(const std::string& svg, double dots_per_inch) {
  constexpr std::size_t kAfterHead = 8 + 25;  // after the signature and the chunk IHDR
  const auto surface = paint(svg, dots_per_inch / 96);
  std::string png;
  if (const auto status = cairo_surface_write_to_png_stream(surface.get(), append, &png)) fail(cairo_status_to_string(status));
  return png.insert(kAfterHead, density_chunk(dots_per_inch));
}

}  // namespace pintle::cli
