// Encodes PNG with libpng, with the one filter that suits rendered pictures.
// On errors libpng calls longjmp, so the function that it leaves holds no object with a destructor.
#include "export/png.h"

#include <png.h>

#include <csetjmp>
#include <cstddef>
#include <new>
#include <vector>

#include "files/run_folder.h"

namespace carom {
namespace {

struct Sink {
  std::string bytes;
  std::string error;
};

void append(png_structp png, png_bytep data, png_size_t size) {
  auto& sink = *static_cast<Sink*>(png_get_io_ptr(png));
  try {
    sink.bytes.append(reinterpret_cast<const char*>(data), size);
  } catch (const std::bad_alloc&) {
    // No exception may cross the C frames of libpng.
    png_error(png, "out of memory");
  }
}

void note_error(png_structp png, png_const_charp message) {
  static_cast<Sink*>(png_get_error_ptr(png))->error = message;
  png_longjmp(png, 1);
}

void ignore_warning(png_structp, png_const_charp) {}

/// One row as RGBA, 4 bytes a pixel.
void interleave(const Image& image, int y, std::uint8_t* row) {
  const auto width = static_cast<std::size_t>(image.width);
  const std::uint8_t* const rgb = image.row(y);
  const std::uint8_t* const alpha = image.alpha.data() + static_cast<std::size_t>(y) * width;
  for (std::size_t x = 0; x < width; ++x) {
    for (std::size_t c = 0; c < 3; ++c) row[4 * x + c] = rgb[3 * x + c];
    row[4 * x + 3] = alpha[x];
  }
}

/// The part that libpng leaves by longjmp on failure. It holds no object with a destructor. `row`: for RGBA.
bool encode(const Image& image, PngEffort effort, Sink& sink, std::uint8_t* row) {
  png_structp png = png_create_write_struct(PNG_LIBPNG_VER_STRING, &sink, note_error, ignore_warning);
  if (!png) return false;
  png_infop info = png_create_info_struct(png);
  if (!info || setjmp(png_jmpbuf(png))) {
    png_destroy_write_struct(&png, &info);
    return false;
  }
  png_set_write_fn(png, &sink, append, nullptr);
  png_set_user_limits(png, PNG_UINT_31_MAX, PNG_UINT_31_MAX);
  png_set_IHDR(png, info, static_cast<png_uint_32>(image.width), static_cast<png_uint_32>(image.height), 8,
               image.alpha.empty() ? PNG_COLOR_TYPE_RGB : PNG_COLOR_TYPE_RGB_ALPHA, PNG_INTERLACE_NONE,
               PNG_COMPRESSION_TYPE_DEFAULT, PNG_FILTER_TYPE_DEFAULT);
  png_set_sRGB(png, info, PNG_sRGB_INTENT_PERCEPTUAL);
  // Rendered pictures repeat from row to row, even at a checker's edges.
  // The difference to the row above is therefore small and often the same.
  // Of all filters, levels and strategies, UP at level 1 is within a tenth of the fastest.
  // None that is as fast makes smaller files. Choosing a filter row by row takes twice as long and gains nothing.
  png_set_filter(png, 0, PNG_FILTER_UP);
  png_set_compression_level(png, effort == PngEffort::fast ? 1 : 9);
  png_set_compression_buffer_size(png, std::size_t{64} * 1024);
  png_write_info(png, info);
  for (int y = 0; y < image.height; ++y) {
    if (image.alpha.empty()) {
      png_write_row(png, image.row(y));
    } else {
      interleave(image, y, row);
      png_write_row(png, row);
    }
  }
  png_write_end(png, nullptr);
  png_destroy_write_struct(&png, &info);
  return true;
}

}  // namespace

std::string encode_png(const Image& image, PngEffort effort) {
  const auto size = static_cast<std::size_t>(image.width) * static_cast<std::size_t>(image.height) * 3;
  if (image.width < 1 || image.height < 1 || image.pixels.size() != size ||
      (!image.alpha.empty() && image.alpha.size() * 3 != size))
    throw ExportError("cannot write a picture: its size does not fit its pixels");
  Sink sink;
  std::vector<std::uint8_t> row(image.alpha.empty() ? 0 : 4 * static_cast<std::size_t>(image.width));
  if (!encode(image, effort, sink, row.data())) throw ExportError("cannot write a picture: " + sink.error);
  return std::move(sink.bytes);
}

}  // namespace carom
