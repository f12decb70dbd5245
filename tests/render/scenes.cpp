#include "render/scenes.h"

#include <fstream>

#include "std.h"

namespace carom::test {

bool write_ppm(const Image& image, const string& path) {
  std::ofstream file(path, std::ios::binary);
  file << "P6\n" << image.width << ' ' << image.height << "\n255\n";
  file.write(reinterpret_cast<const char*>(image.pixels.data()), static_cast<std::streamsize>(image.pixels.size()));
  return file.good();
}

}  // namespace carom::test
