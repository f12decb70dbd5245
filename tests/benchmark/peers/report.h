#pragma once
// The measurements as a table of all rows and as the tables of tests/README.md.
#include <string>
#include <vector>

#include "benchmark/peers/measure.h"

namespace carom {

/// One peer at one step on one case: `result` is the first run's, its CPU times the medians of all.
struct Row {
  const Peer* peer;
  const Case* what;
  int steps_per_s;  // 0: without steps
  int runs;
  Result result;
};

/// build/peers.csv and build/peers.md, each whole or not at all. Throws ExportError.
void write_report(const std::vector<Row>& rows);

/// The tables in Markdown.
std::string tables_of(const std::vector<Row>& rows);

}  // namespace carom
