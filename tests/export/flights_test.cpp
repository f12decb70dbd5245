// flights.bin: written files are read back, and anything else is refused.
#include "export/flights_file.h"

#include <fcntl.h>

#include <cmath>
#include <limits>

#include "export/export_testing.h"
#include "files/open_folder.h"
#include "scene/scene.h"

namespace carom {
namespace {

using namespace testing_export;

/// A piece of each kind.
std::vector<PathPiece> pieces() {
  std::vector<PathPiece> all;
  for (Entity i = 0; i < 4; ++i) all.push_back({i, 0, {0, 0}, Vec3(i, 1, -0.0), Vec3(1, -0.0, 0), Vec3(0, -10, 0)});
  all.push_back({1, std::nextafter(0.1, 1), {0.1, 1e-18}, Vec3(1, 2, 3), Vec3(4, 5, 6), Vec3(0, -0.0, 0)});
  all.push_back({2, 0.125, {0.0625, 0}, Vec3(1, 2, 3), Vec3(4, 5, 6), Vec3(0, -10, 0)});
  PathPiece step{3, 0.15, {0.15, -1e-18}, Vec3(7, 8, 9), Vec3(1, 1, 1), Vec3::Zero()};
  step.kicked = true;
  step.until = {0.175, 1e-19};
  step.kick = Vec3(0, -1, 0);
  all.push_back(step);
  PathPiece curved{2, 0.17, {0.17, 0}, Vec3(7, 8, 9), Vec3(1, 1, 1), Vec3(0, -10, 0)};
  PolynomialPath curve;
  curve.length = 0.5;
  for (std::size_t k = 0; k < PolynomialPath::terms; ++k)
    curve.displacement[k] = Vec3(0.25, -0.0, -3) / static_cast<double>(k + 1);
  curved.curve = std::make_shared<PolynomialPath>(curve);
  all.push_back(curved);
  PathPiece part{0, 0.1875, {0.1875, 0}, Vec3(1, 1, 1), Vec3::Zero(), Vec3::Zero()};
  part.part_of = 1;
  PathPiece joint{1, 0.1875, {0.1875, 0}, Vec3(1, 1, 1), Vec3(3, 0, 0), Vec3(0, -10, 0)};
  joint.joint = true;
  joint.mass = 3;
  joint.radius = 0.125;
  joint.half = Vec3(0.125, 0.125, 0.125);
  all.push_back(part);
  all.push_back(joint);
  return all;
}

Tally some_tally() {
  Tally tally;
  tally.body_body = 7;
  tally.merges = 1;
  tally.tautened = 2;
  tally.last_collision = 0.1875;
  tally.fastest.speed = 12;
  tally.stepped_contact = 0.5;
  tally.taken_up = {4, 0.125, 0.375};
  tally.shared = {3, 1, 2, 0.625, 0.25, 2, 0, 3};
  return tally;
}

Descriptor open(const TempFolder& folder) {
  return open_folder(AT_FDCWD, folder.path(), true);
}

/// Writes flights.bin; returns what it left out.
std::vector<LeftOut> store(const TempFolder& folder, const Scene& scene, std::uint64_t most = largest_flights) {
  const Descriptor opened = open(folder);
  FlightsFile file({opened.get(), folder.path()}, scene, most);
  for (const PathPiece& piece : pieces()) file.record_paths({&piece, 1});
  file.end(some_tally());
  for (OutputFile* output : file.files()) output->publish();
  return file.left_out();
}

std::string refusal(const TempFolder& folder, const Scene& scene) {
  try {
    const Descriptor opened = open(folder);
    FlightsReader reader(opened.get(), "run", scene);
    for (Recorded recorded; reader.next(recorded);) {
    }
  } catch (const ExportError& error) {
    return error.what();
  }
  return "";
}

bool same_bits(double a, double b) {
  return a == b && std::signbit(a) == std::signbit(b);
}

TEST(Flights, AreReadAsTheyWereRecorded) {
  const TempFolder folder;
  const Scene scene = small_scene();
  EXPECT_TRUE(store(folder, scene).empty());
  const Descriptor opened = open(folder);
  FlightsReader reader(opened.get(), folder.path(), scene);
  Recorded recorded;
  for (const PathPiece& piece : pieces()) {
    ASSERT_TRUE(reader.next(recorded));
    EXPECT_EQ(recorded.kind, Recorded::Kind::piece);
    const PathPiece& got = recorded.piece;
    EXPECT_EQ(got.body, piece.body);
    EXPECT_EQ(got.from, piece.from);
    EXPECT_TRUE(same_bits(got.start.hi, piece.start.hi) && same_bits(got.start.lo, piece.start.lo));
    for (int k = 0; k < 3; ++k)
      EXPECT_TRUE(same_bits(got.x[k], piece.x[k]) && same_bits(got.v[k], piece.v[k]) &&
                  same_bits(got.a[k], piece.a[k]));
    EXPECT_EQ(got.kicked, piece.kicked);
    EXPECT_TRUE(got.until.hi == piece.until.hi && got.until.lo == piece.until.lo && got.kick == piece.kick);
    ASSERT_EQ(got.curve != nullptr, piece.curve != nullptr);
    if (piece.curve) {
      EXPECT_EQ(got.curve->length, piece.curve->length);
      EXPECT_TRUE(std::ranges::equal(got.curve->displacement, piece.curve->displacement));
    }
    EXPECT_EQ(got.part_of, piece.part_of);
    EXPECT_EQ(got.joint, piece.joint);
    EXPECT_TRUE(got.mass == piece.mass && got.radius == piece.radius && got.half == piece.half);
  }
  EXPECT_FALSE(reader.next(recorded));
  EXPECT_EQ(reader.tally().body_body, 7u);
  EXPECT_EQ(reader.tally().merges, 1u);
  EXPECT_EQ(reader.tally().tautened, 2u);
  EXPECT_TRUE(std::isnan(reader.tally().first_collision));
  EXPECT_EQ(reader.tally().last_collision, 0.1875);
  EXPECT_EQ(reader.tally().fastest.speed, 12);
  EXPECT_EQ(reader.tally().stepped_contact, 0.5);
  EXPECT_EQ(reader.tally().taken_up.impacts, 4u);
  EXPECT_EQ(reader.tally().taken_up.fastest, 0.125);
  EXPECT_EQ(reader.tally().taken_up.energy, 0.375);
  const SharedImpacts& shared = reader.tally().shared;
  const SharedImpacts stored = some_tally().shared;
  EXPECT_TRUE(shared.instants == stored.instants && shared.ties == stored.ties && shared.first == stored.first);
  EXPECT_TRUE(shared.without_room == stored.without_room && shared.absorbed == stored.absorbed);
  EXPECT_TRUE(shared.body == stored.body && shared.one == stored.one && shared.other == stored.other);
}

TEST(Flights, TakeSeventyTwoBytesAndMoreOnlyForWhatIsNew) {
  const TempFolder folder;
  store(folder, small_scene());
  const std::uintmax_t ends = 32 + 208, first = 4 * 96, bounce = 96, late = 80, step = 136, curve = 72 + 8 + 8 * 24,
                       part = 104, joint = 136;
  EXPECT_EQ(fs::file_size(folder / "flights.bin"), ends + first + bounce + late + step + curve + part + joint);
}

TEST(Flights, CutOffAnywhereAreRefused) {
  const TempFolder folder;
  const Scene scene = small_scene();
  store(folder, scene);
  const std::string whole = read(folder / "flights.bin");
  for (std::size_t size = 0; size < whole.size(); size += size < 64 ? 1 : 13) {
    write(folder / "flights.bin", whole.substr(0, size));
    EXPECT_EQ(refusal(folder, scene), "cannot use run/flights.bin: it is truncated") << size;
  }
}

TEST(Flights, OfAnotherSceneOrVersionAreRefused) {
  const TempFolder folder;
  Scene scene = small_scene();
  store(folder, scene);
  const std::string whole = read(folder / "flights.bin");
  EXPECT_EQ(refusal(folder, scene), "");
  scene.simulate.duration = 3;
  EXPECT_EQ(refusal(folder, scene), "cannot use run/flights.bin: it belongs to another scene");
  scene = small_scene();
  const auto with = [&](std::size_t at, char byte) {
    std::string other = whole;
    other[at] = byte;
    write(folder / "flights.bin", other);
    return refusal(folder, scene);
  };
  EXPECT_EQ(with(0, 'C'), "cannot use run/flights.bin: it is not a file of flights");
  EXPECT_EQ(with(8, 1), "cannot use run/flights.bin: another version of carom wrote it");
  EXPECT_EQ(with(35, 1), "cannot use run/flights.bin: it is damaged");   // a missing body
  EXPECT_EQ(with(37, 1), "cannot use run/flights.bin: it is damaged");   // an entry of an unknown kind
  EXPECT_EQ(with(47, 64), "cannot use run/flights.bin: it is damaged");  // times that go back
  fs::remove(folder / "flights.bin");
  EXPECT_EQ(refusal(folder, scene), "cannot use run/flights.bin: it cannot be opened, or is not a file");
}

TEST(Flights, WithNumbersThatAreNotFiniteAreRefused) {
  const TempFolder folder;
  const Scene scene = small_scene();
  store(folder, scene);
  const std::string whole = read(folder / "flights.bin");
  // Of the first entry: start, its lower part, x, vy, az; of a curve: length, a term; of the last
  // one, of a joint body: mass, radius, half.
  const std::size_t first = 32 + 8, end = whole.size() - 208, curve = end - 136 - 104 - 200;
  for (const std::size_t at :
       {first, first + 8, first + 16, first + 48, first + 80, curve, curve + 56, end - 40, end - 32, end - 8}) {
    std::string damaged = whole;
    damaged.replace(at, 8, std::string("\0\0\0\0\0\0\xF0\x7F", 8));  // infinity
    write(folder / "flights.bin", damaged);
    EXPECT_EQ(refusal(folder, scene), "cannot use run/flights.bin: it is damaged") << at;
  }
}

TEST(Flights, ThatGrowTooLargeAreLeftOut) {
  const TempFolder folder;
  const std::vector<LeftOut> left_out = store(folder, small_scene(), 500);
  ASSERT_EQ(left_out.size(), 1u);
  EXPECT_EQ(left_out[0].name, "flights.bin");
  EXPECT_EQ(left_out[0].why, "larger than 5e-07 GB");
  EXPECT_TRUE(names_in(folder.path()).empty());
}

TEST(Flights, ThatWereLeftOutDoNotMakeARunIncomplete) {
  const TempFolder folder;
  Scene scene = small_scene();
  scene.output.flights = true;
  {
    Exports exports(scene, folder / "run");
    play(scene, exports);
    RunFacts facts;
    exports.tables().end({});
    facts.left_out = {{"flights.bin", "larger than 1 GB"}};
    exports.finish(some_summary(scene), facts);
  }
  fs::remove(folder / "run/flights.bin");
  std::string manifest = read(folder / "run/manifest.json");
  EXPECT_NE(manifest.find("\"left_out\": {\n    \"flights.bin\": \"larger than 1 GB\"\n  }"), std::string::npos);
  const std::size_t entry = manifest.find("    {\n      \"name\": \"flights.bin\"");
  manifest.erase(manifest.rfind(',', entry), manifest.find('}', entry) + 1 - manifest.rfind(',', entry));
  write(folder / "run/manifest.json", manifest);
  EXPECT_EQ(inspect_folder(folder / "run", scene), FolderContent::this_run);
}

}  // namespace
}  // namespace carom
