#pragma once
// PNG and JPEG files of textures to pixels, in the child process only.

#include "render/mesh_data.h"
#include "std.h"

namespace carom {

/// `most_pixels`: of the file; `most_kept`: of the result, which is scaled down to so many. Throws runtime_error
/// with the fault. Its text follows the name of the file: "is neither PNG nor JPEG".
MeshTexture decoded_texture(string_view bytes, uint64_t most_pixels, uint64_t most_kept);

}  // namespace carom
