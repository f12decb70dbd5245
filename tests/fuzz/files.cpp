// Files that are read back: meshes, flights.bin, manifests, tables.
#include <sys/mman.h>

#include <cstring>

#include "export/exports.h"
#include "export/flights_file.h"
#include "files/gzip.h"
#include "files/manifest.h"
#include "files/stored_table.h"
#include "fuzz/memory_file.h"
#include "fuzz/targets.h"
#include "paths.h"
#include "physics/world.h"
#include "render/mesh.h"
#include "render/mesh_reply.h"
#include "scene/scene.h"
#include "std.h"
#include "yaml/joined.h"

namespace carom::fuzz {

namespace {

const OwnFolder& folder() {
  static const OwnFolder own;
  return own;
}

void hold(const MeshPaint& paint, size_t vertices, size_t triangles) {
  if (paint.parts.empty()) return;
  if (paint.uv.size() != vertices || paint.tint.size() != vertices) throw Finding("a paint of other vertices");
  size_t in_parts = 0;
  for (const MeshPart& part : paint.parts) {
    in_parts += part.triangles;
    if (part.texture > paint.textures.size()) throw Finding("a part has a texture that is not there");
    for (const float x : part.factor)
      if (!(x >= 0 && x <= 1)) throw Finding("a colour is not between 0 and 1");
  }

  if (in_parts != triangles) throw Finding("parts of other triangles");
  for (const auto& uv : paint.uv)
    if (!isfinite(uv[0]) || !isfinite(uv[1])) throw Finding("a place in a texture is not finite");
  for (const MeshTexture& texture : paint.textures)
    if (texture.width == 0 || texture.rgba.size() != size_t{4} * texture.width * texture.height)
      throw Finding("a texture has other pixels");
}

void hold(const Mesh& mesh) {
  if (mesh.normals.size() != mesh.vertices.size()) throw Finding("normals of other vertices");
  if (mesh.triangles.empty() || mesh.triangles.size() % 3 != 0) throw Finding("no whole triangles");
  for (const uint32_t i : mesh.triangles)
    if (i >= mesh.vertices.size()) throw Finding("a triangle has a vertex that is not there");
  for (const auto* vectors : {&mesh.vertices, &mesh.normals})
    for (const Vec3& v : *vectors)
      if (!v.allFinite()) throw Finding("a mesh has a vector that is not finite");
  hold(mesh.paint, mesh.vertices.size(), mesh.triangles.size() / 3);
}

template <typename T>
void put(string& bytes, const vector<T>& values) {
  bytes.append(reinterpret_cast<const char*>(values.data()), values.size() * sizeof(T));
}

/// Four bodies that fall for 0.2 s.
Scene small_scene() {
  Scene scene;
  scene.file = "small.yaml";
  scene.title = "Small";
  scene.world.mass = {2, 1, 1, 1};
  scene.world.radius = {0.1, 0.1, 0.1, 0.1};
  scene.world.restitution = {1, 1, 1, 1};
  scene.initial.position = {Vec3(0, 1, 0), Vec3(1, 1, 0), Vec3(2, 1, 0), Vec3(3, 1, 0)};
  scene.initial.velocity.assign(4, Vec3::Zero());
  scene.roster.bodies = {{"red", 0, 1, false, {}}, {"gas", 1, 3, true, {}}};
  scene.simulate.duration = 0.2;
  scene.resolved = "scene: 1\n";
  return scene;
}

/// flights.bin with a piece of each kind.
string flights() {
  vector<PathPiece> pieces;
  for (Entity i = 0; i < 4; ++i) pieces.push_back({i, 0, {0, 0}, Vec3(i, 1, 0), Vec3(1, 0, 0), Vec3(0, -10, 0)});
  pieces.push_back({1, std::nextafter(0.1, 1), {0.1, 1e-18}, Vec3(1, 2, 3), Vec3(4, 5, 6), Vec3(0, -1, 0)});

  PathPiece step{3, 0.15, {0.15, -1e-18}, Vec3(7, 8, 9), Vec3(1, 1, 1), Vec3::Zero()};
  step.kicked = true;
  step.until = {0.175, 1e-19};
  step.kick = Vec3(0, -1, 0);

  PolynomialPath curve = PolynomialPath::parabola(0.5, Vec3(1, 1, 1), Vec3(0, -10, 0));
  curve.displacement.back() = Vec3(0, 1, -2);
  PathPiece curved{2, 0.17, {0.17, 0}, Vec3(7, 8, 9), Vec3(1, 1, 1), Vec3(0, -10, 0)};
  curved.curve = std::make_shared<PolynomialPath>(curve);

  PathPiece part{0, 0.1875, {0.1875, 0}, Vec3(1, 1, 1), Vec3::Zero(), Vec3::Zero()};
  part.part_of = 1;
  PathPiece joint{1, 0.1875, {0.1875, 0}, Vec3(1, 1, 1), Vec3(3, 0, 0), Vec3(0, -10, 0)};
  joint.joint = true;
  joint.mass = 3;
  joint.radius = 0.125;
  joint.half = Vec3::Constant(0.125);

  PathPiece other{2, 0.19, {0.19, 0}, Vec3(1, 1, 1), Vec3(3, 0, 0), Vec3(0, -10, 0)};
  other.fade = 0.25;
  PathPiece frame{3, 0.19, {0.2, 0}, Vec3(1, -1, 1), Vec3(-3, 0, 0), Vec3::Zero()};
  frame.law = PathLaw::frame;
  frame.rounding = 0x1p-40;

  for (const PathPiece& piece : {step, curved, part, joint, other, frame}) pieces.push_back(piece);
  // An impact of two of mass 1 and restitution 1: they swap velocities along x.
  for (const Entity i : {2u, 3u}) {
    const double side = i == 2 ? -1 : 1;
    pieces.push_back({i, 0.19, {0.19, 0}, Vec3(side, 0, 0), Vec3(-side, 0, 0), Vec3::Zero()});
  }
  for (const Entity i : {2u, 3u}) {
    const double side = i == 2 ? -1 : 1;
    pieces.push_back({i, 0.195, {0.195, 0}, Vec3(side * 0.995, 0, 0), Vec3(side, 0, 0), Vec3::Zero()});
  }

  const Scene scene = small_scene();
  FlightsFile file({folder().descriptor(), folder().path()}, scene);
  file.record_paths(pieces);
  file.end(Tally{});
  for (OutputFile* output : file.files()) output->publish();
  return bytes_of(folder().path() + "/" + flights_name);
}

/// The same, whose only block is repeated as a key.
string flights_with_key() {
  const string whole = flights();
  const size_t header = 32, tail = 216;
  string block = whole.substr(header, whole.size() - header - tail), end = whole.substr(whole.size() - tail);
  block[0] = 1;
  end[8] = 1;

  const double time = 0.15;
  const uint64_t place = whole.size() - tail, entries = 0;
  string key(24, '\0');
  std::memcpy(key.data(), &time, 8);
  std::memcpy(key.data() + 8, &place, 8);
  std::memcpy(key.data() + 16, &entries, 8);
  return whole.substr(0, place) + block + key + end;
}

uint32_t crc_of(string_view bytes) {
  uint32_t crc = ~0u;
  for (const char byte : bytes) {
    crc ^= static_cast<unsigned char>(byte);
    for (int bit = 0; bit < 8; ++bit) crc = crc >> 1 ^ ((crc & 1) != 0 ? 0xedb88320u : 0);
  }
  return ~crc;
}

/// The same with the checksums that its blocks should have, so that the entries are read.
string with_checksums(string bytes) {
  constexpr size_t header = 32, block_head = 24, tail = 216;
  const auto number = [&](size_t at) {
    uint32_t value;
    std::memcpy(&value, bytes.data() + at, sizeof value);
    return value;
  };

  for (size_t at = header; at + block_head + tail <= bytes.size();) {
    const size_t size = block_head + number(at + 8);
    if (at + size + tail > bytes.size()) break;
    std::memset(bytes.data() + at + 12, 0, 4);
    const uint32_t crc = crc_of(string_view(bytes).substr(at, size));
    std::memcpy(bytes.data() + at + 12, &crc, sizeof crc);
    at += size;
  }
  return bytes;
}

string manifest(const Output& output) {
  Scene scene = small_scene();
  scene.output = output;
  RunFacts facts;
  facts.measures = {{"balls.red.speed_m_per_s", 1.5}, {"balls.red.kinetic_J", std::nan("")}};
  facts.left_out = {{flights_name, "it would be too large"}};
  const string hash(64, 'a');
  return manifest_text(scene, Summary{}, facts,
                       {{"scene.yaml", 11, hash}, {"summary.csv", 200, hash}, {"frames/frame_00000.png", 3, hash}});
}

}  // namespace

void read_mesh_reply_bytes(string_view bytes) {
  MeshLimits limits;
  limits.vertices = limits.triangles = 10'000;
  limits.texture_bytes = 100'000;

  string_view left = bytes;
  const auto receive = [&](void* to, size_t size) {
    if (size > left.size()) return false;
    if (size > 0) std::memcpy(to, left.data(), size);
    left.remove_prefix(size);
    return true;
  };

  try {
    hold(receive_mesh({receive, [] { return string("it is cut off"); }}, limits));
  } catch (const runtime_error& error) {
    const string text = error.what();
    if (text.empty() || !all_of(text, [](char c) { return c >= ' ' && c <= '~'; }))
      throw Finding("trouble with a mesh is told in bytes that are no text");
  }
}

vector<string> mesh_reply_seeds() {
  string mesh, painted, trouble;
  put<uint32_t>(mesh, {3, 1, 0, 0, 0});
  put<float>(mesh, {0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 1, 0, 0, 1});
  put<uint32_t>(mesh, {0, 1, 2});
  put<uint32_t>(painted, {3, 1, 0, 1, 1});
  painted += mesh.substr(sizeof(MeshReplyHead));
  put<MeshPart>(painted, {{1, 1, {Wrap::mirror, Wrap::clamp}, 1, 1, 0.5F, {1, 0.5F, 0, 1}}});
  put<float>(painted, {0, 0, 1, 0, 0, 1, 1, 1, 1, 0, 0, 0, 0.5F, 0.5F, 0.5F});
  put<uint32_t>(painted, {1, 2});
  painted += string(8, '\x7f');
  put<uint32_t>(trouble, {0, 0, 13, 0, 0});
  return {mesh, painted, trouble + "it is damaged"};
}

/// The first byte chooses the ending.
void read_mesh_bytes(string_view bytes) {
  static constexpr const char* names[] = {"a.obj", "a.stl", "a.glb", "a.gltf"};
  const string name = bytes.empty() ? names[0] : names[static_cast<unsigned char>(bytes[0]) % 4];
  folder().put(name, bytes.substr(std::min<size_t>(bytes.size(), 1)));

  MeshLimits limits;
  limits.seconds = 3;
  limits.vertices = limits.triangles = 10'000;

  try {
    const Mesh mesh = read_painted_mesh(folder().path() + "/" + name, limits);
    hold(mesh);
    for (const Vec3& n : mesh.normals)
      if (n != Vec3::Zero() && !(std::abs(n.norm() - 1) < 1e-5)) throw Finding("a normal is not a unit vector");
  } catch (const runtime_error& error) {
    if (string_view(error.what()).find(folder().path()) == string_view::npos)
      throw Finding("trouble with a mesh without its path: " + string(error.what()));
  }
}

vector<string> mesh_seeds() {
  vector<string> seeds;
  const string data = SOURCE_DIR "/tests/data/meshes";
  for (const auto& [ending, first] : {pair{".obj", '\0'}, pair{".stl", '\1'}, pair{".glb", '\2'}, pair{".gltf", '\3'}})
    for (const string& path : files_below(data, ending))
      if (const string bytes = bytes_of(path); bytes.size() < 20'000) seeds.push_back(first + bytes);

  seeds.push_back(string(1, '\0') +
                  "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\nvn 0 0 1\nf 1//1 2//1 3//1\nf 1 2 4\nf 1 2 3 4\n");
  seeds.push_back(string(1, '\0') + "v 0 0 0 1 0 0\nv 1 0 0 0 1 0\nv 0 1 0 0 0 1\nf 1 2 3\n");
  seeds.push_back(string(1, '\1') +
                  "solid a\nfacet normal 0 0 1\nouter loop\nvertex 0 0 0\nvertex 1 0 0\nvertex 0 1 "
                  "0\nendloop\nendfacet\nendsolid a\n");
  return seeds;
}

void hold_flights(FlightsReader& reader, const Scene& scene) {
  double last = 0;
  for (Recorded recorded; reader.next(recorded);) {
    if (recorded.kind == Recorded::Kind::collision) continue;

    const PathPiece& piece = recorded.piece;
    if (piece.body >= scene.world.body_count()) throw Finding("a path of no body");
    if (piece.part_of != no_entity && piece.part_of >= scene.world.body_count()) throw Finding("part of no body");
    if (!(piece.from >= last)) throw Finding("paths that go back in time");

    if (!piece.x.allFinite() || !piece.v.allFinite() || !piece.a.allFinite() || !piece.kick.allFinite() ||
        !isfinite(piece.start.hi + piece.start.lo) || !isfinite(piece.until.hi + piece.until.lo))
      throw Finding("a path that is not finite");
    if (piece.curve)
      for (const Vec3& term : piece.curve->displacement)
        if (!term.allFinite() || !(piece.curve->length > 0)) throw Finding("a curve that is not finite");
    if (piece.joint && !(piece.mass > 0 && piece.radius > 0 && piece.half.allFinite() && isfinite(piece.mass) &&
                         isfinite(piece.radius)))
      throw Finding("a joint body without mass or size");

    last = piece.from;
  }
}

void read_flights_bytes(string_view bytes) {
  static const Scene scene = small_scene();
  folder().put(flights_name, with_checksums(string(bytes)));
  try {
    FlightsReader reader(folder().descriptor(), folder().path(), scene);
    hold_flights(reader, scene);
  } catch (const ExportError& error) {
    if (string_view(error.what()).find(flights_name) == string_view::npos)
      throw Finding("a refusal that does not name the file: " + string(error.what()));
  }
}

vector<string> flights_seeds() {
  return {flights(), flights_with_key()};
}

void read_manifest_bytes(string_view bytes) {
  folder().put(manifest_name, bytes);
  const optional<Manifest> manifest = read_manifest(folder().descriptor(), manifest_name);
  if (!manifest) return;
  for (const FileRecord& file : manifest->files) {
    if (!is_run_file(file.name) || file.name.starts_with('/') || file.name.starts_with("../"))
      throw Finding("a file that no run writes: " + file.name);
    if (file.sha256.size() != 64) throw Finding("a hash of another length");
  }
}

vector<string> manifest_seeds() {
  Output some;
  some.collisions = true;
  return {manifest(Output{}), manifest(some),
          R"({"tool": "carom", "version": "0.1.0", "outputs": {}, "files": [], "failed": ["r0001"], "meshes": []})"};
}

/// The lines from the end are the rows from the start, where nothing is in quotes.
void read_table_bytes(string_view bytes) {
  const MemoryFile file(bytes);

  StoredTable table(file.open());
  vector<string> rows;
  while (const vector<string_view>* cells = table.next()) {
    for (const string_view cell : *cells)
      if (const auto number = number_in(cell); number && !isfinite(*number)) throw Finding("a number without end");
    rows.push_back(joined(*cells, ","));
    if (rows.size() > bytes.size()) throw Finding("more rows than bytes");
  }

  if (bytes.find('"') != string_view::npos) return;
  // Empty lines at the end, and between rows, are no lines from the end.
  std::erase(rows, "");

  vector<string_view> cells;
  string changed;
  lines_from_end(file.open().get(), [&](string_view line) {
    split_cells(line, table.separator(), cells, changed);
    if (rows.empty() || rows.back() != joined(cells, ",")) throw Finding("another line from the end: " + string(line));
    rows.pop_back();
    return true;
  });
  if (!rows.empty() && !bytes.substr(0, bytes.find('\n')).empty())
    throw Finding("lines from the end stop before the first row");
}

namespace {

string gzip(string_view text) {
  GzipMembers members;
  string out;
  const auto take = [&](string_view bytes) { out += bytes; };
  members.add(text, take);
  members.end(take);
  return out;
}

string unpacked(string_view packed) {
  const MemoryFile from(packed);
  const Descriptor to(memfd_create("table", MFD_CLOEXEC));
  unpack_gzip(from.open().get(), to.get(), {-1, "run"}, "energy.csv.gz");
  return bytes_of("/proc/self/fd/" + to_string(to.get()));
}

}  // namespace

/// What is unpacked is packed again, and then unpacked to the same.
void read_gzip_bytes(string_view bytes) {
  string text;
  try {
    text = unpacked(bytes);
  } catch (const ExportError& error) {
    if (string(error.what()).find("run/energy.csv.gz") == string::npos)
      throw Finding("a refusal that does not name the file: " + string(error.what()));
    return;
  }
  if (unpacked(gzip(text)) != text) throw Finding("another text when packed again");
}

vector<string> gzip_seeds() {
  string many = "time_s,body,x_m\n";
  for (int k = 0; k < 300; ++k) many += to_string(k) + ",red,1e-3\n";
  return {gzip(many), gzip("a,b\n"), gzip("a\n") + gzip("1\n")};
}

vector<string> table_seeds() {
  string many = "time_s,body,x_m\n";
  for (int k = 0; k < 300; ++k) many += to_string(k) + ",red,1e-3\n";
  return {"time_s,body,x_m\n0,red,1.5\n0.01,\"a, \"\"b\"\"\",-2\n",
          "a,b\n1,2\n3,4",
          "time_s;body;x_m\n0,5;red;1,5e-7\n1;;\n",
          "a\tb\n1,5\t\n",
          "a\n\n\n",
          "\"a\nb\",c\n1,2\r\n",
          many};
}

}  // namespace carom::fuzz
