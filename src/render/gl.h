#pragma once
// The part of OpenGL that the render passes use: an off-screen context, and objects that free themselves.
#include <initializer_list>

#include "render/gl_functions.h"
#include "std.h"

namespace carom::gl {

/// One off-screen OpenGL 4.5 core context on llvmpipe. Throws RenderError.
class Context {
 public:
  Context();
  ~Context();
  Context(const Context&) = delete;
  Context& operator=(const Context&) = delete;
  void make_current();

 private:
  OSMesaContext context_;
  // OSMesa needs a window. Pictures are drawn into textures instead.
  array<unsigned char, 4 * 8 * 8> window_{};
};

/// The name of an OpenGL object. It is freed with its owner. The owner's context must then be current.
template <void (*release)(GLuint)>
class Handle {
 public:
  Handle() = default;
  explicit Handle(GLuint name) : name_(name) {}
  Handle(Handle&& other) noexcept : name_(other.name_) { other.name_ = 0; }
  Handle& operator=(Handle&& other) noexcept {
    std::swap(name_, other.name_);
    return *this;
  }
  ~Handle() {
    if (name_) release(name_);
  }
  GLuint name() const { return name_; }

 private:
  GLuint name_ = 0;
};

inline void release_texture(GLuint name) {
  gl::DeleteTextures(1, &name);
}
inline void release_buffer(GLuint name) {
  gl::DeleteBuffers(1, &name);
}
inline void release_framebuffer(GLuint name) {
  gl::DeleteFramebuffers(1, &name);
}
inline void release_vertices(GLuint name) {
  gl::DeleteVertexArrays(1, &name);
}
inline void release_program(GLuint name) {
  gl::DeleteProgram(name);
}

using Texture = Handle<release_texture>;
using Buffer = Handle<release_buffer>;
using Framebuffer = Handle<release_framebuffer>;
using Vertices = Handle<release_vertices>;

Buffer make_buffer();
Vertices make_vertices();
/// A texture with so many levels, of which the finest is shown, without interpolation.
Texture make_texture(GLenum format, int width, int height, int levels = 1);
/// Draws into `colors` in this order, and tests against `depth` (0: none). Throws RenderError.
Framebuffer make_framebuffer(span<const GLuint> colors, GLuint depth);

/// A vertex and a fragment shader. Throws RenderError with the compiler's own text.
class Program {
 public:
  /// `parts` are appended to the version line.
  Program(std::initializer_list<string_view> vertex, std::initializer_list<string_view> fragment);
  void use() const { gl::UseProgram(handle_.name()); }
  GLint at(const char* uniform) const { return gl::GetUniformLocation(handle_.name(), uniform); }

 private:
  Handle<release_program> handle_;
};

/// Throws RenderError if an OpenGL call has failed since the last check. `doing` names the operation for the message.
void check(const char* doing);

}  // namespace carom::gl
