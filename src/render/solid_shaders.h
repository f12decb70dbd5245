#pragma once
// The shaders of solids.cpp.

namespace carom {

/// For points: the number and the normal of the visible thing. CLOSED: the shape has an inside, and its faces point
/// outwards.
extern const char* const point_vertex_shader;
extern const char* const point_fragment_shader;
/// For rectangles of the picture.
extern const char* const rectangle_vertex_shader;
/// For pixels, from their points: colour and coverage, and near / z. FINE: points along a pixel's side.
extern const char* const pixel_fragment_shader;
/// For the transfer of those pixels to the picture.
extern const char* const onto_fragment_shader;

}  // namespace carom
