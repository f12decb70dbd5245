// Loads OSMesa at run time, at the first use. Linked normally, it would be loaded in every run, and it is large.
#include "render/gl_functions.h"

#include <dlfcn.h>
#include <fmt/format.h>

#include "render/osmesa.h"
#include "render/render_error.h"
#include "std.h"

namespace carom::gl {
namespace {

[[noreturn]] void fail() {
  const char* const reason = dlerror();
  throw RenderError(
      fmt::format("meshes in pictures need OSMesa, which cannot be loaded: {}\n  install it (on Debian: apt install "
                  "libosmesa6; for carom's archive: unpack that of meshes in the same place), or leave out each `mesh` "
                  "or the pictures",
                  reason ? reason : "no reason given"));
}

template <typename Function>
void find(void* library, const char* name, Function& function) {
  function = reinterpret_cast<Function>(dlsym(library, name));
  if (!function) fail();
}

bool load() {
  void* const library = dlopen("libOSMesa.so.8", RTLD_NOW | RTLD_LOCAL);
  if (!library) fail();
#define CAROM_FUNCTION(name) find(library, "gl" #name, name);
  CAROM_GL_FUNCTIONS(CAROM_FUNCTION)
#undef CAROM_FUNCTION
#define CAROM_FUNCTION(name) find(library, "OSMesa" #name, name);
  CAROM_OSMESA_FUNCTIONS(CAROM_FUNCTION)
#undef CAROM_FUNCTION
  return true;
}

}  // namespace

}  // namespace carom::gl

void carom::find_osmesa() {
  static const bool loaded = gl::load();
  (void)loaded;
}
