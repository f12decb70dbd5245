// The sound of a film: where clicks begin, how loud and how high they are, and that the film has them there.
#include <fcntl.h>
#include <gtest/gtest.h>

#include <cstring>
#include <random>

#include "export/export_testing.h"
#include "export/film.h"
#include "physics/world.h"
#include "scene/scene.h"
#include "std.h"

namespace carom {
namespace {

using namespace testing_export;

constexpr double rate = SoundTrack::rate;

World world_of(vector<double> radii) {
  World world;
  world.radius = std::move(radii);
  world.mass.assign(world.radius.size(), 1);
  return world;
}

Collision collision(double time, double impulse, Entity a = 0, Entity b = 100,
                    CollisionKind kind = CollisionKind::body_fixed) {
  Collision collision{};
  collision.time = time;
  collision.kind = kind;
  collision.a = a;
  collision.b = b;
  collision.impulse = impulse;
  return collision;
}

struct Sound {
  vector<float> samples;
  double gain = 0;
  size_t largest_part = 0;
};

Sound sound_of(const vector<Collision>& collisions, double length, const World& world = world_of({0.1}),
               const FilmClock& clock = {}, double lead = 0) {
  Sound sound;
  SoundTrack track(world, clock, lead, length, [&sound](span<const float> part) {
    sound.samples.insert(sound.samples.end(), part.begin(), part.end());
    sound.largest_part = max(sound.largest_part, part.size());
  });
  track.record(collisions);
  track.finish(length);
  sound.gain = track.gain();
  return sound;
}

int64_t first_sound(const vector<float>& samples) {
  return ranges::find_if(samples, [](float x) { return x != 0; }) - samples.begin();
}

double loudest(const vector<float>& samples) {
  double most = 0;
  for (const float x : samples) most = max(most, double(std::abs(x)));
  return most;
}

/// Hz, by the changes of sign in the first 20 ms from a sample.
double frequency(const vector<float>& samples, int64_t from) {
  int changes = 0;
  int64_t first = 0, last = 0;
  for (int64_t i = from + 1; i < from + int64_t(0.02 * rate); ++i) {
    if ((samples[size_t(i)] > 0) == (samples[size_t(i - 1)] > 0)) continue;
    if (changes++ == 0) first = i;
    last = i;
  }
  return 0.5 * (changes - 1) * rate / double(last - first);
}

TEST(SoundTrack, BeginsAtTheFirstSampleThatIsNotBeforeTheCollision) {
  std::mt19937 draws(7);
  for (int i = 0; i < 200; ++i) {
    const double time = 1e-7 * double(draws() % 10'000'000);
    EXPECT_EQ(first_sound(sound_of({collision(time, 2)}, 1.1).samples), int64_t(ceil(time * rate - 1e-6))) << time;
  }
  EXPECT_EQ(first_sound(sound_of({collision(0, 2)}, 1).samples), 0);
  EXPECT_EQ(first_sound(sound_of({collision(0.07, 2)}, 1).samples), 3360);  // 0.07 * 48000 is 3360 + 1 ulp
}

TEST(SoundTrack, FollowsTheClockOfTheFilm) {
  const FilmClock clock(0.5, 1, Slowdown{2, 3});
  for (const double time : {1.2, 1.9, 2.0, 2.05, 3.5}) {
    const Sound sound = sound_of({collision(time, 2)}, 10, world_of({0.1}), clock);
    EXPECT_EQ(first_sound(sound.samples), int64_t(ceil(clock.film(time) * rate - 1e-6))) << time;
  }
  EXPECT_EQ(loudest(sound_of({collision(0.99, 2)}, 10, world_of({0.1}), clock).samples), 0);  // before the film
  // A title card of 2 s comes first.
  EXPECT_EQ(first_sound(sound_of({collision(0.5, 2)}, 10, world_of({0.1}), {}, 2).samples), 120000);
}

TEST(SoundTrack, HasTheRootOfTheImpulse) {
  const double one = loudest(sound_of({collision(0.5, 1)}, 1).samples);
  EXPECT_NEAR(loudest(sound_of({collision(0.5, 10'000)}, 1).samples), 100 * one, 1e-5);
  EXPECT_NEAR(loudest(sound_of({collision(0.5, 1, 0, 100, CollisionKind::taut)}, 1).samples), one / 2, 1e-7);
  EXPECT_EQ(loudest(sound_of({collision(0.5, 1, 0, 100, CollisionKind::rest)}, 1).samples), 0);
}

TEST(SoundTrack, IsAsHighAsTheBodyIsSmall) {
  // 0.1 m is the geometric mean of the sizes. Each lasts 20 periods and more.
  const World world = world_of({0.05, 0.1, 0.2});
  EXPECT_NEAR(frequency(sound_of({collision(0.5, 1, 0)}, 1, world).samples, 24000), 2000, 10);
  EXPECT_NEAR(frequency(sound_of({collision(0.5, 1, 1)}, 1, world).samples, 24000), 1000, 5);
  EXPECT_NEAR(frequency(sound_of({collision(0.5, 1, 2)}, 1, world).samples, 24000), 500, 3);
  EXPECT_NEAR(frequency(sound_of({collision(0.5, 1, 0)}, 1, world_of({1e-9, 1e9})).samples, 24000), 10'079, 200);
}

TEST(SoundTrack, OfSeveralCollisionsIsTheirSum) {
  const World world = world_of({0.05, 0.2});
  const Sound a = sound_of({collision(0.5, 3, 0)}, 1, world), b = sound_of({collision(0.501, 5, 1)}, 1, world);
  const Sound both = sound_of({collision(0.5, 3, 0), collision(0.501, 5, 1)}, 1, world);
  for (size_t i = 0; i < both.samples.size(); ++i) ASSERT_NEAR(both.samples[i], a.samples[i] + b.samples[i], 1e-6);

  // Two bodies that meet have half of a click each.
  const Sound pair = sound_of({collision(0.5, 4, 0, 1, CollisionKind::body_body)}, 1, world);
  const Sound one = sound_of({collision(0.5, 1, 0)}, 1, world), other = sound_of({collision(0.5, 1, 1)}, 1, world);
  for (size_t i = 0; i < pair.samples.size(); ++i)
    ASSERT_NEAR(pair.samples[i], one.samples[i] + other.samples[i], 1e-6);
}

TEST(SoundTrack, OfManyCollisionsIsNotClippedAndComesInParts) {
  std::mt19937 draws(7);
  vector<double> radii;
  for (int i = 0; i < 100; ++i) radii.push_back(0.01 + 1e-4 * double(draws() % 1000));
  vector<Collision> collisions;
  for (int i = 0; i < 200'000; ++i)
    collisions.push_back(collision(1e-5 * i, 1e-6 * double(draws() % 1'000'000), draws() % 100));

  const Sound sound = sound_of(collisions, 2.5, world_of(radii));
  EXPECT_EQ(sound.samples.size(), size_t(2.5 * rate));
  EXPECT_NEAR(sound.gain * loudest(sound.samples), SoundTrack::loudest, 1e-6);
  EXPECT_LE(sound.largest_part, 4096u);
  EXPECT_EQ(sound.samples.back(), 0);  // it has faded
}

TEST(SoundTrack, WithoutCollisionsIsSilence) {
  const Sound sound = sound_of({}, 0.5);
  EXPECT_EQ(sound.samples, vector<float>(24000, 0));
  EXPECT_EQ(sound.gain, 1);
}

// The film has what the track makes, where it makes it.

string stored_film(const TempFolder& temp, const vector<Collision>& collisions, int pictures) {
  const Descriptor folder(open(temp.path().c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC));
  VideoOutput video;
  video.size = {64, 36};
  video.sound = true;
  Film film({folder.get(), temp.path()}, video, find_film_tools());
  film.open_sound(world_of({0.1}), {}, 0, pictures / video.fps);
  for (int i = 0; i < pictures; ++i) film.add(picture(video.size, i));
  film.record(collisions);
  film.complete();
  film.file().publish();
  EXPECT_EQ(names_in(temp.path()), vector<string>{"animation.mp4"});
  return temp / "animation.mp4";
}

string output_of(const string& program, const vector<string>& words) {
  const Descriptor folder(open("/", O_RDONLY | O_DIRECTORY | O_CLOEXEC));
  vector<string> arguments = {program};
  arguments.insert(arguments.end(), words.begin(), words.end());
  Child child(arguments, folder.get(), false);
  EXPECT_EQ(child.wait(std::chrono::seconds(60)), 0) << child.errors();
  return child.output();
}

vector<float> decoded(const string& film) {
  const string bytes = output_of(find_film_tools().ffmpeg, {"-nostdin", "-v", "error", "-i", "file:" + film, "-map",
                                                            "0:a", "-f", "f32le", "pipe:1"});
  vector<float> samples(bytes.size() / sizeof(float));
  std::memcpy(samples.data(), bytes.data(), samples.size() * sizeof(float));
  return samples;
}

TEST(Film, HasItsSoundInStep) {
  const TempFolder temp;
  const vector<Collision> collisions = {collision(0.25, 1), collision(0.61803, 9), collision(1.41421, 4)};
  const string film = stored_film(temp, collisions, 60);
  const string& ffprobe = find_film_tools().ffprobe;
  EXPECT_EQ(output_of(ffprobe, {"-v", "error", "-count_packets", "-show_entries",
                                "stream=codec_name,start_time,sample_rate,channels", "-of", "csv=p=0", "file:" + film}),
            "h264,0.000000\naac,48000,1,0.000000\n");
  EXPECT_EQ(output_of(ffprobe, {"-v", "error", "-select_streams", "v:0", "-count_frames", "-show_entries",
                                "stream=nb_read_frames,duration", "-of", "csv=p=0", "file:" + film}),
            "2.000000,60\n");

  // The two agree best without a shift.
  const vector<float> heard = decoded(film);
  const Sound made = sound_of(collisions, 2);
  ASSERT_GE(heard.size(), made.samples.size());

  int best = 1000;
  double most = 0;
  for (int lag = -48; lag <= 48; ++lag) {
    double sum = 0;
    for (int64_t i = 48; i + 48 < int64_t(made.samples.size()); ++i)
      sum += double(made.samples[size_t(i)]) * heard[size_t(i + lag)];
    if (sum > most) best = lag;
    most = max(most, sum);
  }
  EXPECT_EQ(best, 0);
  for (const float x : heard) ASSERT_LT(std::abs(x), 1);
  EXPECT_NEAR(loudest(heard), SoundTrack::loudest, 0.05);  // measured: 0.0007
}

TEST(Film, OfAQuietMotionHasASilentTrack) {
  const TempFolder temp;
  EXPECT_EQ(loudest(decoded(stored_film(temp, {}, 10))), 0);
}

TEST(Film, WithSoundHasTheSameBytesAgain) {
  const TempFolder one, two;
  const vector<Collision> collisions = {collision(0.1, 1), collision(0.2, 3)};
  EXPECT_TRUE(read(stored_film(one, collisions, 20)) == read(stored_film(two, collisions, 20)));
}

}  // namespace
}  // namespace carom
