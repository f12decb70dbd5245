#pragma once
// index.html: the page of a run, written when all its other files are complete.

#include "export/run_charts.h"
#include "export/writer.h"
#include "files/folder_writer.h"
#include "std.h"

namespace carom {

class ReportWriter final : public Writer {
 public:
  /// Throws ExportError, as all functions of this class do.
  ReportWriter(const FolderWriter& folder, const Scene& scene);
  void record(span<const Collision> collisions) override;
  void add(double time, const State& state, span<const ContactForce> contacts) override;
  vector<OutputFile*> files() override { return {}; }
  OutputFile* page(const Summary& summary, const RunFacts& facts, span<const FileRecord> files) override;

  void keep(StateWriter& archive) override { archive(charts_, first_); }
  void keep(StateReader& archive) override { archive(charts_, first_); }

 private:
  string text(const Summary& summary, const RunFacts& facts, span<const FileRecord> files) const;
  string first_collisions() const;

  const FolderWriter& folder_;
  const Scene& scene_;
  string gnuplot_;
  RunCharts charts_;
  vector<Collision> first_;  // collisions
  optional<OutputFile> file_;
};

}  // namespace carom
