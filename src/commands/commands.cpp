// One row for each command. Dispatch, help, manual page and completion read this table.
#include "commands/commands.h"

#include "commands/bench.h"
#include "commands/check.h"
#include "commands/compare.h"
#include "commands/diff.h"
#include "commands/explain.h"
#include "commands/gather.h"
#include "commands/new.h"
#include "commands/plot.h"
#include "commands/render.h"
#include "commands/run.h"
#include "commands/schema.h"
#include "commands/submit.h"
#include "commands/sweep.h"
#include "std.h"

namespace carom {

const vector<Command>& commands() {
  static const vector<Command> all = {
      {run_text(), run_command},         {check_text(), check_command},   {sweep_text(), sweep_command},
      {gather_text(), gather_command},   {submit_text(), submit_command}, {compare_text(), compare_command},
      {diff_text(), diff_command},       {render_text(), render_command}, {plot_text(), plot_command},
      {bench_text(), bench_command},     {new_text(), new_command},       {schema_text(), schema_command},
      {explain_text(), explain_command},
  };
  return all;
}

}  // namespace carom
