#pragma once
// Pictures as PNG.
#include <string>

#include "render/image.h"

namespace carom {

/// How hard to press: `fast` for frames by the hundred, `small` for one picture that stays.
enum class PngEffort { fast, small };

/// The PNG file of an 8-bit RGB picture, marked as sRGB. The same picture gives the same bytes. Throws ExportError.
std::string encode_png(const Image& image, PngEffort effort);

}  // namespace carom
