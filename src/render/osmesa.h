#pragma once
// OSMesa, which draws meshes. It is large, so that it is loaded when it is first needed.

namespace carom {

/// Loads OSMesa, unless it is loaded. Throws RenderError.
void find_osmesa();

}  // namespace carom
