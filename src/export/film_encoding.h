#pragma once
// The options of ffmpeg for each format of films.

#include "render/image.h"
#include "scene/output.h"
#include "std.h"

namespace carom {

/// A run of ffmpeg in the film's temporary folder: all arguments after its own name.
using FfmpegRun = vector<string>;

/// The runs that make a film from raw pictures, and the name of its file in the temporary folder.
/// The first run reads the pictures from its input: yuv420p (yuv.h) for .mp4, else the pixels as they are.
struct FilmEncoding {
  vector<FfmpegRun> runs;
  string file;
};

/// `picture`: one of the film's.
FilmEncoding film_encoding(const VideoOutput& video, const Image& picture);

/// The name of an H.264 film, as the last argument of a run has it.
inline constexpr const char* h264_file = "film.mp4";
/// The options of every H.264 film and its name: yuv420p, BT.709, index in front, reproducible bytes.
FfmpegRun h264_output(int crf, const string& file = h264_file);

/// The samples of a film with sound, in the temporary folder: 32-bit floats of one channel.
inline constexpr const char* samples_file = "sound.f32";
/// The run that joins pictures and sound of such a film, after the runs of film_encoding(). The samples are multiplied
/// by `gain`.
FfmpegRun sound_run(double rate, double gain);

}  // namespace carom
