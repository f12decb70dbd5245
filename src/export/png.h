#pragma once
// Pictures as PNG.
#include <string>

#include "render/image.h"

namespace carom {

/// The compression effort: `fast` for hundreds of frames, `small` for a single picture that is kept.
enum class PngEffort { fast, small };

/// An 8-bit RGB picture, or RGBA if it has opacity, as a PNG file, marked as sRGB. The same picture gives the same
/// bytes. Throws ExportError.
std::string encode_png(const Image& image, PngEffort effort);

}  // namespace carom
