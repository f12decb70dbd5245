// Runs ffmpeg and waits for it.
// The film is made in a temporary folder, and its frames are counted before it is accepted.
// Exit codes are not sufficient: ffmpeg may succeed with a part of the frames.
#include "export/film_file.h"

#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <charconv>

#include "export/webp.h"
#include "files/folder_names.h"
#include "files/folders.h"
#include "files/stored_file.h"
#include "scene/film_format.h"
#include "std.h"

namespace carom {
namespace {

/// The last lines of a program's error output, on one line.
string complaint(const string& text) {
  const size_t most = 600;
  string tail = text.size() > most ? "..." + text.substr(text.size() - most) : text;
  while (!tail.empty() && tail.back() == '\n') tail.pop_back();
  for (char& c : tail) c = c == '\n' ? ';' : static_cast<unsigned char>(c) < ' ' ? ' ' : c;
  return tail.empty() ? "no message" : tail;
}

/// The properties of a film's only stream as printed by ffprobe, separated by commas, in ffprobe's own order.
/// ffprobe counts the pictures, because a GIF does not store their number.
string probed(const FilmTools& tools, int folder, const string& name, const string& entries, string& error) {
  Child probe({tools.ffprobe, "-v", "error", "-select_streams", "v:0", "-count_packets", "-show_entries",
               "stream=" + entries, "-of", "csv=p=0", "file:" + name},
              folder, false);
  const auto code = probe.wait(std::chrono::minutes(10));
  if (!code || *code != 0) error = "ffprobe cannot read it: " + complaint(probe.errors());
  return probe.output();
}

/// Removes a whole number and the separator after it from the front of `text`, and returns the number.
uint64_t take_number(string_view& text) {
  uint64_t value = 0;
  const auto end = std::from_chars(text.data(), text.data() + text.size(), value).ptr;
  text.remove_prefix(min(text.size(), size_t(end - text.data()) + 1));
  return value;
}

uint64_t counted_frames(const FilmTools& tools, int folder, const string& name, string& error) {
  const string counted = probed(tools, folder, name, "nb_read_packets", error);
  string_view text = counted;
  return take_number(text);
}

}  // namespace

FilmTools find_film_tools() {
  const auto ffmpeg = find_program("ffmpeg"), ffprobe = find_program("ffprobe");
  if (!ffmpeg || !ffprobe) {
    throw ExportError(
        string("a video needs ") + (ffmpeg ? "ffprobe" : "ffmpeg") +
        ", which is not on the PATH\n  install it (on Debian: apt install ffmpeg), or leave the video out");
  }
  return {*ffmpeg, *ffprobe};
}

FilmFile::FilmFile(const FilePlace& place, const string& name, FilmTools tools, const FilmPatience& patience)
    : PartFile(place, name), tools_(std::move(tools)), patience_(patience) {}

FilmFile::~FilmFile() {
  ffmpeg_.reset();
  if (workshop_) try_to_remove(place_.folder, workshop_name());
}

string FilmFile::workshop_name() const {
  return part_name(record_.name + ".work");
}

void FilmFile::fail_with(const string& reason) const {
  fail("make the film", place_, record_.name, reason);
}

FilePlace FilmFile::workshop() {
  const string folder = workshop_name();
  if (!workshop_) {
    // ffmpeg opens its file by name, more than once, and survives a run that is killed.
    // A folder of its own contains no link. Once the next run has removed that folder, ffmpeg cannot write anywhere.
    remove_entry(place_, folder);
    if (mkdirat(place_.folder, folder.c_str(), 0777) != 0) fail("write", place_, record_.name);
    workshop_ = open_folder(place_.folder, folder, false);
    if (!workshop_) fail("write", place_, record_.name);
  }
  return {workshop_.get(), place_.path + "/" + folder};
}

void FilmFile::start(const FfmpegRun& run, bool fed) {
  FfmpegRun arguments = {tools_.ffmpeg, "-nostdin", "-hide_banner", "-loglevel", "error", "-y"};
  arguments.insert(arguments.end(), run.begin(), run.end());
  const FilePlace place = workshop();
  ffmpeg_ = make_unique<Child>(arguments, place.folder, fed);
}

void FilmFile::send(const void* bytes, size_t size) {
  switch (ffmpeg_->send(bytes, size, patience_.each)) {
    case Child::Sent::all:
    case Child::Sent::abandoned:
      return;
    case Child::Sent::closed:
      ffmpeg_->wait(std::chrono::seconds(5));
      fail_with("ffmpeg ended too early: " + complaint(ffmpeg_->errors()));
    case Child::Sent::stuck:
      ffmpeg_->kill();
      fail_with("ffmpeg accepted no picture for " + to_string(patience_.each.count() / 1000) + " s and was stopped");
  }
}

void FilmFile::abandon() {
  if (ffmpeg_) ffmpeg_->abandon();
}

void FilmFile::end_run() {
  if (!ffmpeg_) fail_with("it has no pictures");
  ffmpeg_->end_input();
  const optional<int> code = ffmpeg_->wait(patience_.end);
  if (!code) {
    ffmpeg_->kill();
    fail_with("ffmpeg did not end within " + to_string(patience_.end.count() / 1000) + " s and was stopped");
  }
  if (*code != 0) fail_with("ffmpeg failed with code " + to_string(*code) + ": " + complaint(ffmpeg_->errors()));
}

void FilmFile::complete(const string& made, uint64_t frames, double fps) {
  end_run();
  string error;
  const uint64_t found = film_format(made) == FilmFormat::webp ? webp_frames(workshop(), made, fps).value_or(frames)
                                                               : counted_frames(tools_, workshop_.get(), made, error);
  if (!error.empty()) fail_with(error);
  if (found != frames) fail_with("ffmpeg wrote " + to_string(found) + " of " + to_string(frames) + " frames");

  const auto stored = read_record(workshop_.get(), made);
  if (!stored) fail("read", place_, record_.name);
  record_.bytes = stored->bytes;
  record_.sha256 = stored->sha256;
  give_name(workshop_.get(), made, place_, part());
  remove_entry(place_, workshop_name());
}

FilmFacts film_facts(const FilmTools& tools, const FilePlace& place, const string& name) {
  string error;
  const string output = probed(tools, place.folder, name, "width,height,r_frame_rate,nb_read_packets", error);
  if (!error.empty()) fail("read the film", place, name, error);

  // The numbers in the order in which they were asked for.
  string_view text = output;
  FilmFacts facts;
  facts.width = int(take_number(text));
  facts.height = int(take_number(text));
  facts.rate = take_number(text);
  facts.per = take_number(text);
  facts.frames = take_number(text);

  if (facts.width == 0 || facts.height == 0 || facts.rate == 0 || facts.per == 0 || facts.frames == 0)
    fail("read the film", place, name, "ffprobe finds no pictures in it");
  return facts;
}

}  // namespace carom
