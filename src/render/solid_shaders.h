#pragma once
// The shaders of solids.cpp.

namespace carom {

/// Points: which thing each shows, and its normal. CLOSED: of a shape that has an inside, faces turned outwards.
extern const char* const point_vertex_shader;
extern const char* const point_fragment_shader;
/// Rectangles of the picture.
extern const char* const rectangle_vertex_shader;
/// Pixels, of their points: colour and cover, and near / z. FINE: points along a pixel's side.
extern const char* const pixel_fragment_shader;
/// Those pixels onto the picture.
extern const char* const onto_fragment_shader;

}  // namespace carom
