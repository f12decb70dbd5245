#include "export/film.h"

#include <fcntl.h>
#include <gtest/gtest.h>
#include <sched.h>
#include <signal.h>
#include <sys/stat.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cstdlib>

#include "export/export_testing.h"
#include "export/picture_streams.h"
#include "export/webp.h"
#include "files/run_folder.h"
#include "scene/scene.h"
#include "std.h"

namespace carom {
namespace {

using namespace testing_export;
using std::chrono::milliseconds;

constexpr Size small = {64, 36};

Scene scene_with_film(const string& file = "animation.mp4") {
  Scene scene = small_scene();
  VideoOutput video;
  video.file = file;
  video.fps = 25;
  video.size = small;
  scene.output.video = video;
  return scene;
}

/// ffprobe's facts of a film's picture stream.
string probe(const string& film, const string& entries) {
  const Descriptor folder(open("/", O_RDONLY | O_DIRECTORY | O_CLOEXEC));
  Child child({find_film_tools().ffprobe, "-v", "error", "-select_streams", "v:0", "-count_frames", "-show_entries",
               "stream=" + entries, "-of", "default=noprint_wrappers=1:nokey=1", "file:" + film},
              folder.get(), false);
  EXPECT_EQ(child.wait(std::chrono::seconds(60)), 0) << child.errors();
  return child.output();
}

/// The pixels of a film's first frame, as ffmpeg decodes them.
string first_frame(const string& film) {
  const Descriptor folder(open("/", O_RDONLY | O_DIRECTORY | O_CLOEXEC));
  Child child({find_film_tools().ffmpeg, "-nostdin", "-v", "error", "-i", "file:" + film, "-frames:v", "1", "-vf",
               "scale=in_color_matrix=bt709:in_range=tv:flags=accurate_rnd+full_chroma_int", "-pix_fmt", "rgb24", "-f",
               "rawvideo", "pipe:1"},
              folder.get(), false);
  EXPECT_EQ(child.wait(std::chrono::seconds(60)), 0) << child.errors();
  return child.output();
}

TEST(Film, IsWhatEveryPlayerPlays) {
  TempFolder temp;
  Scene scene = scene_with_film();
  scene.simulate.duration = 1;
  run(scene, temp / "run");
  EXPECT_EQ(names_in(temp / "run"), (vector<string>{"animation.mp4", "manifest.json", "scene.yaml", "summary.csv"}));
  EXPECT_EQ(probe(temp / "run/animation.mp4", "codec_name,width,height,pix_fmt"), "h264\n64\n36\nyuv420p\n");
  EXPECT_EQ(probe(temp / "run/animation.mp4", "color_range,color_space,color_transfer,color_primaries"),
            "tv\nbt709\nbt709\nbt709\n");
  EXPECT_EQ(probe(temp / "run/animation.mp4", "avg_frame_rate,duration,nb_read_frames"), "25/1\n1.040000\n26\n");
  const string bytes = read(temp / "run/animation.mp4");
  EXPECT_LT(bytes.find("moov"), bytes.find("mdat"));  // the index in front, so that it plays while it loads
  EXPECT_EQ(inspect_folder(temp / "run", scene), FolderContent::this_run);
}

TEST(Film, FrameRatesAreKept) {
  TempFolder temp;
  Scene scene = scene_with_film();
  for (const auto& [fps, expected] : vector<pair<double, string>>{
           {30, "30/1\n"},
           {29.97, "2997/100\n"},

           {30000 / 1001.0, "30000/1001\n"},
       }) {
    scene.output.video->fps = fps;
    run(scene, temp / "run");
    EXPECT_EQ(probe(temp / "run/animation.mp4", "r_frame_rate"), expected) << fps;
  }
}

TEST(Film, ColoursComeBack) {
  TempFolder temp;
  const Descriptor folder(open(temp.path().c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC));
  const vector<array<int, 3>> colours = {{255, 255, 255}, {0, 0, 0},   {128, 128, 128}, {255, 0, 0},
                                         {0, 255, 0},     {0, 0, 255}, {220, 20, 60},   {65, 105, 225}};

  VideoOutput video;
  video.size = {16 * static_cast<int>(colours.size()), 16};
  video.crf = 1;
  Image image{video.size.width, video.size.height, {}};
  for (int y = 0; y < 16; ++y)
    for (const auto& colour : colours)
      for (int x = 0; x < 16; ++x)
        for (const int c : colour) image.pixels.push_back(static_cast<uint8_t>(c));

  Film film({folder.get(), temp.path()}, video, find_film_tools());
  film.add(image);
  film.complete();
  film.file().publish();

  const string pixels = first_frame(temp / "animation.mp4");
  ASSERT_EQ(pixels.size(), image.pixels.size());
  int worst = 0;
  for (size_t i = 0; i < colours.size(); ++i)
    for (size_t c = 0; c < 3; ++c) {
      const size_t at = 3 * (8 * 16 * colours.size() + 16 * i + 8) + c;
      worst = std::max(worst, std::abs(static_cast<unsigned char>(pixels[at]) - image.pixels[at]));
    }
  EXPECT_LE(worst, 3);  // measured: 1; limited range has 219 levels for 256
}

TEST(Film, OddSizesRepeatTheirLastPixel) {
  TempFolder temp;
  Scene scene = scene_with_film();
  scene.output.video->size = {65, 37};
  scene.output.video->crf = 1;
  run(scene, temp / "run");

  EXPECT_EQ(probe(temp / "run/animation.mp4", "width,height"), "66\n38\n");
  const string pixels = first_frame(temp / "run/animation.mp4");
  ASSERT_EQ(pixels.size(), 66u * 38 * 3);
  EXPECT_NEAR(static_cast<unsigned char>(pixels[3 * (66 * 20 + 65)]),
              static_cast<unsigned char>(pixels[3 * (66 * 20 + 64)]), 3);

  scene.output.video->size = {1, 1};
  run(scene, temp / "run");
  EXPECT_EQ(probe(temp / "run/animation.mp4", "width,height"), "2\n2\n");
}

TEST(Film, TheSamePicturesGiveTheSameBytesOnAnyNumberOfCores) {
  TempFolder temp;
  Scene scene = scene_with_film();
  scene.output.video->size = {320, 180};
  scene.simulate.duration = 1;
  run(scene, temp / "a");

  cpu_set_t all, one;
  ASSERT_EQ(sched_getaffinity(0, sizeof all, &all), 0);
  CPU_ZERO(&one);
  for (int cpu = 0; cpu < CPU_SETSIZE && CPU_COUNT(&one) == 0; ++cpu)
    if (CPU_ISSET(cpu, &all)) CPU_SET(cpu, &one);
  ASSERT_EQ(sched_setaffinity(0, sizeof one, &one), 0);

  run(scene, temp / "b");
  sched_setaffinity(0, sizeof all, &all);
  EXPECT_TRUE(read(temp / "a/animation.mp4") == read(temp / "b/animation.mp4"));
}

TEST(Film, FramesAndFilmOfOneKindAreDrawnOnce) {
  TempFolder temp;
  Scene scene = scene_with_film();
  scene.output.frames = FramesOutput{25, small, 4, 0, 0.2};  // until: the duration, by another way
  {
    const Exports exports(scene, temp / "run");
    EXPECT_EQ(exports.pictures().size(), 1u);
  }

  run(scene, temp / "run");
  EXPECT_EQ(probe(temp / "run/animation.mp4", "nb_read_frames"), "6\n");
  EXPECT_TRUE(fs::exists(temp / "run/frames/frame_00005.png"));

  // Of any other kind they are drawn twice.
  for (const FramesOutput& frames :
       {FramesOutput{50, small, 4, 0, {}}, FramesOutput{25, {64, 38}, 4, 0, {}}, FramesOutput{25, small, 1, 0, {}},
        FramesOutput{25, small, 4, 0.1, {}}, FramesOutput{25, small, 4, 0, 0.1}}) {
    scene.output.frames = frames;
    const Exports exports(scene, temp / "other");
    EXPECT_EQ(exports.pictures().size(), 2u);
  }
}

TEST(Film, OfSpeedAnEighthLastsEightTimesAsLong) {
  TempFolder temp;
  Scene scene = scene_with_film();
  for (const auto& [speed, frames] : vector<pair<double, int>>{{1, 6}, {0.125, 41}, {2, 3}}) {
    scene.output.video->speed = speed;
    run(scene, temp / "run");
    // From the first picture to the last: 0.2 s of motion.
    EXPECT_EQ((frames - 1) / 25.0 * speed, speed == 2 ? 0.16 : 0.2);
    EXPECT_EQ(probe(temp / "run/animation.mp4", "r_frame_rate,nb_read_frames"), "25/1\n" + to_string(frames) + "\n");
  }
}

TEST(Film, HasAWindowOfItsOwnAndBeginsThere) {
  Scene scene = scene_with_film();
  scene.output.video->from = 0.13;
  scene.output.frames = FramesOutput{25, small, 4, 0, {}};
  const PictureStreams plan = plan_pictures(scene);
  ASSERT_EQ(plan.streams.size(), 2U);
  EXPECT_EQ(plan.ticks[1].at(0), 0.13);
  EXPECT_EQ(plan.ticks[1].count(), 2);
}

TEST(Film, AGifHasEveryPictureForItsTime) {
  TempFolder temp;
  Scene scene = scene_with_film("film.gif");
  for (const auto& [fps, facts] : vector<pair<double, string>>{
           {50, "0.220000\n11\n"}, {25, "0.240000\n6\n"}, {12.5, "0.240000\n3\n"}, {100.0 / 3, "0.210000\n7\n"}}) {
    scene.output.video->fps = fps;
    run(scene, temp / "run");
    EXPECT_EQ(probe(temp / "run/film.gif", "duration,nb_read_frames"), facts) << fps;
  }
  EXPECT_EQ(probe(temp / "run/film.gif", "codec_name,width,height"), "gif\n64\n36\n");
  EXPECT_EQ(names_in(temp / "run"), (vector<string>{"film.gif", "manifest.json", "scene.yaml", "summary.csv"}));
}

TEST(Film, AGifsColoursAreThoseOfThePictures) {
  TempFolder temp;
  const Descriptor folder(open(temp.path().c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC));
  VideoOutput video;
  video.file = "film.gif";
  video.fps = 25;
  video.size = {64, 16};

  Image image{64, 16, {}};
  const array<array<int, 3>, 4> colours = {{{255, 255, 255}, {220, 20, 60}, {65, 105, 225}, {0, 0, 0}}};
  for (int i = 0; i < 64 * 16; ++i)
    for (const int c : colours[static_cast<size_t>(i % 64 / 16)]) image.pixels.push_back(static_cast<uint8_t>(c));

  Film film({folder.get(), temp.path()}, video, find_film_tools());
  for (int i = 0; i < 3; ++i) film.add(image);
  film.complete();
  film.file().publish();

  const string pixels = first_frame(temp / "film.gif");
  ASSERT_EQ(pixels.size(), image.pixels.size());
  EXPECT_TRUE(std::equal(pixels.begin(), pixels.end(), image.pixels.begin(),
                         [](char a, uint8_t b) { return static_cast<uint8_t>(a) == b; }));
}

TEST(Film, AWebpHasEveryPictureForItsTime) {
  TempFolder temp;
  const Descriptor folder(open(temp.path().c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC));
  VideoOutput video;
  video.file = "film.webp";
  video.size = {64, 36};
  for (const double fps : {30.0, 25.0, 60.0})
    // Equal pictures in a row are stored as one, at the end, too.
    for (const vector<int>& phases : {vector<int>{0, 1, 2, 3, 4}, {0, 0, 0, 1, 1}, {0, 1, 1, 1, 1, 1, 1}}) {
      video.fps = fps;
      Film film({folder.get(), temp.path()}, video, find_film_tools());
      for (const int phase : phases) film.add(picture(video.size, 40 * phase));
      EXPECT_EQ(error_of([&] { film.complete(); }), "no error") << fps << ", " << phases.size() << " pictures";
      film.file().publish();
      EXPECT_EQ(webp_frames({folder.get(), temp.path()}, "film.webp", fps), phases.size());
    }
}

TEST(Film, AWebpInWhichNothingMovesIsAStillPicture) {
  TempFolder temp;
  const Descriptor folder(open(temp.path().c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC));
  VideoOutput video;
  video.file = "film.webp";
  video.size = {64, 36};
  for (const int pictures : {1, 5}) {
    Film film({folder.get(), temp.path()}, video, find_film_tools());
    for (int i = 0; i < pictures; ++i) film.add(picture(video.size, 0));
    EXPECT_EQ(error_of([&] { film.complete(); }), "no error") << pictures;
    film.file().publish();
    EXPECT_EQ(webp_frames({folder.get(), temp.path()}, "film.webp", video.fps), nullopt);
  }
}

TEST(Film, ADamagedWebpHasNoPictures) {
  TempFolder temp;
  run(scene_with_film("film.webp"), temp / "run");
  const Descriptor folder(open(temp.path().c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC));
  const string whole = read(temp / "run/film.webp");
  for (const string& damaged : {string(), string("RIFF"), whole.substr(0, whole.size() / 2), "x" + whole}) {
    write(temp / "film.webp", damaged);
    EXPECT_EQ(webp_frames({folder.get(), temp.path()}, "film.webp", 25), 0U);
  }
  EXPECT_EQ(webp_frames({folder.get(), temp.path()}, "absent.webp", 25), 0U);
}

TEST(Film, OpacityStaysInAGifAndAWebp) {
  TempFolder temp;
  const Descriptor folder(open(temp.path().c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC));
  for (const string name : {"film.gif", "film.webp", "film.mp4"}) {
    VideoOutput video;
    video.file = name;
    video.fps = 25;
    video.size = {32, 32};
    video.crf = 1;

    Film film({folder.get(), temp.path()}, video, find_film_tools());
    for (int i = 0; i < 3; ++i) {
      Image image{32, 32, {}, 4};
      for (int k = 0; k < 32 * 32; ++k)
        for (const int c : {200, 40 * i, 50, k % 16 < 8 ? 0 : 255}) image.pixels.push_back(static_cast<uint8_t>(c));
      film.add(image);
    }
    EXPECT_EQ(error_of([&] { film.complete(); }), "no error") << name;
    film.file().publish();
  }

  const string rgb = first_frame(temp / "film.mp4");
  EXPECT_NEAR(static_cast<unsigned char>(rgb[3 * (32 * 16 + 4)]), 0, 8);  // on black
  EXPECT_NEAR(static_cast<unsigned char>(rgb[3 * (32 * 16 + 12)]), 200, 8);

  const string webp = read(temp / "film.webp");
  ASSERT_EQ(webp.substr(12, 4), "VP8X");
  EXPECT_TRUE(webp[20] & 0x10) << "the container names no opacity";

  Child child({find_film_tools().ffmpeg, "-nostdin", "-v", "error", "-i", "film.gif", "-frames:v", "1", "-pix_fmt",
               "rgba", "-f", "rawvideo", "pipe:1"},
              folder.get(), false);
  EXPECT_EQ(child.wait(std::chrono::seconds(60)), 0) << child.errors();

  const string rgba = child.output();
  ASSERT_EQ(rgba.size(), 32U * 32 * 4);
  EXPECT_EQ(static_cast<unsigned char>(rgba[4 * (32 * 16 + 4) + 3]), 0);
  EXPECT_EQ(static_cast<unsigned char>(rgba[4 * (32 * 16 + 12) + 3]), 255);
}

TEST(Film, AFilmOfNothingIsRefusedBeforeAnythingIsWritten) {
  TempFolder temp;
  Scene scene = scene_with_film();
  scene.output.video->from = 0.13;
  scene.output.video->until = 0.12;
  EXPECT_EQ(error_of([&] { Exports exports(scene, temp / "run"); }),
            "cannot make animation.mp4: no picture falls between `from` and `until`");
  EXPECT_FALSE(fs::exists(temp / "run"));
}

TEST(Film, FramesOfNoInstantAreRefusedBeforeAnythingIsWritten) {
  TempFolder temp;
  Scene scene = small_scene();
  scene.output.frames = FramesOutput{10, {32, 32}, 4, 0.11, 0.12};
  EXPECT_EQ(error_of([&] { Exports exports(scene, temp / "run"); }),
            "cannot make frames: no picture falls between `from` and `until`; a frame is at a whole multiple of 1/fps");
  EXPECT_FALSE(fs::exists(temp / "run"));
  scene.output.frames->until = 0.2;
  EXPECT_EQ(error_of([&] { Exports exports(scene, temp / "run"); }), "no error");
}

TEST(Film, WithoutFfmpegNothingIsBegun) {
  TempFolder temp;
  const Scene scene = scene_with_film();
  const string path = std::getenv("PATH");
  const string remedy =
      ", which is not on the PATH\n  install it (on Debian: apt install ffmpeg), or leave the video out";

  setenv("PATH", "", 1);
  EXPECT_EQ(error_of([&] { Exports exports(scene, temp / "run"); }), "a video needs ffmpeg" + remedy);
  unsetenv("PATH");
  EXPECT_EQ(error_of([&] { Exports exports(scene, temp / "run"); }), "a video needs ffmpeg" + remedy);

  write(temp / "bin/ffmpeg", "#!/bin/sh\n");
  chmod((temp / "bin/ffmpeg").c_str(), 0755);
  setenv("PATH", (temp / "bin").c_str(), 1);
  EXPECT_EQ(error_of([&] { Exports exports(scene, temp / "run"); }), "a video needs ffprobe" + remedy);

  setenv("PATH", path.c_str(), 1);
  EXPECT_FALSE(fs::exists(temp / "run"));
}

TEST(Film, AnyFileNameIsJustAName) {
  TempFolder temp;
  for (const string name : {"-i.mp4", "http:%d;'\"`$(touch x).mp4"}) {
    run(scene_with_film(name), temp / "run");
    EXPECT_EQ(names_in(temp / "run"), ([&] {
                vector<string> names = {name, "manifest.json", "scene.yaml", "summary.csv"};
                ranges::sort(names);
                return names;
              }()));
  }
}

TEST(Film, ANameThatIsNoPlainOneOrAnotherOutputsIsRefused) {
  TempFolder temp;
  for (const string name : {"../x.mp4", "/tmp/x.mp4", "a/b.mp4", "..", ".x", "", "a\nb.mp4"})
    EXPECT_EQ(error_of([&] { Exports exports(scene_with_film(name), temp / "run"); }),
              "cannot make the film " + name + ": that is no plain file name");
  for (const string name : {"summary.csv", "manifest.json", "frames", "scene.yaml"})
    EXPECT_EQ(error_of([&] { Exports exports(scene_with_film(name), temp / "run"); }),
              "cannot make the film " + name + ": another output has that name");
  EXPECT_FALSE(fs::exists(temp / "run"));
}

/// A film whose ffmpeg is a shell script, in a folder of its own.
class ScriptedFfmpeg : public ::testing::Test {
 protected:
  string film(const string& script, int pictures, FilmPatience patience = {}) {
    write(temp_ / "ffmpeg", "#!/bin/sh\n" + script + "\n");
    chmod((temp_ / "ffmpeg").c_str(), 0755);
    fs::create_directory(temp_ / "out");
    const Descriptor folder(open((temp_ / "out").c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC));

    VideoOutput video;
    video.size = {320, 180};
    const string error = error_of([&] {
      Film film({folder.get(), "out"}, video, {temp_ / "ffmpeg", find_film_tools().ffprobe}, patience);
      for (int i = 0; i < pictures; ++i) film.add(picture(video.size, i));
      film.complete();
      film.file().publish();
    });

    EXPECT_EQ(names_in(temp_ / "out"), error == "no error" ? vector<string>{"animation.mp4"} : vector<string>{});
    return error;
  }
  string real() const { return find_film_tools().ffmpeg + " \"$@\""; }
  TempFolder temp_;
};

TEST_F(ScriptedFfmpeg, TheRealOneMakesAFilm) {
  EXPECT_EQ(film("exec " + real(), 5), "no error");
}

TEST_F(ScriptedFfmpeg, OneThatEndsTooEarlyIsQuotedAndEndsNoOtherProcess) {
  ASSERT_NE(signal(SIGPIPE, SIG_DFL), SIG_ERR);  // sending must not raise it
  EXPECT_EQ(film("echo 'Unknown encoder libx264' >&2; exit 1", 50),
            "cannot make the film out/animation.mp4: ffmpeg ended too early: Unknown encoder libx264");
}

TEST_F(ScriptedFfmpeg, OneThatFailsAtTheEndIsQuoted) {
  EXPECT_EQ(film("cat >/dev/null; echo 'No space left' >&2; echo again >&2; exit 7", 3),
            "cannot make the film out/animation.mp4: ffmpeg failed with code 7: No space left;again");
}

TEST_F(ScriptedFfmpeg, AKilledOneIsReported) {
  EXPECT_EQ(film("cat >/dev/null; kill -9 $$", 3),
            "cannot make the film out/animation.mp4: ffmpeg failed with code 137: no message");
}

TEST_F(ScriptedFfmpeg, HalfAFilmIsReported) {
  EXPECT_EQ(film("head -c " + to_string(3 * 320 * 180 * 3 / 2) + " | " + real() + "; cat >/dev/null", 5),
            "cannot make the film out/animation.mp4: ffmpeg wrote 3 of 5 frames");
}

TEST_F(ScriptedFfmpeg, NoFilmAtAllIsReported) {
  const string error = film("cat >/dev/null", 3);
  EXPECT_TRUE(error.starts_with("cannot make the film out/animation.mp4: ffprobe cannot read it: ")) << error;
}

TEST_F(ScriptedFfmpeg, OneThatTakesNothingIsStopped) {
  EXPECT_EQ(film("exec sleep 1000", 50, {milliseconds(1000), milliseconds(1000)}),
            "cannot make the film out/animation.mp4: ffmpeg accepted no picture for 1 s and was stopped");
}

TEST_F(ScriptedFfmpeg, OneThatTakesNothingDelaysNoOtherError) {
  write(temp_ / "ffmpeg", "#!/bin/sh\nexec sleep 1000\n");
  chmod((temp_ / "ffmpeg").c_str(), 0755);
  const Descriptor folder(open(temp_.path().c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC));
  VideoOutput video;
  video.size = {640, 360};  // more than a socket holds

  const auto start = std::chrono::steady_clock::now();
  {
    Film film({folder.get(), "out"}, video, {temp_ / "ffmpeg", find_film_tools().ffprobe});
    film.add(picture(video.size, 0));
    EXPECT_EQ(error_of([&] {
                film.add(picture({2, 2}, 0));
              }),
              "cannot make the film out/animation.mp4: a picture is of another size");
  }

  EXPECT_LT(std::chrono::steady_clock::now() - start, std::chrono::seconds(2));
}

TEST_F(ScriptedFfmpeg, OneThatDoesNotEndIsStopped) {
  EXPECT_EQ(film("cat >/dev/null; exec sleep 1000", 3, {milliseconds(1000), milliseconds(1000)}),
            "cannot make the film out/animation.mp4: ffmpeg did not end within 1 s and was stopped");
}

TEST_F(ScriptedFfmpeg, OneThatPrintsWithoutEndBlocksNothing) {
  EXPECT_EQ(film("head -c 3000000 /dev/zero | tr '\\0' x >&2; head -c 3000000 /dev/zero; exec " + real(), 3),
            "no error");
}

TEST(Film, AnFfmpegThatOutlivesItsKilledRunSpoilsNothing) {
  TempFolder temp;
  const Scene scene = scene_with_film();
  run(scene, temp / "whole");
  const string whole = read(temp / "whole/animation.mp4");

  for (const int pictures : {1, 3, 6}) {
    const pid_t child = fork();
    if (child == 0) {
      Exports exports(scene, temp / "run");
      exports.begin_drawings();
      for (int i = 0; i < pictures; ++i) {
        exports.drawings().timeline().advance();
        exports.picture(0, picture(small, i));
      }
      kill(getpid(), SIGKILL);
    }

    int status = 0;
    waitpid(child, &status, 0);
    run(scene, temp / "run");  // its ffmpeg has just reached the end of its input
    EXPECT_TRUE(read(temp / "run/animation.mp4") == whole) << pictures;
    EXPECT_EQ(names_in(temp / "run"), names_in(temp / "whole")) << pictures;
  }
}

TEST_F(ScriptedFfmpeg, ItInheritsNoFileOfTheRun) {
  // No table, no part, no lock: they would outlive a run that is killed.
  write(temp_ / "bin/ffmpeg", "#!/bin/sh\nls -l /proc/$$/fd | grep '/run' >&2 && exit 9\nexec " + real() + "\n");
  chmod((temp_ / "bin/ffmpeg").c_str(), 0755);
  fs::create_symlink(find_film_tools().ffprobe, temp_ / "bin/ffprobe");
  const string path = std::getenv("PATH");
  setenv("PATH", (temp_ / "bin:" + path).c_str(), 1);
  Scene scene = scene_with_film();
  scene.output.trajectory.emplace();
  scene.output.collisions = true;
  scene.output.frames = FramesOutput{10, small, 4, 0, {}};
  EXPECT_EQ(error_of([&] { run(scene, temp_ / "run"); }), "no error");
  setenv("PATH", path.c_str(), 1);
}

}  // namespace
}  // namespace carom
