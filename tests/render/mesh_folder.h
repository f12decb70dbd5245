#pragma once
// Mesh files in a temporary folder, and the errors of reading them.
#include <gtest/gtest.h>
#include <stdlib.h>

#include <filesystem>
#include <fstream>

#include "render/mesh.h"
#include "std.h"

namespace carom::test {

/// A temporary folder.
struct MeshFolder {
  MeshFolder() {
    string name = ::testing::TempDir() + "carom_mesh_XXXXXX";
    if (!mkdtemp(name.data())) ADD_FAILURE() << "no temporary folder";
    path = name + "/";
  }
  ~MeshFolder() { std::filesystem::remove_all(path); }
  MeshFolder(const MeshFolder&) = delete;
  MeshFolder& operator=(const MeshFolder&) = delete;
  string write(const string& name, const string& bytes) const {
    std::ofstream(path + name, std::ios::binary) << bytes;
    return path + name;
  }
  string path;
};

/// The error of read_mesh or read_painted_mesh after the path; "" if the file is read.
template <typename Read>
string trouble_of(Read read, const string& path, const MeshLimits& limits) {
  try {
    read(path, limits);
    return "";
  } catch (const runtime_error& error) {
    const string text = error.what(), start = "cannot read the mesh " + path + ": ";
    EXPECT_EQ(text.substr(0, start.size()), start);
    return text.substr(std::min(start.size(), text.size()));
  }
}

}  // namespace carom::test
