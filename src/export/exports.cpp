// Joins timelines, writers, frames, film and sheet for one run.
// Everything that can be refused is checked before the folder is changed.
// No file gets its final name until all bytes of all files are written. Then all are renamed together.
#include "export/exports.h"

#include <fmt/format.h>

#include <algorithm>
#include <optional>
#include <utility>

#include "export/film.h"
#include "export/frame_files.h"
#include "export/picture_streams.h"
#include "export/plot.h"
#include "export/png.h"
#include "export/sheet.h"
#include "export/tables.h"
#include "export/writer.h"
#include "files/manifest.h"
#include "files/mesh_copies.h"
#include "files/open_folder.h"
#include "files/processors.h"
#include "files/series_folders.h"
#include "scene/output_kinds.h"
#include "scene/scene.h"

namespace carom {
namespace {

/// Of frames. A picture of 1280 x 720 takes each 1 to 3 ms, less than its drawing, and each holds several in memory.
constexpr std::size_t most_encoders = 8;

/// The film's name is given by the scene and must not be another file's.
void check_film_name(const Scene& scene) {
  const Output& output = scene.output;
  if (!output.video) return;
  const std::string& name = output.video->file;
  if (is_reserved(name)) throw ExportError("cannot make the film " + name + ": another output has that name");
  if (!is_plain_name(name)) throw ExportError("cannot make the film " + name + ": that is no plain file name");
}

void append(std::vector<FileRecord>& to, const std::vector<FileRecord>& records) {
  to.insert(to.end(), records.begin(), records.end());
}

}  // namespace

struct Exports::Impl {
  struct OpenWriter {
    std::unique_ptr<Writer> writer;
    std::vector<int> timeline_streams;  // empty: it writes no states
  };

  // Refuse what can be refused here, before the folder is changed.
  Impl(const Scene& the_scene, const std::string& path, Durability durability, ModelMakers the_makers,
       const Manifest* renewed)
      : scene(the_scene), makers(std::move(the_makers)), timeline(end_of(the_scene)), plan(plan_pictures(the_scene)) {
    const Output& output = scene.output;
    check_film_name(scene);
    const std::vector<MeshCopy> meshes = read_meshes(scene);
    std::optional<FilmTools> tools;
    if (output.video) tools = find_film_tools();
    if (renewed != nullptr) kept = kept_files(*renewed);
    if (draws_plots()) find_gnuplot();

    folder.emplace(path, durability);
    first_records = renewed != nullptr ? folder->renew(scene, meshes) : folder->begin(scene, meshes);
    for (const OutputKind& kind : output_kinds()) {
      const WriterKind* writer = writer_named(kind.name);
      if (writer == nullptr || !kind.asked(output) || keeps(kind)) continue;
      OpenWriter& open = writers.emplace_back();
      if (kind.is_sampled()) open.timeline_streams = {timeline.add(Ticks::every(kind.every(output), end_of(scene)))};
      if (writer->ticks != nullptr)
        for (const Ticks& ticks : writer->ticks(scene)) open.timeline_streams.push_back(timeline.add(ticks));
      open.writer = writer->open(*folder, scene, makers);
    }
    if (output.frames) frames.emplace(*folder, std::min(share_of_processors(), most_encoders));
    if (output.video) film.emplace(folder->place(), *output.video, std::move(*tools));
    if (output.sheet) sheet.emplace(*output.sheet, sheet_model(scene).size);
    for (std::size_t i = 0; i < plan.streams.size(); ++i) plan.streams[i].timeline_stream = timeline.add(plan.ticks[i]);
  }

  /// The files of a former run that are not drawn and are still requested.
  std::vector<FileRecord> kept_files(const Manifest& run) const {
    std::vector<FileRecord> files;
    for (const FileRecord& file : run.files) {
      const OutputKind* kind = output_of(file.name);
      if (kind != nullptr && !is_picture(file.name) && kind->asked(scene.output)) files.push_back(file);
    }
    return files;
  }
  bool keeps(const OutputKind& kind) const {
    return std::any_of(kept.begin(), kept.end(), [&](const FileRecord& file) { return output_of(file.name) == &kind; });
  }
  bool draws_plots() const {
    return scene.output.plots &&
           std::none_of(output_kinds().begin(), output_kinds().end(),
                        [&](const OutputKind& kind) { return kind.series.folder == plot_files.folder && keeps(kind); });
  }

  bool due(const OpenWriter& open) const {
    return std::any_of(open.timeline_streams.begin(), open.timeline_streams.end(),
                       [&](int stream) { return timeline.due(stream).has_value(); });
  }

