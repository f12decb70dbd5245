// Writes each file of a series through OutputFile, so that every file is complete as soon as its name exists.
// The complete files of a series stay even if the run fails later.
#include "files/series.h"

#include <utility>

namespace carom {

void Series::put(std::string name, std::string_view bytes) {
  OutputFile file(place_, std::move(name));
  file.write(bytes);
  file.publish();
  folder_.keep();
  records_.push_back(file.record());
  records_.back().name.insert(0, std::string(files_.folder) + "/");
}

}  // namespace carom
