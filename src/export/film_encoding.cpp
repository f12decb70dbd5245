// Every film has a fixed number of threads and no version numbers, so that the same pictures give the same bytes.
//
// H.264 has the preset veryfast. Against medium at crf 18 it took 0.4 to 0.7 of the CPU (4 to 10 ms a picture of
// 1280 x 720), with files from 16 % smaller to 4 % larger and 1.3 to 2.4 dB less (45.6 to 56.4 dB; the first scene, the
// billiard break, the ten pins and the gas). superfast saves little more, and its files are 1.6 to 2.8 times as large.
//
// An mp4 with sound takes two runs: the sound is complete only with the last picture. AAC delays it by 1024 samples,
// which the edit list of the file takes back.
//
// A GIF takes two runs. The palette depends on all pictures, and ffmpeg alone would keep all of them in memory: 5 MB
// for each one of 1280 x 720. The first run stores them without loss and makes the palette, the second one applies it.
// Ordered dithering depends on a pixel's place alone, so that still surfaces do not flicker.
#include "export/film_encoding.h"

#include <fmt/format.h>

#include "export/yuv.h"
#include "scene/film_format.h"
#include "std.h"

namespace carom {
namespace {

constexpr int largest_crf = 51;

/// The pictures of a film with sound.
constexpr const char* silent_file = "pictures.mp4";

void add(FfmpegRun& run, std::initializer_list<string_view> arguments) {
  for (const string_view argument : arguments) run.emplace_back(argument);
}

FfmpegRun raw_input(const VideoOutput& video, string_view pixels, int width, int height) {
  FfmpegRun run;
  add(run, {"-f", "rawvideo", "-pixel_format", pixels, "-video_size", fmt::format("{}x{}", width, height), "-framerate",
            fmt::format("{}", video.fps), "-i", "pipe:0"});
  return run;
}

/// For every format. Pictures are evenly spaced, so that ffmpeg neither drops nor repeats one: it needs no option for
/// that, which has one name before version 5.1 and another after it.
void add_reproducible(FfmpegRun& run) {
  add(run, {"-an", "-fflags", "+bitexact", "-flags:v", "+bitexact", "-map_metadata", "-1"});
}

FilmEncoding mp4(const VideoOutput& video, const Image& picture) {
  const Size size = yuv_size(picture);
  FfmpegRun run = raw_input(video, "yuv420p", size.width, size.height);
  for (string& argument : h264_output(video.crf, video.sound ? silent_file : h264_file))
    run.push_back(std::move(argument));
  return {{std::move(run)}, h264_file};
}

FilmEncoding gif(const VideoOutput& video, const Image& picture) {
  const bool transparent = picture.channels == 4;
  FfmpegRun store = raw_input(video, transparent ? "rgba" : "rgb24", picture.width, picture.height);
  add(store, {"-filter_complex", "[0:v]split[pictures][colours];[colours]palettegen=stats_mode=full[palette]"});
  add(store, {"-map", "[pictures]", "-c:v", "qtrle", "-pix_fmt", transparent ? "argb" : "rgb24"});
  add_reproducible(store);
  add(store, {"-f", "mov", "file:pictures.mov", "-map", "[palette]"});
  add_reproducible(store);
  add(store, {"-update", "1", "file:palette.png"});

  FfmpegRun apply;
  add(apply, {"-i", "file:pictures.mov", "-i", "file:palette.png", "-filter_complex",
              "[0:v][1:v]paletteuse=dither=bayer:bayer_scale=3:diff_mode=rectangle"});
  add_reproducible(apply);
  add(apply, {"-loop", "0", "-f", "gif", "file:film.gif"});
  return {{std::move(store), std::move(apply)}, "film.gif"};
}

FilmEncoding webp(const VideoOutput& video, const Image& picture) {
  FfmpegRun run = raw_input(video, picture.channels == 4 ? "rgba" : "rgb24", picture.width, picture.height);
  const int quality = (100 * (largest_crf - video.crf) + largest_crf / 2) / largest_crf;
  add(run, {"-c:v", "libwebp_anim", "-pix_fmt", "bgra", "-quality", to_string(quality)});
  add_reproducible(run);
  add(run, {"-loop", "0", "-f", "webp", "file:film.webp"});
  return {{std::move(run)}, "film.webp"};
}

}  // namespace

FilmEncoding film_encoding(const VideoOutput& video, const Image& picture) {
  switch (film_format(video.file).value_or(FilmFormat::mp4)) {
    case FilmFormat::gif:
      return gif(video, picture);
    case FilmFormat::webp:
      return webp(video, picture);
    case FilmFormat::mp4:
      break;
  }
  return mp4(video, picture);
}

FfmpegRun h264_output(int crf, const string& file) {
  FfmpegRun run;
  add_reproducible(run);
  add(run, {"-c:v", "libx264", "-preset", "veryfast", "-crf", to_string(crf), "-pix_fmt", "yuv420p", "-threads", "4"});
  add(run, {"-colorspace", "bt709", "-color_primaries", "bt709", "-color_trc", "bt709", "-color_range", "tv",
            "-chroma_sample_location", "center"});
  add(run, {"-movflags", "+faststart", "-f", "mp4", "file:" + file});
  return run;
}

FfmpegRun sound_run(double rate, double gain) {
  FfmpegRun run;
  add(run, {"-i", string("file:") + silent_file, "-f", "f32le", "-ar", fmt::format("{}", rate), "-ac", "1", "-i",
            string("file:") + samples_file});
  add(run, {"-map", "0:v", "-map", "1:a", "-c:v", "copy", "-af", fmt::format("volume={}:precision=double", gain)});
  add(run, {"-c:a", "aac", "-b:a", "128k", "-fflags", "+bitexact", "-flags:a", "+bitexact", "-map_metadata", "-1"});
  add(run, {"-movflags", "+faststart", "-f", "mp4", string("file:") + h264_file});
  return run;
}

}  // namespace carom
