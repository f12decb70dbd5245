#pragma once
// The films of several runs in one film, side by side and synchronised, each with its name.

#include "export/film_file.h"
#include "std.h"

namespace carom {

struct FilmTile {
  string folder, file;    // the film
  double from = 0;        // s, the simulated time of its first frame
  vector<string> labels;  // lines
  double speed = 1;       // seconds of motion a second of film; the same of all tiles
  uint64_t before = 0;    // pictures of a title card, which are left out
};

/// The maximum number of films in one.
inline constexpr size_t most_tiles = 16;

/// H.264 as for every film. The same films give the same bytes. Time is simulated time.
/// A film that begins later shows its first frame until then, and one that ends earlier keeps its last.
/// Films of different sizes keep their aspect ratios. The highest frame rate applies to all.
/// Labels stand above their films, because a film may have text anywhere.
/// The grid is as square as possible.
class SideBySide {
 public:
  /// Reads the properties of the films. `font`: the file of the labels' typeface.
  /// Throws ExportError, as all functions of this class do. Its text names what is missing and the remedy.
  SideBySide(const FilePlace& place, const string& name, vector<FilmTile> tiles, const string& font);

  /// Makes the film.
  void complete();
  PartFile& file() { return file_; }
  const FileRecord& record() const { return file_.record(); }  // valid after complete()

 private:
  FilmTools tools_;
  FilmFile file_;
  vector<FilmTile> tiles_;
  vector<FilmFacts> facts_;  // by tile
  string font_;
};

}  // namespace carom
