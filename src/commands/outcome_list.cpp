// Text is printed at once, so that a long command shows its results. JSON is printed at the end, since it is one
// document.
#include "commands/outcome_list.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "commands/report.h"
#include "commands/text.h"
#include "std.h"
#include "yaml/joined.h"

namespace carom {

void OutcomeList::add(SceneOutcome outcome) {
  ++counts_[outcome.status];
  if (!outcome.complaint.empty()) complain(options_, outcome.complaint);
  entries_.push_back(std::move(outcome.entry));
  if (options_.json || options_.quiet || outcome.out.empty()) return;
  write_out(outcome.out);
  flush_out();
}

void OutcomeList::end(double wall) {
  print_end(options_, 0, entries_, entries_.size() > 1 ? total(wall) : "");
}

string OutcomeList::total(double wall) {
  vector<string> parts;
  size_t rest = entries_.size();
  for (const char* status :
       {scene_status::done, scene_status::up_to_date, scene_status::failed, scene_status::not_run}) {
    if (counts_[status] > 0) parts.push_back(fmt::format("{} {}", counts_[status], status));
    rest -= counts_[status];
  }
  if (rest > 0) parts.push_back(fmt::format("{} not finished", rest));
  return fmt::format("{} scenes: {}, in {}\n", entries_.size(), joined(parts, ", "), wait_text(wall));
}

}  // namespace carom