  const Scene& scene;
  const ModelMakers makers;
  Timeline timeline;
  PictureStreams plan;
  std::uint64_t pictures = 0;
  // Files of the former run that stay.
  std::vector<FileRecord> kept;
  // Files in the folder from the start.
  std::vector<FileRecord> first_records;
  // Declared before all that writes into it, so that it is destroyed last and can clean up.
  std::optional<OpenFolder> folder;
  std::optional<FrameFiles> frames;
  std::vector<OpenWriter> writers;
  std::optional<Film> film;
  std::optional<Sheet> sheet;
};

Exports::Exports(const Scene& scene, const std::string& folder, Durability durability, ModelMakers makers,
                 const Manifest* renewed)
    : impl_(std::make_unique<Impl>(scene, folder, durability, std::move(makers), renewed)) {}

Exports::~Exports() = default;

Timeline& Exports::timeline() {
  return impl_->timeline;
}

void Exports::end_at(double time) {
  impl_->timeline.end_at(time);
  for (const PictureStream& stream : impl_->plan.streams)
    if (impl_->timeline.is_empty(stream.timeline_stream))
      throw ExportError(fmt::format("cannot make pictures: the run ends at {} s, before the first of them", time));
}

bool Exports::needs_state() const {
  const auto& streams = impl_->plan.streams;
  return std::any_of(impl_->writers.begin(), impl_->writers.end(),
                     [&](const Impl::OpenWriter& open) { return impl_->due(open); }) ||
         std::any_of(streams.begin(), streams.end(), [&](const PictureStream& stream) {
           return impl_->timeline.due(stream.timeline_stream).has_value();
         });
}

bool Exports::needs_contacts() const {
  return std::any_of(impl_->writers.begin(), impl_->writers.end(),
                     [&](const Impl::OpenWriter& open) { return impl_->due(open) && open.writer->needs_contacts(); });
}

void Exports::record(std::span<const Collision> collisions) {
  for (const Impl::OpenWriter& open : impl_->writers) open.writer->record(collisions);
}

void Exports::record_paths(std::span<const PathPiece> pieces) {
  for (const Impl::OpenWriter& open : impl_->writers) open.writer->record_paths(pieces);
}

void Exports::record_crossings(std::span<const RegionCrossing> crossings) {
  for (const Impl::OpenWriter& open : impl_->writers) open.writer->record_crossings(crossings);
}

void Exports::sample(const State& state, std::span<const ContactForce> contacts) {
  const double time = impl_->timeline.time();
  for (const Impl::OpenWriter& open : impl_->writers)
    if (impl_->due(open)) open.writer->add(time, state, contacts);
}

const std::vector<PictureStream>& Exports::pictures() const {
  return impl_->plan.streams;
}

void Exports::picture(std::size_t stream, const Image& image, bool again) {
  const auto number = impl_->timeline.due(impl_->plan.streams.at(stream).timeline_stream);
  if (!number) return;
  const PictureUse& use = impl_->plan.uses[stream];
  if (use.frames) impl_->frames->put(*number, image, again);
  if (use.film) impl_->film->add(image);
  if (use.sheet) impl_->sheet->put(*number, image);
  impl_->pictures += use.frames || use.film;
}

std::uint64_t Exports::frames() const {
  return impl_->pictures;
}

std::vector<LeftOut> Exports::end(const Tally& tally) {
  std::vector<LeftOut> left_out;
  for (const Impl::OpenWriter& open : impl_->writers) {
    open.writer->end(tally);
    for (LeftOut& file : open.writer->left_out()) left_out.push_back(std::move(file));
  }
  return left_out;
}

void Exports::finish(const Summary& summary, const RunFacts& facts) {
  if (impl_->frames) impl_->frames->finish();
  const FilePlace& place = impl_->folder->place();
  // In the order of the files of a run that keeps none.
  std::vector<FileRecord> records = impl_->first_records;
  std::vector<OutputFile*> files;

  // Write all bytes of all files, including the manifest, under temporary names.
  OutputFile summary_file(place, "summary.csv");
  write_summary(summary_file, summary);
  files.push_back(&summary_file);
  for (const Impl::OpenWriter& open : impl_->writers)
    for (OutputFile* file : open.writer->files()) files.push_back(file);
  std::optional<OutputFile> sheet_file;
  if (impl_->sheet) {
    sheet_file.emplace(place, "sheet.png");
    sheet_file->write(encode_png(impl_->sheet->image()));
    files.push_back(&*sheet_file);
  }
  for (OutputFile* file : files) {
    file->complete();
    records.push_back(file->record());
    if (file == &summary_file) records.insert(records.end(), impl_->kept.begin(), impl_->kept.end());
  }
  if (impl_->film) {
    impl_->film->complete();
    records.push_back(impl_->film->record());
  }
  if (impl_->frames) append(records, impl_->frames->records());
  for (const Impl::OpenWriter& open : impl_->writers) append(records, open.writer->published());
  OutputFile manifest(place, manifest_name);
  manifest.write(manifest_text(impl_->scene, summary, facts, records));
  manifest.complete();

  std::vector<PartFile*> parts(files.begin(), files.end());
  if (impl_->film) parts.push_back(&impl_->film->file());
  impl_->folder->publish(std::move(parts), manifest);
}

}  // namespace carom
