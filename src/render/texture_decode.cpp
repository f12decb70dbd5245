// Decodes textures by libpng and libjpeg. Only what the file says about its size is checked here: the process has
// limits of memory and time, and its result is checked by the process that receives it.
#include "render/texture_decode.h"

#include <fmt/format.h>
#include <png.h>

#include <csetjmp>
#include <cstdio>

// After <cstdio>, which it needs.
#include <jpeglib.h>

#include <jerror.h>

#include "render/texture_levels.h"
#include "std.h"

namespace carom {
namespace {

[[noreturn]] void refuse_damaged() {
  throw runtime_error("is damaged. Remedy: save it again, or give the body a `color`");
}

MeshTexture blank(uint64_t width, uint64_t height, uint64_t most_pixels) {
  if (width == 0 || height == 0) throw runtime_error("has no pixels");
  if (width > most_pixels / height)
    throw runtime_error(fmt::format("has {} x {} pixels; at most {} in all are read. Remedy: scale it down", width,
                                    height, most_pixels));
  return {uint32_t(width), uint32_t(height), vector<uint8_t>(4 * width * height)};
}

MeshTexture png_texture(string_view bytes, uint64_t most_pixels) {
  png_image png{};
  png.version = PNG_IMAGE_VERSION;
  if (!png_image_begin_read_from_memory(&png, bytes.data(), bytes.size())) refuse_damaged();
  png.format = PNG_FORMAT_RGBA;
  MeshTexture texture = blank(png.width, png.height, most_pixels);
  if (!png_image_finish_read(&png, nullptr, texture.rgba.data(), 0, nullptr)) refuse_damaged();
  return texture;
}

struct JpegReader {
  jpeg_decompress_struct reader{};
  jpeg_error_mgr errors{};
  std::jmp_buf failed{};
};

[[noreturn]] void leave(j_common_ptr reader) {
  std::longjmp(static_cast<JpegReader*>(reader->client_data)->failed, 1);
}

/// A file that ends too early is damaged. Other warnings are ignored.
void note(j_common_ptr reader, int level) {
  if (level < 0 && reader->err->msg_code == JWRN_JPEG_EOF) leave(reader);
}

// The two functions that may be left by a jump have no objects with destructors.

bool read_jpeg_head(JpegReader& jpeg, const unsigned char* bytes, unsigned long size) {
  jpeg.reader.err = jpeg_std_error(&jpeg.errors);
  jpeg.errors.error_exit = leave;
  jpeg.errors.emit_message = note;
  jpeg.reader.client_data = &jpeg;
  if (setjmp(jpeg.failed)) return false;
  jpeg_create_decompress(&jpeg.reader);
  jpeg_mem_src(&jpeg.reader, bytes, size);
  jpeg_read_header(&jpeg.reader, TRUE);
  jpeg.reader.out_color_space = JCS_EXT_RGBA;
  jpeg.reader.dct_method = JDCT_ISLOW;
  return true;
}

bool read_jpeg_rows(JpegReader& jpeg, unsigned char* rgba) {
  if (setjmp(jpeg.failed)) return false;
  jpeg_start_decompress(&jpeg.reader);
  while (jpeg.reader.output_scanline < jpeg.reader.output_height) {
    unsigned char* row = rgba + size_t{4} * jpeg.reader.output_width * jpeg.reader.output_scanline;
    jpeg_read_scanlines(&jpeg.reader, &row, 1);
  }
  return true;
}

/// The reader's memory is freed with the process.
MeshTexture jpeg_texture(string_view bytes, uint64_t most_pixels) {
  JpegReader jpeg;
  if (!read_jpeg_head(jpeg, reinterpret_cast<const unsigned char*>(bytes.data()), bytes.size())) refuse_damaged();
  if (jpeg.reader.jpeg_color_space == JCS_CMYK || jpeg.reader.jpeg_color_space == JCS_YCCK)
    throw runtime_error("has the colours of a print (CMYK). Remedy: convert it to RGB");
  MeshTexture texture = blank(jpeg.reader.image_width, jpeg.reader.image_height, most_pixels);
  if (!read_jpeg_rows(jpeg, texture.rgba.data())) refuse_damaged();
  return texture;
}

}  // namespace

MeshTexture decoded_texture(string_view bytes, uint64_t most_pixels, uint64_t most_kept) {
  using namespace std::string_view_literals;
  MeshTexture texture;

  if (bytes.starts_with("\x89PNG"sv)) {
    texture = png_texture(bytes, most_pixels);
  } else if (bytes.starts_with("\xff\xd8\xff"sv)) {
    texture = jpeg_texture(bytes, most_pixels);
  } else {
    throw runtime_error("is neither PNG nor JPEG. Remedy: convert it, or give the body a `color`");
  }

  // Halved until it is small enough.
  uint32_t width = texture.width, height = texture.height;
  while (width > longest_texture_side || height > longest_texture_side || uint64_t{width} * height > most_kept) {
    width = max(width / 2, 1U);
    height = max(height / 2, 1U);
  }
  return width == texture.width ? texture : reduced(texture, width, height);
}

}  // namespace carom
