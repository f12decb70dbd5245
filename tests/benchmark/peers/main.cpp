// carom side by side with other libraries on the same scenes: errors and CPU time, each at several steps. Each run has
// its own process; peers take turns in three rounds, and CPU times are medians.
//
//   carom_peers [CASE]    all cases or those whose names begin so: tests/README.md has the tables; build/peers.csv has
//   all rows
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <exception>

#include "benchmark/peers/report.h"

namespace carom {
namespace {

constexpr int rounds = 3;
constexpr double long_run = 1;  // s of CPU time: a longer run is measured once

/// Every case on every peer at every step.
std::vector<Row> rows_of(const std::vector<Peer>& peers, const std::vector<Case>& cases) {
  std::vector<Row> rows;
  for (const Case& what : cases)
    for (const Peer& peer : peers) {
      const std::vector<int> steps = peer.steps_per_s.empty() ? std::vector<int>{0} : peer.steps_per_s;
      for (int steps_per_s : steps) rows.push_back({&peer, &what, steps_per_s, 0, {}});
    }
  return rows;
}

double median(std::vector<double> values) {
  std::sort(values.begin(), values.end());
  return values[values.size() / 2];
}

/// Whether the peer's previous step, four times as long, used half of the budget.
bool is_hopeless(const std::vector<Row>& rows, std::size_t i) {
  if (i == 0 || rows[i - 1].peer != rows[i].peer || rows[i - 1].what != rows[i].what) return false;
  const Result& coarser = rows[i - 1].result;
  return coarser.outcome == Outcome::stopped || coarser.cpu > rows[i].what->budget / 2;
}

void measure_all(std::vector<Row>& rows) {
  std::vector<std::vector<double>> cpu(rows.size());
  for (int round = 0; round < rounds; ++round)
    for (std::size_t i = 0; i < rows.size(); ++i) {
      Row& row = rows[i];
      if (round > 0 && (row.result.outcome != Outcome::done || row.result.cpu > long_run)) continue;
      if (round == 0 && is_hopeless(rows, i)) {
        row.result.outcome = Outcome::stopped;
        continue;
      }

      const double step = row.steps_per_s == 0 ? row.what->sample_interval : 1.0 / row.steps_per_s;
      const Result result = measure(*row.peer, *row.what, step);
      if (round == 0) {
        row.result = result;
        if (result.reached > 0)
          fmt::print(stderr, "{}, {}, step 1/{} s: {:.3g} s of CPU\n", row.what->name, row.peer->name,
                     std::lround(1 / step), result.cpu);
      }

      cpu[i].push_back(result.cpu);
      row.result.cpu = median(cpu[i]);
      ++row.runs;
    }
}

int run(const std::string& name) {
  const std::vector<Case> cases = cases_named(name);
  if (cases.empty()) {
    fmt::print(stderr, "no case begins with \"{}\"\n", name);
    return 2;
  }

  std::vector<Peer> peers = all_peers();
  for (const Peer& peer : peers)
    if (peer.version.empty()) fmt::print(stderr, "{}: not installed\n", peer.name);
  std::erase_if(peers, [](const Peer& peer) { return peer.version.empty(); });

  std::vector<Row> rows = rows_of(peers, cases);
  measure_all(rows);
  write_report(rows);
  fmt::print("{}", tables_of(rows));
  return 0;
}

}  // namespace
}  // namespace carom

int main(int count, char** words) {
  try {
    return carom::run(count > 1 ? words[1] : "");
  } catch (const std::exception& error) {
    fmt::print(stderr, "{}\n", error.what());
    return 1;
  }
}
