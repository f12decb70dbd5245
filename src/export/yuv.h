#pragma once
// Pictures as the film's luma and chroma.

#include "render/image.h"
#include "scene/output.h"
#include "std.h"

namespace carom {

/// The size of a picture in yuv420p: both sides are even.
Size yuv_size(const Image& image);

/// Fills `planes` with the picture as yuv420p, BT.709, limited range: the plane of Y', then those of Cb and Cr at half
/// the width and height. An odd side repeats its last pixel. A picture with opacity is shown on black.
///
/// With R', G', B' from 0 to 255 as in the picture:
///   Y' =  16 + 219/255 (0.2126 R' + 0.7152 G' + 0.0722 B')
///   Cb = 128 + 224/255 (B' - L) / (2 (1 - 0.0722))
///   Cr = 128 + 224/255 (R' - L) / (2 (1 - 0.2126)),   L = 0.2126 R' + 0.7152 G' + 0.0722 B'
/// Each is rounded once, exactly, halves upwards. Chroma is that of the mean of its 2 x 2 pixels, and lies in their
/// middle.
void to_yuv420p(const Image& image, vector<uint8_t>& planes);

}  // namespace carom
