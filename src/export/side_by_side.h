#pragma once
// Films of several runs in one: side by side, in step, each with its name.
#include <memory>
#include <string>
#include <vector>

#include "export/film_file.h"

namespace carom {

struct FilmTile {
  std::string folder, file;         // the film
  double from = 0;                  // s, simulated time of its first frame
  std::vector<std::string> labels;  // lines
};

/// How many films there is room for in one.
inline constexpr std::size_t most_tiles = 16;

/// H.264 as of any film; the same films give the same bytes. Time is simulated time: a film that begins later shows its
/// first frame until then, one that ends earlier its last. Of different sizes, each keeps its shape; of different frame
/// rates, the highest is taken. The grid is as square as can be.
class SideBySide {
 public:
  /// Looks at the films. Throws ExportError, as all of this class does, which says what is missing and the remedy.
  SideBySide(const FilePlace& place, const std::string& name, std::vector<FilmTile> tiles);

  /// Makes the film.
  void complete();
  PartFile& file() { return file_; }
  const FileRecord& record() const { return file_.record(); }  // after complete()

 private:
  FilmTools tools_;
  FilmFile file_;
  std::vector<FilmTile> tiles_;
  std::vector<FilmFacts> facts_;  // by tile
};

}  // namespace carom
