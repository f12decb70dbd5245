#pragma once
// The functions of OpenGL 4.5 and OSMesa that the render passes use, by their names without gl and OSMesa. They are
// null before find_osmesa(). They are loaded for the first mesh of a picture. The library and its compiler are large,
// and a run without meshes does not need them.
#define GL_GLEXT_PROTOTYPES
#include <GL/osmesa.h>

// clang-format off
#define CAROM_GL_FUNCTIONS(CAROM) \
  CAROM(AttachShader) CAROM(BindBuffer) CAROM(BindFramebuffer) CAROM(BindTexture) CAROM(BindVertexArray) \
  CAROM(BufferData) CAROM(CheckFramebufferStatus) CAROM(ClearBufferfv) CAROM(ClearBufferuiv) CAROM(CompileShader) \
  CAROM(CreateProgram) CAROM(CreateShader) CAROM(DeleteBuffers) CAROM(DeleteFramebuffers) CAROM(DeleteProgram) \
  CAROM(DeleteShader) CAROM(DeleteTextures) CAROM(DeleteVertexArrays) CAROM(DepthFunc) CAROM(Disable) \
  CAROM(DrawBuffers) CAROM(DrawElementsInstancedBaseInstance) CAROM(Enable) CAROM(EnableVertexAttribArray) \
  CAROM(FramebufferTexture2D) CAROM(GenBuffers) CAROM(GenFramebuffers) CAROM(GenTextures) CAROM(GenVertexArrays) \
  CAROM(GetError) CAROM(GetProgramInfoLog) CAROM(GetProgramiv) CAROM(GetShaderInfoLog) CAROM(GetShaderiv) \
  CAROM(GetUniformLocation) CAROM(LinkProgram) CAROM(PixelStorei) CAROM(ReadBuffer) CAROM(ReadPixels) CAROM(ShaderSource) \
  CAROM(TexParameteri) CAROM(TexStorage2D) CAROM(TexSubImage2D) CAROM(Uniform1f) CAROM(Uniform2f) CAROM(Uniform3fv) CAROM(Uniform4f) \
  CAROM(UniformMatrix3fv) CAROM(UseProgram) CAROM(VertexAttribDivisor) CAROM(VertexAttribPointer) CAROM(Viewport)
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

}  // namespace carom::gl
