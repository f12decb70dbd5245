// flights.bin: written files are read back, and anything else is refused.
#include "export/flights_file.h"

#include <fcntl.h>

#include "export/export_testing.h"
#include "export/same_piece.h"
#include "files/folder_writer.h"
#include "files/hash.h"
#include "files/run_folder.h"
#include "processor.h"
#include "scene/scene.h"
#include "std.h"

namespace carom {
namespace {

using namespace testing_export;

/// A piece of each kind.
vector<PathPiece> pieces() {
  vector<PathPiece> all;
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

  for (size_t k = 0; k < PolynomialPath::terms; ++k)
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

  PathPiece fading{2, 0.1875, {0.1875, 0}, Vec3(1, 1, 1), Vec3(3, 0, 0), Vec3(0, -10, 0)};
  fading.fade = 0.25;
  PathPiece verlet = curved;
  verlet.from = verlet.start.hi = 0.19;
  verlet.law = PathLaw::verlet;
  curve = PolynomialPath::parabola(0.25, verlet.v, verlet.a);
  curve.ahead = Vec3(0, -0.0, 1e-9);
  verlet.curve = std::make_shared<PolynomialPath>(curve);
  PathPiece closed{3, 0.19, {0.19, 0}, Vec3(1, -1, 1), Vec3(3, 1e-300, 0), Vec3(0, -10, 0)};
  closed.law = PathLaw::closed;
  PathPiece frame{3, 0.19, {0.2, 0}, Vec3(1, -1, 1), Vec3(-3, 0, 0), Vec3(0, 0, 0)};
  frame.law = PathLaw::frame;
  frame.rounding = 0x1p-40;

  PathPiece removed{1, 0.195, {0.195, 0}, Vec3(1, -1, 1), Vec3(-3, 0, 0), Vec3(0, 0, 0)};
  removed.removed = true;
  for (const PathPiece& piece : {fading, verlet, closed, frame, removed}) all.push_back(piece);
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
vector<LeftOut> store(const TempFolder& folder, const Scene& scene, const vector<PathPiece>& recorded,
                      uint64_t most = largest_flights) {
  const Descriptor opened = open(folder);
  FlightsFile file({opened.get(), folder.path()}, scene, most);
  file.record_paths(recorded);
  file.end(some_tally());
  for (OutputFile* output : file.files()) output->publish();
  return file.left_out();
}

vector<LeftOut> store(const TempFolder& folder, const Scene& scene, uint64_t most = largest_flights) {
  return store(folder, scene, pieces(), most);
}

string refusal(const TempFolder& folder, const Scene& scene) {
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
    EXPECT_TRUE(same_bits(recorded.piece, piece)) << "body " << piece.body << " from " << piece.from;
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

/// A crowd's steps of 1/1024 s, in which gravity changes drifts, and the impact of each ball with its neighbour.
vector<PathPiece> falling_crowd(int steps) {
  vector<PathPiece> all;
  const double length = 0x1p-10;
  Vec3 x[4];

  for (int k = 0; k < steps; ++k)
    for (Entity i = 0; i < 4; ++i) {
      const Vec3 before(i, k == 0 ? 0 : -10 * (k - 0.5) * length, 0), drift(i, -10 * (k + 0.5) * length, 0);
      x[i] = k == 0 ? Vec3(i, 1, 0) : Vec3(x[i] + length * before);
      PathPiece piece{i, k * length, {k * length, 0}, x[i], drift, Vec3::Zero()};
      piece.kicked = true;
      piece.until = {(k + 0.5) * length, 0};
      piece.kick = (drift - before) / (k == 0 ? 0.5 * length : length);
      all.push_back(piece);
    }

  return all;
}

TEST(Flights, TakeHardlyAByteForAStepThatFollowsFromTheStepBefore) {
  const TempFolder folder;
  const int steps = 2'000;
  store(folder, small_scene(), falling_crowd(steps));
  EXPECT_LT(fs::file_size(folder / "flights.bin"), steps * 4 * 0.5);  // 0.17 measured
}

/// Two balls that approach, part at an impact, and approach again from walls.
TEST(Flights, TakeFewBytesForAnImpactOfTwo) {
  vector<PathPiece> all = {pieces()[0], pieces()[1]};
  for (PathPiece& piece : all) piece.a = Vec3::Zero();
  double time = 0;
  const int impacts = 1'000;
  const Vec3 n = Vec3(1, 2, 2) / 3;

  for (int k = 0; k < impacts; ++k) {
    const double dt = 0x1p-20 * (1 + k % 7);
    for (Entity i = 0; i < 2; ++i) {
      const double side = i == 0 ? -1 : 1;
      all.push_back({i, time, {time, 0}, (0.1 + dt) * side * n, -side * n, Vec3::Zero()});
    }
    time += dt;

    for (Entity i = 0; i < 2; ++i) {
      PathPiece piece = all[all.size() - 2];
      piece.from = piece.start.hi = time;
      piece.x += dt * piece.v;
      piece.v = -piece.v;
      all.push_back(piece);
    }
  }

  const TempFolder folder;
  Scene scene = small_scene();
  scene.world.mass[0] = 1;
  store(folder, scene, all);
  EXPECT_LT(fs::file_size(folder / "flights.bin"), impacts * 50u);
}

TEST(Flights, HaveTheSameBytesOnEveryProcessorWithSse42) {
  if (!packs_by_sse42()) GTEST_SKIP() << "another processor";
  const TempFolder folder;
  store(folder, small_scene());
  EXPECT_EQ(sha256(read(folder / "flights.bin")), "caf0a3d7599fea29801488d22cc01ba4d26cce8451646cdeae2cffe039f47dca");
  store(folder, small_scene(), falling_crowd(2'000));
  EXPECT_EQ(sha256(read(folder / "flights.bin")), "4df42b775b93dba51c7789e33144a3b6abdb12cdf95fd11ae8a9899e031af400");
}

/// What an advance gives: collisions, each with the pieces that begin with it.
struct Event {
  optional<Collision> collision;
  vector<PathPiece> pieces;
};

Collision collision_at(double time, CollisionKind kind, Entity a, Entity b) {
  Collision collision{};
  collision.time = time;
  collision.kind = kind;
  collision.a = a;
  collision.b = b;
  return collision;
}

/// The file of two advances, the second one from this event on, or from its pieces on.
string recorded_in_two(const vector<Event>& events, size_t first, bool cuts_an_event) {
  const TempFolder folder;
  Scene scene = small_scene();
  scene.overlay.flash = true;
  const Descriptor opened = open(folder);
  FlightsFile file({opened.get(), folder.path()}, scene);
  vector<Collision> collisions;
  vector<PathPiece> pieces;

  const auto advance = [&] {
    file.record(collisions);
    file.record_paths(pieces);
    collisions.clear();
    pieces.clear();
  };

  for (size_t k = 0; k < events.size(); ++k) {
    if (k == first && !cuts_an_event) advance();
    if (events[k].collision) collisions.push_back(*events[k].collision);
    if (k == first && cuts_an_event) advance();
    pieces.insert(pieces.end(), events[k].pieces.begin(), events[k].pieces.end());
  }

  advance();
  file.end(some_tally());
  for (OutputFile* output : file.files()) output->publish();
  return read(folder / "flights.bin");
}

TEST(Flights, HaveTheSameBytesWhereverAnAdvanceEnds) {
  vector<Event> events = {{{}, {}}};
  for (Entity i = 0; i < 4; ++i) events[0].pieces.push_back(pieces()[i]);
  const auto event = [&](double hi, double lo, Entity a, Entity b) {
    Event& added = events.emplace_back();
    added.collision = collision_at(hi, CollisionKind::body_body, a, b);
    for (const Entity body : {a, b})
      added.pieces.push_back(
          {body, lo > 0 ? std::nextafter(hi, 9) : hi, {hi, lo}, Vec3(body, 1, 0), Vec3(hi, 0, 0), Vec3(0, -10, 0)});
  };

  // Two events of one instant, three between two doubles, and one that no piece follows.
  event(0.25, 0, 0, 1);
  event(0.25, 0, 2, 3);
  event(0.5, 1e-19, 0, 1);
  event(0.5, 1e-18, 2, 3);
  event(0.5, 2e-18, 1, 2);
  event(0.75, -1e-18, 3, 0);
  events.push_back({collision_at(0.875, CollisionKind::body_fixed, 1, 0), {}});

  const string bytes = recorded_in_two(events, 0, false);
  for (size_t first = 1; first < events.size(); ++first)
    for (const bool cuts : {false, true}) EXPECT_EQ(recorded_in_two(events, first, cuts), bytes) << first << cuts;
}

TEST(Flights, CutOffAnywhereAreRefused) {
  const TempFolder folder;
  const Scene scene = small_scene();
  store(folder, scene);
  const string whole = read(folder / "flights.bin");
  for (size_t size = 0; size < whole.size(); size += size < 64 ? 1 : 13) {
    write(folder / "flights.bin", whole.substr(0, size));
    EXPECT_EQ(refusal(folder, scene), "cannot use run/flights.bin: it is truncated") << size;
  }
}

TEST(Flights, OfAnotherSceneOrVersionAreRefused) {
  const TempFolder folder;
  Scene scene = small_scene();
  store(folder, scene);
  const string whole = read(folder / "flights.bin");
  EXPECT_EQ(refusal(folder, scene), "");

  scene.simulate.duration = 3;
  EXPECT_EQ(refusal(folder, scene), "cannot use run/flights.bin: it belongs to another scene");

  scene = small_scene();
  const auto with = [&](size_t at, char byte) {
    string other = whole;
    other[at] = byte;
    write(folder / "flights.bin", other);
    return refusal(folder, scene);
  };

  EXPECT_EQ(with(0, 'C'), "cannot use run/flights.bin: it is not a file of flights");
  EXPECT_EQ(with(8, 6),
            "cannot use run/flights.bin: another version of carom wrote it\n"
            "  carom run run/scene.yaml -o run --force runs it again");

  fs::remove(folder / "flights.bin");
  EXPECT_EQ(refusal(folder, scene), "cannot use run/flights.bin: it cannot be opened, or is not a file");
}

TEST(Flights, WithAChangedByteAreRefused) {
  const TempFolder folder;
  const Scene scene = small_scene();
  store(folder, scene);
  const string whole = read(folder / "flights.bin");
  for (size_t at = 32; at < whole.size() - 216; at += at < 32 + 24 ? 1 : 13) {
    string damaged = whole;
    damaged[at] = static_cast<char>(damaged[at] ^ 4);
    write(folder / "flights.bin", damaged);
    EXPECT_EQ(refusal(folder, scene), "cannot use run/flights.bin: it is damaged") << at;
  }
}

TEST(Flights, WithNumbersThatAreNotFiniteAreRefused) {
  const TempFolder folder;
  const Scene scene = small_scene();

  const auto refused_with = [&](size_t which, const function<void(PathPiece&)>& change) {
    vector<PathPiece> changed = pieces();
    change(changed[which]);
    store(folder, scene, changed);
    return refusal(folder, scene) == "cannot use run/flights.bin: it is damaged";
  };

  const size_t first = 0, step = 6, curve = 7, part = 8, joint = 9, fading = 10, frame = 13;
  EXPECT_FALSE(refused_with(first, [](PathPiece&) {}));
  EXPECT_TRUE(refused_with(first, [&](PathPiece& piece) { piece.from = infinity; }));
  EXPECT_TRUE(refused_with(first, [&](PathPiece& piece) { piece.start.hi = -infinity; }));
  EXPECT_TRUE(refused_with(first, [&](PathPiece& piece) { piece.start.lo = infinity; }));
  EXPECT_TRUE(refused_with(first, [&](PathPiece& piece) { piece.start = {1.7e308, 1.7e308}; }));
  EXPECT_TRUE(refused_with(first, [&](PathPiece& piece) { piece.x[0] = std::nan(""); }));
  EXPECT_TRUE(refused_with(first, [&](PathPiece& piece) { piece.v[1] = infinity; }));
  EXPECT_TRUE(refused_with(first, [&](PathPiece& piece) { piece.a[2] = -infinity; }));
  EXPECT_TRUE(refused_with(step, [&](PathPiece& piece) { piece.until.hi = infinity; }));
  EXPECT_TRUE(refused_with(step, [&](PathPiece& piece) { piece.kick[0] = infinity; }));
  EXPECT_TRUE(refused_with(part, [&](PathPiece& piece) { piece.part_of = piece.body; }));
  EXPECT_TRUE(refused_with(joint, [&](PathPiece& piece) { piece.mass = 0; }));

  EXPECT_TRUE(refused_with(joint, [&](PathPiece& piece) { piece.radius = infinity; }));
  EXPECT_TRUE(refused_with(joint, [&](PathPiece& piece) { piece.half[1] = -1; }));
  EXPECT_TRUE(refused_with(fading, [&](PathPiece& piece) { piece.fade = infinity; }));
  EXPECT_TRUE(refused_with(frame, [&](PathPiece& piece) { piece.rounding = infinity; }));

  const auto bend = [](PathPiece& piece, const function<void(PolynomialPath&)>& change) {
    auto other = std::make_shared<PolynomialPath>(*piece.curve);
    change(*other);
    piece.curve = other;
  };

  EXPECT_TRUE(refused_with(curve, [&](PathPiece& piece) { bend(piece, [](auto& path) { path.length = 0; }); }));
  EXPECT_TRUE(refused_with(
      curve, [&](PathPiece& piece) { bend(piece, [&](auto& path) { path.displacement[6][1] = infinity; }); }));
  EXPECT_TRUE(
      refused_with(curve, [&](PathPiece& piece) { bend(piece, [&](auto& path) { path.ahead[1] = infinity; }); }));
}

TEST(Flights, WithAnImpactOfABodyWithoutAPathAreDamaged) {
  const Scene scene = small_scene();
  PathPiece ball{0, 0, {0, 0}, Vec3(0, 0, 0), Vec3(1, 0, 0), Vec3::Zero()};
  PathPiece target{1, 0, {0, 0}, Vec3(1, 0, 0), Vec3::Zero(), Vec3::Zero()};
  ColumnWriter before;
  ColumnWriter impact;
  PathCodec writer(scene.world);
  writer.write(before, ball, nullptr, scene.world);
  writer.write(before, target, nullptr, scene.world);
  for (PathPiece* piece : {&ball, &target}) piece->from = piece->start.hi = 0.8;
  ball.x[0] = 0.8;
  ball.v[0] = 1.0 / 3;  // masses 2 and 1, restitution 1
  target.v[0] = 4.0 / 3;
  writer.write(impact, ball, &target, scene.world);

  vector<char> packed;
  impact.pack(packed);
  ColumnReader columns;
  ASSERT_TRUE(columns.unpack(packed));

  PathCodec reader(scene.world);
  Recorded recorded;
  EXPECT_FALSE(reader.read(columns, recorded));
}

TEST(Flights, ThatGoBackInTimeAreRefused) {
  const TempFolder folder;
  const Scene scene = small_scene();
  vector<PathPiece> changed = pieces();
  changed[5].from = 0.0625;
  store(folder, scene, changed);
  EXPECT_EQ(refusal(folder, scene), "cannot use run/flights.bin: it is damaged");
}

TEST(Flights, ThatGrowTooLargeAreLeftOut) {
  const TempFolder folder;
  const vector<LeftOut> left_out = store(folder, small_scene(), 900);
  ASSERT_EQ(left_out.size(), 1u);
  EXPECT_EQ(left_out[0].name, "flights.bin");
  EXPECT_EQ(left_out[0].why, "larger than 9e-07 GB");
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
  string manifest = read(folder / "run/manifest.json");
  EXPECT_NE(manifest.find("\"left_out\": {\n    \"flights.bin\": \"larger than 1 GB\"\n  }"), string::npos);

  const size_t entry = manifest.find("    {\n      \"name\": \"flights.bin\"");
  manifest.erase(manifest.rfind(',', entry), manifest.find('}', entry) + 1 - manifest.rfind(',', entry));
  write(folder / "run/manifest.json", manifest);
  EXPECT_EQ(inspect_folder(folder / "run", scene), FolderContent::this_run);
}

}  // namespace
}  // namespace carom
