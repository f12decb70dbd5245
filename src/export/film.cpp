#include "export/film.h"

#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <charconv>

#include "export/folder_names.h"
#include "export/open_folder.h"
#include "export/run_folder.h"
#include "export/stored_file.h"

namespace carom {
namespace {

/// The film's name in ffmpeg's own folder. (The name it will have is the scene's and never stands on a command line.)
constexpr const char* film_name = "film.mp4";

std::string decimal(double value) {
  char text[32];
  return std::string(text, std::to_chars(text, text + sizeof text, value).ptr);
}

std::vector<std::string> ffmpeg_arguments(const std::string& program, const VideoOutput& video) {
  const int width = video.size.width, height = video.size.height;
  // The pictures are full-range sRGB; a film is limited-range Y'CbCr by BT.709, and says so.
  std::string filter =
      "scale=in_range=pc:out_range=tv:out_color_matrix=bt709:flags=accurate_rnd+full_chroma_int+bitexact";
  // Colour has half the resolution, so that both sides must be even: an odd one repeats its last pixel.
  const int right = width % 2, bottom = height % 2;
  if (right || bottom) {
    filter = "pad=" + std::to_string(width + right) + ":" + std::to_string(height + bottom) +
             ",fillborders=right=" + std::to_string(right) + ":bottom=" + std::to_string(bottom) + ":mode=smear," +
             filter;
  }
  return {program, "-nostdin", "-hide_banner", "-loglevel", "error", "-y",
          // what comes
          "-f", "rawvideo", "-pixel_format", "rgb24", "-video_size",
          std::to_string(width) + "x" + std::to_string(height), "-framerate", decimal(video.fps), "-i", "pipe:0",
          // what is made of it: as many threads everywhere and no version numbers, for the same bytes everywhere
          "-an", "-vf", filter, "-c:v", "libx264", "-preset", "medium", "-crf", std::to_string(video.crf), "-pix_fmt",
          "yuv420p", "-threads", "4", "-fps_mode", "passthrough", "-colorspace", "bt709", "-color_primaries", "bt709",
          "-color_trc", "bt709", "-color_range", "tv", "-movflags", "+faststart", "-fflags", "+bitexact", "-flags:v",
          "+bitexact", "-map_metadata", "-1", "-f", "mp4", std::string("file:") + film_name};
}

/// The last lines of what a program complained of, on one line.
std::string complaint(const std::string& text) {
  const std::size_t most = 600;
  std::string tail = text.size() > most ? "..." + text.substr(text.size() - most) : text;
  while (!tail.empty() && tail.back() == '\n') tail.pop_back();
  for (char& c : tail) c = c == '\n' ? ';' : static_cast<unsigned char>(c) < ' ' ? ' ' : c;
  return tail.empty() ? "it said nothing" : tail;
}

}  // namespace

FilmTools find_film_tools() {
  const auto ffmpeg = find_program("ffmpeg"), ffprobe = find_program("ffprobe");
  if (!ffmpeg || !ffprobe) {
    throw ExportError(
        std::string("the scene asks for a video, but ") + (ffmpeg ? "ffprobe" : "ffmpeg") +
        " is not on this machine's PATH: install it (on Debian: apt install ffmpeg), or leave the video out");
  }
  return {*ffmpeg, *ffprobe};
}

Film::Film(const FilePlace& place, const VideoOutput& video, FilmTools tools, const FilmPatience& patience)
    : place_(place), video_(video), tools_(std::move(tools)), patience_(patience) {
  record_.name = video_.file;
  if (!is_plain_name(video_.file))
    fail_with("a film's name may hold no slash, no control character and no dot at its start");
}

Film::~Film() {
  ffmpeg_.reset();
  if (!published_ && workshop_) remove_entry(place_.folder, part_name(record_.name));
}

void Film::fail_with(const std::string& reason) {
  fail("make the film", place_, record_.name, reason);
}

void Film::start() {
  // ffmpeg opens its file by name, more than once, and outlives a run that is killed. In a folder of its own it meets
  // no link, and once the next run has removed that folder it can touch nothing any more.
  const std::string part = part_name(record_.name);
  remove_entry(place_.folder, part);
  if (mkdirat(place_.folder, part.c_str(), 0777) != 0) fail("write", place_, record_.name);
  workshop_ = open_folder(place_.folder, part, false);
  if (!workshop_) fail("write", place_, record_.name);
  ffmpeg_ = std::make_unique<Child>(ffmpeg_arguments(tools_.ffmpeg, video_), workshop_.get(), true);
}

void Film::add(const Image& image) {
  if (image.width != video_.size.width || image.height != video_.size.height) fail_with("a picture is of another size");
  if (!ffmpeg_) start();
  switch (ffmpeg_->send(image.pixels.data(), image.pixels.size(), patience_.each)) {
    case Child::Sent::all:
      ++frames_;
      return;
    case Child::Sent::closed:
      ffmpeg_->wait(std::chrono::seconds(5));
      fail_with("ffmpeg ended too early: " + complaint(ffmpeg_->errors()));
    case Child::Sent::stuck:
      ffmpeg_->kill();
      fail_with("ffmpeg took no picture for " + std::to_string(patience_.each.count() / 1000) + " s and was stopped");
  }
}

void Film::complete() {
  if (!ffmpeg_) fail_with("no picture falls into it");
  ffmpeg_->end_input();
  const auto code = ffmpeg_->wait(patience_.end);
  if (!code) {
    ffmpeg_->kill();
    fail_with("ffmpeg did not end within " + std::to_string(patience_.end.count() / 1000) + " s and was stopped");
  }
  if (*code != 0) fail_with("ffmpeg failed with code " + std::to_string(*code) + ": " + complaint(ffmpeg_->errors()));

  Child probe({tools_.ffprobe, "-v", "error", "-select_streams", "v:0", "-count_packets", "-show_entries",
               "stream=nb_read_packets", "-of", "csv=p=0", std::string("file:") + film_name},
              workshop_.get(), false);
  const auto probed = probe.wait(patience_.end);
  if (!probed || *probed != 0) fail_with("ffprobe cannot read it: " + complaint(probe.errors()));
  const std::string counted = probe.output();
  std::uint64_t found = 0;
  std::from_chars(counted.data(), counted.data() + counted.size(), found);
  if (found != frames_)
    fail_with("ffmpeg wrote " + std::to_string(found) + " of " + std::to_string(frames_) + " frames");

  const auto stored = read_record(workshop_.get(), film_name);
  if (!stored) fail("read", place_, record_.name);
  record_.bytes = stored->bytes;
  record_.sha256 = stored->sha256;
}

void Film::publish() {
  if (renameat(workshop_.get(), film_name, place_.folder, record_.name.c_str()) != 0)
    fail("write", place_, record_.name);
  published_ = true;
  remove_entry(place_.folder, part_name(record_.name));
}

}  // namespace carom
