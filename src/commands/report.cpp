// Text has rounded figures, and JSON all digits. The list of files is the manifest's, so that foreign files in the
// folder do not appear.
#include "commands/report.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <unistd.h>

#include "commands/error_list.h"
#include "commands/table_sizes.h"
#include "commands/text.h"
#include "files/folder_writer.h"
#include "files/manifest.h"
#include "files/series_folders.h"
#include "files/summary_columns.h"
#include "scene/output_kinds.h"
#include "std.h"
#include "version.h"
#include "yaml/letters.h"
#include "yaml/value_json.h"

namespace carom {

using Json = nlohmann::ordered_json;

namespace {

constexpr size_t label_width = 12;

optional<Manifest> manifest_in(const string& folder) {
  const Descriptor opened = open_folder(AT_FDCWD, folder, true);
  return opened ? read_manifest(opened.get(), manifest_name) : nullopt;
}

/// A file of the former run that drawing again in its own folder left untouched.
bool is_kept(const PlannedScene& planned, const string& file) {
  return planned.former && planned.former->folder == planned.folder && output_of(file) != nullptr &&
         !depends_on_look(file) && planned.former->has(file);
}

// "a.csv, b.csv and 60 pictures in frames/".
string written_files(const PlannedScene& planned) {
  vector<string> names;
  map<const OutputKind*, uint64_t> series;
  for (const string& file : files_in(planned.folder)) {
    if (is_kept(planned, file)) continue;
    if (const OutputKind* kind = output_with_series(file)) {
      ++series[kind];
    } else {
      names.push_back(printable(file));
    }
  }

  for (const OutputKind& kind : output_kinds()) {
    const FileSeries& files = kind.series;
    if (const uint64_t count = series[&kind]; count > 0)
      names.push_back(fmt::format("{} in {}/", counted(count, files.what, files.whats), files.folder));
  }
  return listed(names, names.size());
}

/// Contact in steps of crowds: how long, and with which errors.
string stepped_text(const Summary& summary, const Scene& scene) {
  const QualityLevel level = scene.simulate.contact.quality;
  const double overlap = quality_of(level).overlap;
  string text = fmt::format("{} of lasting contact, summed over bodies, in steps of crowds at `quality: {}`",
                            quantity(summary.stepped_contact, "s"), name_of(level));
  if (overlap > 0) text += fmt::format(", which may overlap by {:.0f} % of a radius", 100 * overlap);
  text += fmt::format(", {} made by errors", quantity(summary.contact.made, "J"));
  if (summary.contact.unsolved_steps > 0)
    text += fmt::format(", forces less accurate in {} of {}", grouped(summary.contact.unsolved_steps),
                        counted(summary.contact.crowd_steps, "step", "steps"));
  return text;
}

string collisions_text(const Summary& summary) {
  if (summary.collisions == 0) return "none";
  string text = fmt::format("{} ({} body-body, {} body-fixed", grouped(summary.collisions), grouped(summary.body_body),
                            grouped(summary.body_fixed));
  if (summary.contact.merges > 0) text += fmt::format(", {}", counted(summary.contact.merges, "merge", "merges"));
  if (summary.contact.tautened > 0) text += fmt::format(", {} by strings", grouped(summary.contact.tautened));
  text += ")";
  if (summary.collisions == 1) return text + fmt::format(", at {}", quantity(summary.first_collision, "s"));
  return text + fmt::format(", first at {}, last at {}", quantity(summary.first_collision, "s"),
                            quantity(summary.last_collision, "s"));
}

string contact_text(const Summary& summary) {
  string text = fmt::format("{} of {} in lasting contact at the end", grouped(summary.resting),
                            counted(summary.bodies, "body", "bodies"));
  if (summary.contact.collapses == 0) return text;
  return text + fmt::format("; {} of accelerating collisions turned into contact",
                            counted(summary.contact.collapses, "cluster", "clusters"));
}

string energy_text(const Summary& summary) {
  string text = summary.energy.lost == 0  ? "none lost"
                : summary.energy.lost > 0 ? quantity(summary.energy.lost, "J lost")
                                          : quantity(-summary.energy.lost, "J gained in collisions");
  text += fmt::format(", {} -> {}", quantity(summary.energy.start, "J"), quantity(summary.energy.end, "J"));
  if (summary.energy.work != 0) text += fmt::format(" with {} of work", quantity(summary.energy.work, "J"));
  return text + fmt::format(", residual {}", quantity(summary.energy.residual, "J"));
}

/// Impacts of one instant, whose outcome is the law's choice; empty: there were none.
string shared_text(const Summary& summary) {
  const SharedImpacts& shared = summary.contact.shared;
  if (shared.instants == 0) return {};
  string text = fmt::format("rigid bodies leave {} open with several impacts on a body, first {}",
                            counted(shared.instants, "instant", "instants"), summary.contact.first_shared);
  if (shared.ties > 0)
    text += fmt::format("; at {} they come from both sides at one speed, where the slightest difference decides",
                        grouped(shared.ties));
  return text;
}

string events_text(const Summary& summary) {
  string text;
  for (const auto& [name, time] : summary.contact.events)
    text += fmt::format("{}{} {}", text.empty() ? "" : "; ", printable(name),
                        std::isnan(time) ? "did not happen" : "at " + quantity(time, "s"));
  return text;
}

string work_text(const Summary& summary) {
  vector<string> each;
  for (const ForceWork& force : summary.energy.of_forces)
    each.push_back(fmt::format("{} of {}", quantity(force.work, "J"), force.force));
  return listed(each);
}

Json finite_or_null(double value) {
  return isfinite(value) ? Json(value == 0 ? 0.0 : value /* no -0 */) : Json(nullptr);
}

}  // namespace

Block::Block(const Options& options)
    : Block(Palette(uses_color(options.color, STDOUT_FILENO)), terminal_width(STDOUT_FILENO)) {}

void Block::heading(string_view name, string_view title) {
  text_ += fmt::format("{}{}{}", palette_.bold, printable(name), palette_.reset);
  if (!title.empty() && title != name) text_ += ": " + wrapped(printable(title), letters_of(name) + 2, width_);
  text_ += '\n';
}

void Block::line(string_view label, string_view text) {
  text_ += fmt::format("  {}{:{}}{}{}\n", palette_.dim, label, label_width, palette_.reset,
                       wrapped(text, label_width + 2, width_));
}

void Block::warning(string_view label, string_view text) {
  text_ += fmt::format("  {}{:{}}{}{}\n", palette_.yellow, label, label_width, palette_.reset,
                       wrapped(text, label_width + 2, width_));
}

void Block::table(const vector<vector<string>>& rows) {
  vector<size_t> widths(rows.front().size(), 0);
  for (const auto& row : rows)
    for (size_t k = 0; k < row.size(); ++k) widths[k] = max(widths[k], letters_of(row[k]));

  for (const auto& row : rows) {
    string line;
    for (size_t k = 0; k < row.size(); ++k) {
      const string gap(widths[k] - letters_of(row[k]), ' ');
      line += k == 0 ? row[k] + gap : "  " + gap + row[k];
    }
    line.erase(line.find_last_not_of(' ') + 1);
    const bool head = &row == &rows.front();
    text_ += fmt::format("  {}{}{}\n", head ? palette_.dim : "", line, head ? palette_.reset : "");
  }
}

vector<string> files_in(const string& folder) {
  vector<string> files;
  const optional<Manifest> manifest = manifest_in(folder);
  if (!manifest) return files;
  for (const FileRecord& record : manifest->files) files.push_back(record.name);
  files.push_back(manifest_name);
  ranges::sort(files);
  return files;
}

vector<Warning> warnings_in(const string& folder) {
  const optional<Manifest> manifest = manifest_in(folder);
  return manifest ? manifest->warnings : vector<Warning>();
}

void describe(Block& block, const vector<Warning>& warnings) {
  for (const Warning& warning : warnings) block.warning("doubtful", warning.text);
}

void describe_doubtful(Block& block, size_t runs) {
  if (runs > 0)
    block.warning("doubtful",
                  fmt::format("{}: see the column `status` of summary.csv, and the warnings in their manifests",
                              counted(runs, "run", "runs")));
}

void describe(Block& block, const PlannedScene& planned, const RunResult& result) {
  const Summary& summary = result.summary;
  const EngineChoice& engine = result.engine;
  const string_view name = name_of(engine.engine);
  block.line("engine", engine.why.empty() ? string(name) : fmt::format("{} ({})", name, engine.why));
  if (summary.ended_by != "duration")
    block.line("ended", fmt::format("at {}, by {}", quantity(summary.duration, "s"), summary.ended_by));

  // What happened: impacts, contact, and what regions took away.
  block.line("collisions", collisions_text(summary));
  block.line("contact", contact_text(summary));
  if (summary.stepped_contact > 0) block.line("stepped", stepped_text(summary, *planned.scene));
  if (const TakenUp& all = summary.contact.taken_up; all.impacts > 0)
    block.line("absorbed", fmt::format("{} by lasting contact, at {} at most, {} of the energy lost",
                                       counted(all.impacts, "impact", "impacts"), quantity(all.fastest, "m/s"),
                                       quantity(all.energy, "J")));

  if (const string text = shared_text(summary); !text.empty()) block.line("at once", text);
  if (const SharedImpacts& shared = summary.contact.shared; shared.without_room > 0)
    block.line("no room",
               fmt::format("bodies could not rebound at {}, and absorbed {}",
                           counted(shared.without_room, "instant", "instants"), quantity(shared.absorbed, "J")));
  if (!summary.contact.events.empty()) block.line("events", events_text(summary));
  if (summary.contact.appeared > 0)
    block.line("appeared",
               fmt::format("{} after the start, with {}", counted(summary.contact.appeared, "body", "bodies"),
                           quantity(summary.energy.appeared, "J")));
  if (summary.contact.removed > 0)
    block.line("removed", fmt::format("{} by regions, with {}", counted(summary.contact.removed, "body", "bodies"),
                                      quantity(summary.energy.removed, "J")));

  // How the energy balances, and what may be wrong.
  block.line("energy", energy_text(summary));
  if (!summary.energy.of_forces.empty()) block.line("work", work_text(summary));
  block.line("overlap", summary.max_overlap > 0 ? quantity(summary.max_overlap, "m at most") : "none");
  describe(block, summary.warnings);

  // Files and time.
  for (const LeftOut& file : result.facts.left_out)
    block.line("left out", fmt::format("{}: {}", printable(file.name), file.why));
  for (const string& text : large_tables(result.facts.tables, planned.scene->output, false))
    block.warning("large", text);
  block.line("wrote", fmt::format("{}: {}", printable(planned.folder), written_files(planned)));
  block.line("time", fmt::format("{}: load {}, simulate {}, draw {}, write {}",
                                 wait_text(result.facts.load_s + result.wall_s), wait_text(result.facts.load_s),
                                 wait_text(result.facts.simulate_s), wait_text(result.facts.render_s),
                                 wait_text(max(0.0, result.wall_s - result.facts.simulate_s - result.facts.render_s))));
}

Json summary_json(const Summary& summary) {
  Json json;
  // All but the run's name.
  for (const SummaryColumn& column : summary_columns().subspan(1)) {
    const auto value = column.value(summary);
    if (const auto* number = std::get_if<double>(&value))
      json[column.name] = finite_or_null(*number);
    else
      std::visit([&](auto given) { json[column.name] = given; }, value);
  }
  return json;
}

Json warnings_json(const vector<Warning>& warnings) {
  Json list = Json::array();
  for (const Warning& warning : warnings) list.push_back({{"code", warning.code}, {"text", warning.text}});
  return list;
}

Json events_json(const Summary& s) {
  Json json = Json::object();
  for (const auto& [name, time] : s.contact.events) json[name] = finite_or_null(time);
  return json;
}

Json work_json(const Summary& s) {
  Json json = Json::object();
  for (const ForceWork& force : s.energy.of_forces) json[force.force + "_J"] = finite_or_null(force.work);
  return json;
}

Json contact_json(const Summary& s) {
  return {{"resting", s.resting},
          {"clusters_taken_into_contact", s.contact.collapses},
          {"merges", s.contact.merges},
          {"impacts_taken_up",
           {{"impacts", s.contact.taken_up.impacts},
            {"fastest_m_per_s", s.contact.taken_up.fastest},
            {"energy_J", s.contact.taken_up.energy}}},
          // Several on one body.
          {"impacts_at_once",
           {{"instants", s.contact.shared.instants},
            {"ties", s.contact.shared.ties},
            {"first", s.contact.first_shared},
            {"without_room", s.contact.shared.without_room},
            {"absorbed_J", s.contact.shared.absorbed}}}};
}

Json times_json(const RunResult& result) {
  return {{"wall_s", result.wall_s},
          {"load_s", result.facts.load_s},
          {"simulate_s", result.facts.simulate_s},
          {"draw_s", result.facts.render_s},
          {"write_s", max(0.0, result.wall_s - result.facts.simulate_s - result.facts.render_s)},
          {"peak_memory_bytes", result.facts.peak_memory}};
}

string document(string_view command, Json members) {
  Json whole = {{"carom", program_version}, {"command", string(command)}};
  if (members.is_object())
    whole.update(members);
  else
    whole["scenes"] = std::move(members);
  // A file's name may hold any bytes.
  return text_of_json(whole, 2) + "\n";
}

int print_end(const Options& options, int code, Json members, string_view text) {
  if (options.json)
    write_out(document(options.command, std::move(members)));
  else if (!options.quiet)
    write_out(text);
  return code;
}

int print_refusal(const Options& options, string_view complaint, Json members, const vector<ErrorRecord>& errors) {
  complain(options, complaint);
  members["status"] = "wrong";
  members["errors"] = errors_json(errors);
  return print_end(options, 2, std::move(members));
}

void complain(const Options& options, string_view text) {
  const Palette palette(uses_color(options.color, STDERR_FILENO));
  write_err(fmt::format("{}carom:{} {}\n", palette.red, palette.reset, text));
}

void remark(const Options& options, string_view text) {
  if (options.quiet) return;
  const Palette palette(uses_color(options.color, STDERR_FILENO));
  write_err(fmt::format("{}carom:{} {}\n", palette.yellow, palette.reset, text));
}

}  // namespace carom
