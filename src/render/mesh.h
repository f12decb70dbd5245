#pragma once
// Meshes from files. A damaged file can crash assimp, hang it or fill the memory.
// The import therefore runs in a process of its own. That has limits for each of these, cannot write, and returns the
// mesh through a pipe.

#include "render/mesh_data.h"
#include "std.h"

namespace carom {

/// Reads a Wavefront (.obj), STL (.stl) or glTF 2 (.gltf, .glb) file. Of other files it reads only those in the same
/// folder and below that the file names. Polygons become triangles, and vertices at one position are joined. Missing
/// normals are computed, smooth where faces meet at less than 45 degrees. The mesh has no paint. Throws
/// runtime_error with the path and the fault.
Mesh read_mesh(const string& path, const MeshLimits& limits = {});

/// The same with the file's colours: base colours and their textures (PNG, JPEG), colours of vertices, and holes by
/// opacity. A part that blends is opaque where its opacity is 0.5 or more. Of a file without colours it is read_mesh.
/// A texture or material file that is missing or cannot be read is an error.
Mesh read_painted_mesh(const string& path, const MeshLimits& limits = {});

/// Sets the function that is called 20 times a second during the wait for a mesh. An exception from it passes to the
/// caller of read_mesh. Set it once, at the start of the program.
void check_while_reading(function<void()> stop_check);

/// The vertices alone, for the fit of a volume.
vector<Vec3> read_mesh_points(const string& path, const MeshLimits& limits = {});

}  // namespace carom
