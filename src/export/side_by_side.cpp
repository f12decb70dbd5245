// Builds one ffmpeg filter graph for all films: equal frame rate, size and length, a label above each, then xstack.
// Times are aligned by simulated time. Labels and their font are passed in files, so that no text of a scene and no
// path enters the graph. A label on a film would meet its caption.
#include "export/side_by_side.h"

#include <fcntl.h>
#include <fmt/format.h>

#include <filesystem>

#include "files/folders.h"
#include "files/stored_file.h"
#include "numerics/whole.h"
#include "scene/film_format.h"
#include "std.h"

namespace carom {
namespace {

constexpr const char* font_file = "font.ttf";  // of the labels, in the temporary folder
constexpr uint64_t most_font_bytes = 50'000'000;
constexpr int widest = 3840, highest = 2160;  // pixels, of the whole film
constexpr int crf = 18;

constexpr double label_height = 1.0 / 22;  // of a letter, in heights of a film, where the width allows it
constexpr int least_label = 8;             // pixels, of a letter
constexpr double line_height = 1.45;       // in heights of a letter

/// The layout in columns and rows, the size of a film and the height of the strip above it, in pixels.
/// All sides are even, because colour has half the resolution.
struct Grid {
  int columns, rows, width, height, letter, strip;
};

int even(double pixels) {
  return max(2, 2 * int(pixels / 2));
}

size_t most_lines(const vector<FilmTile>& tiles) {
  size_t lines = 1;
  for (const FilmTile& tile : tiles) lines = max(lines, tile.labels.size());
  return lines;
}

/// The largest size at which the longest line fits. A letter of this font is about 0.6 of its size wide.
int letter_of(const vector<FilmTile>& tiles, int width, int height) {
  size_t longest = 1;
  for (const FilmTile& tile : tiles)
    for (const string& line : tile.labels) longest = max(longest, line.size());
  const double by_width = (width - 16) / (0.62 * double(longest));
  return max(least_label, int(min(by_width, height * label_height)));
}

Grid grid_of(const vector<FilmTile>& tiles, const vector<FilmFacts>& films) {
  int columns = 1;
  while (size_t(columns * columns) < films.size()) ++columns;
  const int rows = (int(films.size()) + columns - 1) / columns;
  int width = 0, height = 0;
  for (const FilmFacts& film : films) {
    width = max(width, film.width);
    height = max(height, film.height);
  }
  // A strip has its lines and half a letter above and below them.
  const double letters = line_height * double(most_lines(tiles)) + 1;
  const double whole_height = height * (1 + letters * label_height);
  const double scale = min({1.0, widest / double(width * columns), highest / (whole_height * rows)});
  Grid grid{columns, rows, even(width * scale), even(height * scale), 0, 0};
  grid.letter = letter_of(tiles, grid.width, grid.height);
  grid.strip = even(letters * grid.letter);
  return grid;
}

/// Whether `a` has the higher frame rate.
bool is_faster(const FilmFacts& a, const FilmFacts& b) {
  return a.rate * b.per > b.rate * a.per;
}

double rate_of(const FilmFacts& film) {
  return double(film.rate) / double(film.per);
}

/// The number of frames before a tile's first one, and of the tile, at the frame rate of the whole film.
struct Span {
  uint64_t before, frames;
};

Span span_of(const FilmTile& tile, const FilmFacts& film, const FilmFacts& fastest, double start) {
  const double rate = rate_of(fastest);
  const double frames = double(film.frames) * rate / rate_of(film);
  return {uint64_t(max<int64_t>(0, nearest_whole((tile.from - start) / tile.speed * rate))),
          uint64_t(max<int64_t>(1, nearest_whole(frames)))};
}

void write_label(const FilePlace& place, const string& name, const FilmTile& tile) {
  OutputFile file(place, name);
  for (size_t k = 0; k < tile.labels.size(); ++k) file.write((k > 0 ? "\n" : "") + tile.labels[k]);
  file.publish();
}

/// False: it cannot be read.
bool copy_font(const string& font, const FilePlace& place) {
  const std::filesystem::path path(canonical(font));
  const Descriptor folder = open_folder(AT_FDCWD, path.parent_path().string(), true);
  const auto bytes = folder ? read_text(folder.get(), path.filename().string(), most_font_bytes) : nullopt;
  if (!bytes) return false;
  OutputFile file(place, font_file);
  file.write(*bytes);
  file.publish();
  return true;
}

}  // namespace

SideBySide::SideBySide(const FilePlace& place, const string& name, vector<FilmTile> tiles, const string& font)
    : tools_(find_film_tools()), file_(place, name, tools_, {}), tiles_(std::move(tiles)), font_(font) {
  if (tiles_.size() < 2 || tiles_.size() > most_tiles)
    file_.fail_with(fmt::format("it shows 2 to {} runs, not {}: name {}", most_tiles, tiles_.size(),
                                tiles_.size() < 2 ? "more" : "fewer"));
  for (const FilmTile& tile : tiles_) {
    const Descriptor folder = open_folder(AT_FDCWD, tile.folder, true);
    if (!folder) fail("open", {-1, tile.folder}, "");
    FilmFacts& facts = facts_.emplace_back(film_facts(tools_, {folder.get(), tile.folder}, tile.file));
    facts.frames -= min(facts.frames, tile.before);
  }
}

void SideBySide::complete() {
  const Grid grid = grid_of(tiles_, facts_);
  const FilmFacts& fastest = *ranges::max_element(facts_, [](const auto& a, const auto& b) { return is_faster(b, a); });
  double start = tiles_.front().from;
  for (const FilmTile& tile : tiles_) start = min(start, tile.from);
  if (!copy_font(font_, file_.workshop())) file_.fail_with("the font of its labels cannot be read: " + font_);

  vector<string> input;
  string graph, stacked, layout;
  uint64_t frames = 0;
  vector<Span> spans;
  for (size_t k = 0; k < tiles_.size(); ++k) {
    spans.push_back(span_of(tiles_[k], facts_[k], fastest, start));
    frames = max(frames, spans.back().before + spans.back().frames);
  }

  for (size_t k = 0; k < tiles_.size(); ++k) {
    const FilmFacts& film = facts_[k];
    const string label = fmt::format("label_{}.txt", k);
    write_label(file_.workshop(), label, tiles_[k]);
    input.insert(input.end(),
                 {"-i", "file:" + absolute((std::filesystem::path(tiles_[k].folder) / tiles_[k].file).string())});
    graph += fmt::format("[{}:v]", k);
    if (tiles_[k].before > 0) graph += fmt::format("trim=start_frame={},setpts=PTS-STARTPTS,", tiles_[k].before);

    // Other films are in these colours already.
    if (film_format(tiles_[k].file) == FilmFormat::gif)
      graph += "scale=out_color_matrix=bt709:out_range=tv:flags=accurate_rnd+full_chroma_int+bitexact,format=yuv420p,";
    if (is_faster(fastest, film)) graph += fmt::format("fps={}/{},", fastest.rate, fastest.per);
    if (film.width != grid.width || film.height != grid.height)
      graph += fmt::format(
          "scale={0}:{1}:force_original_aspect_ratio=decrease:force_divisible_by=2:flags=bicubic+accurate_rnd+"
          "full_chroma_int+bitexact,setsar=1,",
          grid.width, grid.height);
    graph += fmt::format("pad={0}:{1}+{2}:(ow-iw)/2:{2}+({1}-ih)/2,", grid.width, grid.height, grid.strip);
    // Give each film the same number of frames: the first one repeated before, the last one after.
    graph += fmt::format("tpad=start={}:start_mode=clone:stop=-1:stop_mode=clone,trim=end_frame={}", spans[k].before,
                         frames);

    // The label, and the place of the film among the others.
    graph += fmt::format(
        ",drawtext=fontfile={}:textfile={}:expansion=none:fontsize={}:fontcolor=white:line_spacing={}:x={}:y={}[t{}];",
        font_file, label, grid.letter, grid.letter / 4, grid.letter / 2 + 2, grid.letter / 2, k);
    stacked += fmt::format("[t{}]", k);
    const int row = int(k) / grid.columns, column = int(k) % grid.columns;
    layout += fmt::format("{}{}_{}", k > 0 ? "|" : "", column * grid.width, row * (grid.height + grid.strip));
  }

  graph += fmt::format("{}xstack=inputs={}:layout={}:fill=black", stacked, tiles_.size(), layout);
  FfmpegRun run = std::move(input);
  run.insert(run.end(), {"-filter_complex", graph});
  for (string& argument : h264_output(crf)) run.push_back(std::move(argument));
  file_.start(run, false);
  file_.complete(h264_file, frames, rate_of(fastest));
}

}  // namespace carom
