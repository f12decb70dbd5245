// OpenGL off-screen, by OSMesa with its software renderer llvmpipe. It needs no display. Other drivers of OSMesa give
// other bytes, or are many times slower. Objects free themselves, and every error becomes a RenderError.
#include "render/gl.h"

#include <fmt/format.h>

#include <cstdlib>

#include "render/gl_threads.h"
#include "render/osmesa.h"
#include "render/render_error.h"
#include "std.h"

namespace carom::gl {
namespace {

GLuint made(void (*generate)(GLsizei, GLuint*)) {
  GLuint name = 0;
  generate(1, &name);
  return name;
}

GLuint compile(GLenum kind, std::initializer_list<string_view> parts) {
  string text = "#version 450 core\n";
  for (string_view part : parts) text += part;

  const GLuint shader = gl::CreateShader(kind);
  const char* source = text.c_str();
  gl::ShaderSource(shader, 1, &source, nullptr);
  gl::CompileShader(shader);

  GLint ok = 0;
  gl::GetShaderiv(shader, GL_COMPILE_STATUS, &ok);
  if (ok) return shader;

  string log(4096, '\0');
  GLsizei length = 0;
  gl::GetShaderInfoLog(shader, GLsizei(log.size()), &length, log.data());
  log.resize(size_t(length));
  gl::DeleteShader(shader);
  throw RenderError(fmt::format("a shader does not compile on this OpenGL: {}", log));
}

}  // namespace

Context::Context() {
  find_osmesa();
  // The other drivers that OSMesa may choose give other bytes, or are many times slower.
  setenv("GALLIUM_DRIVER", "llvmpipe", 1);

  // The drawing threads are made with the first context, and stay.
  static const bool threads_chosen = (choose_threads(), true);
  (void)threads_chosen;

  const int attributes[] = {OSMESA_FORMAT,
                            OSMESA_RGBA,
                            OSMESA_PROFILE,
                            OSMESA_CORE_PROFILE,
                            OSMESA_CONTEXT_MAJOR_VERSION,
                            4,
                            OSMESA_CONTEXT_MINOR_VERSION,
                            5,
                            0,
                            0};

  context_ = CreateContextAttribs(attributes, nullptr);
  if (!context_)
    throw RenderError(
        "OSMesa has no OpenGL 4.5, which meshes in pictures need\n  install OSMesa 22.3 or later with llvmpipe (on "
        "Debian: "
        "apt install libosmesa6), or leave out each `mesh` or the pictures");

  // Without its threads, a context cannot even be destroyed.
  check_threads();
  try {
    make_current();
  } catch (...) {
    DestroyContext(context_);
    throw;
  }
}

Context::~Context() {
  DestroyContext(context_);
}

void Context::make_current() {
  if (!MakeCurrent(context_, window_.data(), GL_UNSIGNED_BYTE, 8, 8))
    throw RenderError("cannot use the OpenGL context for pictures: is there enough memory?");
}

Buffer make_buffer() {
  return Buffer(made(gl::GenBuffers));
}

Vertices make_vertices() {
  return Vertices(made(gl::GenVertexArrays));
}

Texture make_texture(GLenum format, int width, int height, int levels) {
  Texture texture(made(gl::GenTextures));
  gl::BindTexture(GL_TEXTURE_2D, texture.name());
  gl::TexStorage2D(GL_TEXTURE_2D, levels, format, width, height);
  gl::TexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MIN_FILTER, GL_NEAREST);
  gl::TexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MAG_FILTER, GL_NEAREST);
  return texture;
}

Framebuffer make_framebuffer(span<const GLuint> colors, GLuint depth) {
  Framebuffer framebuffer(made(gl::GenFramebuffers));
  gl::BindFramebuffer(GL_FRAMEBUFFER, framebuffer.name());

  vector<GLenum> targets;
  for (GLuint color : colors) {
    targets.push_back(GL_COLOR_ATTACHMENT0 + GLenum(targets.size()));
    gl::FramebufferTexture2D(GL_FRAMEBUFFER, targets.back(), GL_TEXTURE_2D, color, 0);
  }
  if (depth) gl::FramebufferTexture2D(GL_FRAMEBUFFER, GL_DEPTH_ATTACHMENT, GL_TEXTURE_2D, depth, 0);
  gl::DrawBuffers(GLsizei(targets.size()), targets.data());

  check("allocating the picture");
  if (gl::CheckFramebufferStatus(GL_FRAMEBUFFER) != GL_FRAMEBUFFER_COMPLETE)
    throw RenderError("this OpenGL cannot draw into pictures of this size");
  return framebuffer;
}

Program::Program(std::initializer_list<string_view> vertex, std::initializer_list<string_view> fragment)
    : handle_(gl::CreateProgram()) {
  for (const auto& [kind, parts] : {pair{GL_VERTEX_SHADER, vertex}, pair{GL_FRAGMENT_SHADER, fragment}}) {
    const GLuint shader = compile(GLenum(kind), parts);
    gl::AttachShader(handle_.name(), shader);
    gl::DeleteShader(shader);
  }

  gl::LinkProgram(handle_.name());
  GLint ok = 0;
  gl::GetProgramiv(handle_.name(), GL_LINK_STATUS, &ok);
  if (ok) return;

  string log(4096, '\0');
  GLsizei length = 0;
  gl::GetProgramInfoLog(handle_.name(), GLsizei(log.size()), &length, log.data());
  log.resize(size_t(length));
  throw RenderError(fmt::format("a shader does not link on this OpenGL: {}", log));
}

void check(const char* doing) {
  const GLenum error = gl::GetError();
  if (error == GL_NO_ERROR) return;
  if (error == GL_OUT_OF_MEMORY) throw RenderError(fmt::format("out of memory while {}", doing));
  throw RenderError(fmt::format("OpenGL error 0x{:04x} while {}", error, doing));
}

}  // namespace carom::gl
