#pragma once
// The functions of OpenGL 4.5 and OSMesa that the render passes use, by their names without gl and OSMesa.
// They are loaded when the first picture is needed. The library and its compiler are large, and a run without pictures
// does not need them.
#define GL_GLEXT_PROTOTYPES
#include <GL/osmesa.h>

// clang-format off
#define CAROM_GL_FUNCTIONS(CAROM) \
  CAROM(ActiveTexture) CAROM(AttachShader) CAROM(BindBuffer) CAROM(BindFramebuffer) CAROM(BindTexture) \
  CAROM(BindVertexArray) CAROM(BlendEquation) CAROM(BlendFunc) CAROM(BufferData) CAROM(CheckFramebufferStatus) \
  CAROM(ClearBufferfv) CAROM(ClearBufferuiv) CAROM(CompileShader) CAROM(CopyImageSubData) CAROM(CreateProgram) \
  CAROM(CreateShader) CAROM(DeleteBuffers) CAROM(DeleteFramebuffers) CAROM(DeleteProgram) CAROM(DeleteShader) \
  CAROM(DeleteTextures) CAROM(DeleteVertexArrays) CAROM(DepthFunc) CAROM(DepthMask) CAROM(Disable) \
  CAROM(DrawArrays) CAROM(DrawArraysInstanced) CAROM(DrawBuffers) CAROM(DrawElementsInstancedBaseInstance) \
  CAROM(Enable) CAROM(EnableVertexAttribArray) CAROM(FramebufferTexture2D) CAROM(FramebufferTextureLayer) \
  CAROM(FrontFace) CAROM(GenBuffers) CAROM(GenFramebuffers) CAROM(GenTextures) CAROM(GenVertexArrays) \
  CAROM(GenerateMipmap) CAROM(GetError) CAROM(GetProgramInfoLog) CAROM(GetProgramiv) CAROM(GetShaderInfoLog) \
  CAROM(GetShaderiv) CAROM(GetUniformLocation) CAROM(LinkProgram) CAROM(PixelStorei) CAROM(ReadPixels) \
  CAROM(ShaderSource) CAROM(TexBuffer) CAROM(TexParameteri) CAROM(TexStorage2D) CAROM(TexStorage3D) \
  CAROM(Uniform1f) CAROM(Uniform1i) CAROM(Uniform2f) CAROM(Uniform2i) CAROM(Uniform3f) CAROM(Uniform3fv) \
  CAROM(Uniform4f) CAROM(Uniform4fv) CAROM(UniformMatrix3fv) CAROM(UseProgram) CAROM(VertexAttribDivisor) \
  CAROM(VertexAttribPointer) CAROM(Viewport)
#define CAROM_OSMESA_FUNCTIONS(CAROM) \
  CAROM(CreateContextAttribs) CAROM(DestroyContext) CAROM(MakeCurrent)
// clang-format on

namespace carom::gl {

#define CAROM_FUNCTION(name) inline decltype(&::gl##name) name = nullptr;
CAROM_GL_FUNCTIONS(CAROM_FUNCTION)
#undef CAROM_FUNCTION

#define CAROM_FUNCTION(name) inline decltype(&::OSMesa##name) name = nullptr;
CAROM_OSMESA_FUNCTIONS(CAROM_FUNCTION)
#undef CAROM_FUNCTION

/// Loads all functions, once. Throws RenderError if the library or a function is missing.
void load_functions();

}  // namespace carom::gl
