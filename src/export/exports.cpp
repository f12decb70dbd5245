// Joins timelines, writers, frames, film and sheet for one run.
// Everything that can be refused is checked before the folder is changed.
// No file gets its final name until all bytes of all files are written. Then all are renamed together.
#include "export/exports.h"

#include <fmt/format.h>

#include "export/film.h"
#include "export/flights_file.h"
#include "export/frame_files.h"
#include "export/gnuplot.h"
#include "export/picture_streams.h"
#include "export/png.h"
#include "export/sheet.h"
#include "export/tables.h"
#include "export/tables_book.h"
#include "export/writer_kinds.h"
#include "files/folder_writer.h"
#include "files/manifest.h"
#include "files/mesh_copies.h"
#include "files/series_folders.h"
#include "files/stored_file.h"
#include "numerics/processors.h"
#include "scene/film_layout.h"
#include "scene/output_kinds.h"
#include "scene/scene.h"
#include "std.h"

namespace carom {
namespace {

/// Of frames. A picture of 1280 x 720 takes each 1 to 3 ms, less than its drawing, and each holds several in memory.
constexpr size_t most_encoders = 8;

/// The film's name is given by the scene and must not be another file's.
void check_film_name(const Scene& scene) {
  const Output& output = scene.output;
  if (!output.video) return;
  const string& name = output.video->file;
  if (is_reserved(name)) throw ExportError("cannot make the film " + name + ": another output has that name");
  if (!is_plain_name(name)) throw ExportError("cannot make the film " + name + ": that is no plain file name");
}

void append(vector<FileRecord>& to, const vector<FileRecord>& records) {
  to.insert(to.end(), records.begin(), records.end());
}

}  // namespace

struct Exports::Impl {
  // Refuse what can be refused here, before the folder is changed.
  Impl(const Scene& the_scene, const string& path, Durability durability, ModelMakers the_makers,
       const Manifest* renewed, function<string()> request)
      : scene(the_scene), makers(std::move(the_makers)), tables(end_of(the_scene)), plan(plan_pictures(the_scene)) {
    check_film_name(scene);
    const vector<MeshCopy> meshes = read_meshes(scene);
    if (scene.output.video) tools = find_film_tools();
    if (renewed != nullptr) kept = kept_files(*renewed);
    if (draws_charts()) find_gnuplot();

    folder.emplace(path, durability);
    if (request) find_interrupted(std::move(request));
    first_records = renewed != nullptr ? folder->renew(scene, meshes)
                    : interrupted      ? folder->go_on(scene, meshes)
                                       : folder->begin(scene, meshes);
    open_writers(tables, false);
  }

  void find_interrupted(function<string()> request) {
    checkpoint.emplace(folder->place(), std::move(request));
    interrupted = checkpoint->read();
    is_kept = interrupted.has_value();
    replaces_interrupted = !interrupted && has_checkpoint(folder->place());
  }

  /// Opens the writers that wait for the whole motion, or all others.
  void open_writers(OutputPart& part, bool waiting) {
    const span<const OutputKind> kinds = output_kinds();
    for (size_t i = 0; i < kinds.size(); ++i) {
      const WriterKind* writer = writer_to_open(kinds[i]);
      if (writer == nullptr || writer->waits_for_motion(scene) != waiting) continue;
      vector<Ticks> ticks;
      if (kinds[i].is_sampled()) ticks.push_back(Ticks::every(kinds[i].every(scene.output), end_of(scene)));
      if (writer->ticks != nullptr)
        for (const Ticks& some : writer->ticks(scene)) ticks.push_back(some);
      part.add(i, writer->open(*folder, scene, makers), ticks);
    }
  }

  /// Null: the output is not requested, is kept, or has no writer.
  const WriterKind* writer_to_open(const OutputKind& kind) const {
    return kind.asked(scene.output) && !keeps(kind) ? writer_named(kind.name) : nullptr;
  }

  bool waits() const {
    return any_of(output_kinds(), [&](const OutputKind& kind) {
      const WriterKind* writer = writer_to_open(kind);
      return writer != nullptr && writer->waits_for_motion(scene);
    });
  }

  void open_pictures() {
    const Output& output = scene.output;
    plan = plan_pictures(scene);
    if (output.frames) frames.emplace(*folder, min(share_of_processors(), most_encoders));
    if (output.video) film.emplace(folder->place(), *output.video, std::move(*tools));
    if (output.sheet) sheet.emplace(*output.sheet, sheet_model(scene).size);
    for (size_t i = 0; i < plan.streams.size(); ++i) {
      plan.streams[i].timeline_stream = drawings->timeline().add(plan.ticks[i]);
      if (!plan.uses[i].film || !output.video->sound) continue;
      const double lead = double(title_pictures(*output.video)) / output.video->fps;
      film->open_sound(scene.world, clock_of(scene, *output.video), lead,
                       lead + double(plan.ticks[i].count()) / output.video->fps);
    }
  }

