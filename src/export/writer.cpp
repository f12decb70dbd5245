#include "export/writer.h"

#include "std.h"

namespace carom {

void keep_part(StateWriter& archive, OutputFile& file) {
  WrittenPart part = file.pause();
  archive(part);
}

void keep_part(StateReader& archive, OutputFile& file) {
  WrittenPart part;
  archive(part);
  file.go_on(part);
}

void Writer::keep(StateWriter& archive) {
  for (OutputFile* file : files()) keep_part(archive, *file);
}

void Writer::keep(StateReader& archive) {
  for (OutputFile* file : files()) keep_part(archive, *file);
}

}  // namespace carom
