#include "benchmark/peers/report.h"

#include <fcntl.h>
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <iterator>

#include "files/csv.h"
#include "files/folder_writer.h"
#include "physics/world.h"
#include "scene/scene.h"

namespace carom {
namespace {

const char* name_of(Outcome outcome) {
  switch (outcome) {
    case Outcome::done:
      return "done";
    case Outcome::stopped:
      return "stopped";
    case Outcome::beyond:
      return "beyond";
    case Outcome::failed:
      break;
  }
  return "failed";
}

/// carom's exact row of the same case: the first.
const Row& exact_of(const std::vector<Row>& rows, const Row& row) {
  for (const Row& other : rows)
    if (other.what == row.what) return other;
  return row;
}

void write_csv(OutputFile& file, const std::vector<Row>& rows) {
  CsvRow line(file);
  for (const char* head :
       {"peer",          "version",        "case",        "balls",        "step_s",           "outcome",
        "runs",          "reached_s",      "cpu_s",       "cpu_of_exact", "position_error_m", "velocity_error_m_per_s",
        "energy_error",  "overlap",        "end_overlap", "exchange",     "kinetic_J",        "cpu_until_2_s",
        "cpu_until_5_s", "cpu_until_10_s", "collisions",  "hash"})
    line.text(head);
  line.end();

  for (const Row& row : rows) {
    const Result& r = row.result;
    line.text(row.peer->name).text(row.peer->version).text(row.what->name).count(row.what->scene.world.mass.size());
    line.number(row.steps_per_s == 0 ? std::nan("") : 1.0 / row.steps_per_s).text(name_of(r.outcome));
    line.count(static_cast<std::uint64_t>(row.runs)).number(r.reached);

    if (r.reached > 0) {
      line.number(r.cpu).number(r.outcome == Outcome::done ? r.cpu / exact_of(rows, row).result.cpu : std::nan(""));
      for (double value : {r.position_error, r.velocity_error, r.energy_error, r.overlap, r.end_overlap, r.exchange,
                           r.kinetic, r.until[0], r.until[1], r.until[2]})
        line.number(value);
    } else {
      for (int k = 0; k < 12; ++k) line.text("");
    }

    if (r.collisions > 0)
      line.count(r.collisions).text(fmt::format("{:016x}", r.hash));
    else
      line.text("").text("");
    line.end();
  }
}

using Cell = std::function<std::string(const Result& result, const Result& exact)>;

struct Column {
  std::string what;  // the case
  std::string head;
  Cell cell;
};

Cell number(double Result::*value) {
  return [value](const Result& result, const Result&) { return fmt::format("{:.2g}", result.*value); };
}

/// Two significant digits, without long rows of zeros.
std::string plain(double value) {
  return value < 9.95 ? fmt::format("{:.2g}", value) : fmt::format("{:.0f}", value);
}

/// Of a radius.
std::string overlap(const Result& result, const Result&) {
  return plain(100 * result.overlap) + " %";
}

/// Of a run, and by the exact simulator's.
std::string cpu_time(const Result& result, const Result& exact) {
  const std::string time = result.cpu < 0.000995 ? plain(1e6 * result.cpu) + " µs"
                           : result.cpu < 0.995  ? plain(1e3 * result.cpu) + " ms"
                                                 : plain(result.cpu) + " s";
  return &result == &exact ? time : time + ", " + plain(result.cpu / exact.cpu) + "×";
}

std::string cpu_of_collision(const Result& result, const Result& exact) {
  return plain(1e6 * result.cpu / static_cast<double>(exact.collisions)) + " µs";
}

/// The row of this peer and case whose step is `steps_per_s`.
const Row* row_at(const std::vector<Row>& rows, const Peer* peer, const std::string& what, int steps_per_s) {
  for (const Row& row : rows)
    if (row.peer == peer && row.what->name == what && row.steps_per_s == steps_per_s) return &row;
  return nullptr;
}

/// A column's value for a peer at a step. A step that exceeded the budget is replaced by the finest one within it, if
/// that is finer than the usual one. The text then names the step.
std::string cell_of(const std::vector<Row>& rows, const Column& column, const Row& row) {
  const Peer& peer = *row.peer;
  const Row* shown = row_at(rows, row.peer, column.what, row.steps_per_s);
  const bool over_budget = shown->result.outcome == Outcome::stopped;

  std::string step;
  for (int finer : peer.steps_per_s) {
    const Row* other = row_at(rows, row.peer, column.what, finer);
    if (!over_budget || finer <= peer.usual || other->result.outcome != Outcome::done) continue;
    shown = other;
    step = fmt::format(" at 1/{}", finer);
  }

  if (shown->result.outcome == Outcome::stopped) return fmt::format("> {} s", shown->what->budget);
  if (shown->result.outcome != Outcome::done) return "–";
  return column.cell(shown->result, exact_of(rows, *shown).result) + step;
}

/// A table with those of the columns whose cases were measured; each peer at its usual step and at its finest.
std::string table(const std::vector<Row>& rows, const std::vector<Column>& columns) {
  std::vector<Column> there;
  std::copy_if(columns.begin(), columns.end(), std::back_inserter(there), [&](const Column& column) {
    return std::any_of(rows.begin(), rows.end(), [&](const Row& row) { return row.what->name == column.what; });
  });
  if (there.empty()) return "";

  std::string text = "| | step, s |", line = "| --- | --- |";
  for (const Column& column : there) {
    text += " " + column.head + " |";
    line += " --- |";
  }
  text += "\n" + line + "\n";

  for (const Row& row : rows) {
    if (row.what != rows.front().what) break;  // the other cases have the same peers and steps
    const Peer& peer = *row.peer;
    if (row.steps_per_s != peer.usual && row.steps_per_s != peer.steps_per_s.back()) continue;

    std::string cells;
    bool some = false;
    for (const Column& column : there) {
      const std::string cell = cell_of(rows, column, row);
      some = some || cell != "–";
      cells += " " + cell + " |";
    }

    if (!some) continue;
    text += fmt::format("| {} | {} |{}\n", peer.name, row.steps_per_s == 0 ? "–" : fmt::format("1/{}", row.steps_per_s),
                        cells);
  }
  return text;
}

}  // namespace

std::string tables_of(const std::vector<Row>& rows) {
  const Cell position = number(&Result::position_error);
  const std::string few = table(rows, {{"bounce", "bounces: error, m", position},
                                       {"bounce", "CPU", cpu_time},
                                       {"bounce_elastic", "with e = 1: error, m", position},
                                       {"cradle_gap", "row with gaps: error, m", position},
                                       {"cradle", "row that touches: error, m/s", number(&Result::velocity_error)},
                                       {"cradle", "CPU", cpu_time}});

  const std::string many = table(rows, {{"gas_1000", "gas: error, m", position},
                                        {"gas_1000", "overlap", overlap},
                                        {"gas_1000", "exchange", number(&Result::exchange)},
                                        {"gas_1000", "CPU a collision", cpu_of_collision},
                                        {"gas_10000", "of 10,000", cpu_of_collision},
                                        {"settling", "pile: overlap", overlap},
                                        {"settling", "J left", number(&Result::kinetic)},
                                        {"settling", "CPU", cpu_time}});

  return few.empty() || many.empty() ? few + many : few + "\n" + many;
}

void write_report(const std::vector<Row>& rows) {
  const Descriptor folder = open_folder(AT_FDCWD, "build", true);
  const FilePlace place{folder.get(), "build"};
  OutputFile csv(place, "peers.csv"), tables(place, "peers.md");
  write_csv(csv, rows);
  tables.write(tables_of(rows));
  for (OutputFile* file : {&csv, &tables}) {
    file->complete();
    file->publish();
  }
}

}  // namespace carom