  /// The files of a former run that are not drawn and are still requested.
  vector<FileRecord> kept_files(const Manifest& run) const {
    vector<FileRecord> files;
    for (const FileRecord& file : run.files) {
      const OutputKind* kind = output_of(file.name);
      if (kind != nullptr && !depends_on_look(file.name) && kind->asked(scene.output)) files.push_back(file);
    }
    return files;
  }
  bool keeps(const OutputKind& kind) const {
    return any_of(kept, [&](const FileRecord& file) { return output_of(file.name) == &kind; });
  }
  bool draws_charts() const {
    return any_of(output_kinds(), [&](const OutputKind& kind) {
      const bool has_charts = kind.series.folder == plot_files.folder || kind.has_file(page_name);
      return has_charts && kind.asked(scene.output) && !keeps(kind);
    });
  }

  /// Null: the scene requests none. `written`: the complete files, under their temporary names.
  unique_ptr<OutputFile> write_workbook(const vector<OutputFile*>& written) const {
    const FilePlace& place = folder->place();
    return write_tables_workbook(place, scene.output.tables, scene.title, [&](const string& name) {
      const auto has_name = [&](const auto& record) { return record.name == name; };
      if (any_of(written, [&](const OutputFile* file) { return has_name(file->record()); }))
        return open_stored(place.folder, part_name(name));
      return any_of(kept, has_name) ? open_stored(place.folder, name) : Descriptor();
    });
  }

  /// The writers of both parts, in the order of the kinds of outputs.
  vector<Writer*> writers() const {
    vector<const OutputPart::OpenWriter*> open;
    for (const OutputPart::OpenWriter& writer : tables.writers()) open.push_back(&writer);
    if (drawings)
      for (const OutputPart::OpenWriter& writer : drawings->writers()) open.push_back(&writer);
    ranges::sort(open, {}, [](const auto* writer) { return writer->kind; });
    vector<Writer*> writers;
    for (const OutputPart::OpenWriter* writer : open) writers.push_back(writer->writer.get());
    return writers;
  }

  const Scene& scene;
  const ModelMakers makers;
  // Files of the former run that stay.
  vector<FileRecord> kept;
  // Files in the folder from the start.
  vector<FileRecord> first_records;
  // Declared before all that writes into it, so that it is destroyed last and can clean up.
  optional<FolderWriter> folder;
  optional<CheckpointFile> checkpoint;
  optional<Checkpoint> interrupted;
  bool is_kept = false;
  bool replaces_interrupted = false;
  OutputPart tables;
  optional<OutputPart> drawings;
  PictureStreams plan;
  optional<FilmTools> tools;
  std::atomic<uint64_t> pictures = 0;
  optional<FrameFiles> frames;
  optional<Film> film;
  optional<Sheet> sheet;
};

Exports::Exports(const Scene& scene, const string& folder, Durability durability, ModelMakers makers,
                 const Manifest* renewed, function<string()> request)
    : impl_(make_unique<Impl>(scene, folder, durability, std::move(makers), renewed, std::move(request))) {}

Exports::~Exports() = default;

bool Exports::goes_on() const {
  return impl_->interrupted.has_value();
}

Checkpoint Exports::take_interrupted() {
  return exchange(*impl_->interrupted, {});
}

bool Exports::replaces_interrupted() const {
  return impl_->replaces_interrupted;
}

void Exports::keep(Checkpoint checkpoint) {
  impl_->checkpoint->write(std::move(checkpoint));
  impl_->is_kept = true;
}

bool Exports::is_kept() const {
  return impl_->is_kept;
}

void Exports::forget() {
  if (is_kept()) impl_->checkpoint->remove();
  impl_->is_kept = false;
}

OutputPart& Exports::tables() {
  return impl_->tables;
}

FlightsFile* Exports::flights() {
  for (const OutputPart::OpenWriter& open : impl_->tables.writers())
    if (auto* file = dynamic_cast<FlightsFile*>(open.writer.get())) return file;
  return nullptr;
}

const FilePlace& Exports::place() const {
  return impl_->folder->place();
}

bool Exports::draws() const {
  return impl_->scene.output.pictures() || impl_->waits();
}

void Exports::begin_drawings() {
  impl_->drawings.emplace(end_of(impl_->scene));
  impl_->open_writers(*impl_->drawings, true);
  impl_->open_pictures();
}

OutputPart& Exports::drawings() {
  return *impl_->drawings;
}

void Exports::end_drawings_at(double time) {
  Timeline& timeline = impl_->drawings->timeline();
  timeline.end_at(time);
  for (const PictureStream& stream : impl_->plan.streams)
    if (timeline.is_empty(stream.timeline_stream))
      throw ExportError(fmt::format("cannot make pictures: the run ends at {} s, before the first of them", time));
}

const vector<PictureStream>& Exports::pictures() const {
  return impl_->plan.streams;
}

void Exports::record_drawings(span<const Collision> collisions, span<const PathPiece> pieces) {
  impl_->drawings->record(collisions);
  impl_->drawings->record_paths(pieces);
  if (!impl_->film) return;
  impl_->film->record(collisions);
  impl_->film->record_paths(pieces);
}

void Exports::picture(size_t stream, const Image& image, bool again) {
  const auto number = impl_->drawings->timeline().due(impl_->plan.streams.at(stream).timeline_stream);
  if (!number) return;
  const PictureUse& use = impl_->plan.uses[stream];
  if (use.frames) impl_->frames->put(*number, image, again);
  if (use.film) impl_->film->add(image);
  if (use.sheet) impl_->sheet->put(*number, image);
  impl_->pictures += use.frames || use.film;
}

bool Exports::begins_with_title(size_t stream) const {
  return impl_->plan.uses[stream].film && impl_->film->frames() == 0 && impl_->scene.output.video->title;
}

void Exports::title_picture(const Image& image) {
  impl_->film->add(image);
  ++impl_->pictures;
}

uint64_t Exports::frames() const {
  return impl_->pictures;
}

uint64_t Exports::planned_frames() const {
  uint64_t planned = 0;
  for (size_t i = 0; i < impl_->plan.uses.size(); ++i)
    if (impl_->plan.uses[i].frames || impl_->plan.uses[i].film) planned += uint64_t(impl_->plan.ticks[i].count());
  return planned;
}

vector<TableSize> Exports::table_sizes() const {
  vector<TableSize> sizes;
  for (const Writer* writer : impl_->writers())
    if (const optional<TableSize> size = writer->size()) sizes.push_back(*size);
  return sizes;
}

vector<LeftOut> Exports::left_out() const {
  vector<LeftOut> left_out;
  for (const Writer* writer : impl_->writers())
    for (LeftOut& file : writer->left_out()) left_out.push_back(std::move(file));
  return left_out;
}

void Exports::finish(const Summary& summary, const RunFacts& facts) {
  if (impl_->frames) impl_->frames->finish();
  const FilePlace& place = impl_->folder->place();
  // In the order of the files of a run that keeps none.
  vector<FileRecord> records = impl_->first_records;
  vector<OutputFile*> files;

  // Write all bytes of all files, including the manifest, under temporary names.
  OutputFile summary_file(place, "summary.csv", CsvDialect(impl_->scene.output.tables));
  write_summary(summary_file, summary);
  files.push_back(&summary_file);

  const vector<Writer*> writers = impl_->writers();
  for (Writer* writer : writers)
    for (OutputFile* file : writer->files()) files.push_back(file);

  optional<OutputFile> sheet_file;
  if (impl_->sheet) {
    sheet_file.emplace(place, "sheet.png");
    sheet_file->write(encode_png(impl_->sheet->image()));
    files.push_back(&*sheet_file);
  }

  // The records of all that is complete.
  for (OutputFile* file : files) {
    file->complete();
    records.push_back(file->record());
    if (file == &summary_file) records.insert(records.end(), impl_->kept.begin(), impl_->kept.end());
  }

  const unique_ptr<OutputFile> workbook = impl_->write_workbook(files);
  if (workbook) {
    files.push_back(workbook.get());
    records.push_back(workbook->record());
  }

  if (impl_->film) {
    impl_->film->complete();
    records.push_back(impl_->film->record());
  }
  if (impl_->frames) append(records, impl_->frames->records());
  for (const Writer* writer : writers) append(records, writer->published());

  for (Writer* writer : writers) {
    OutputFile* page = writer->page(summary, facts, records);
    if (page == nullptr) continue;
    page->complete();
    records.push_back(page->record());
    files.push_back(page);
  }

  OutputFile manifest(place, manifest_name);
  manifest.write(manifest_text(impl_->scene, summary, facts, records));
  manifest.complete();

  vector<PartFile*> parts(files.begin(), files.end());
  if (impl_->film) parts.push_back(&impl_->film->file());
  impl_->folder->publish(std::move(parts), manifest);
}

}  // namespace carom
