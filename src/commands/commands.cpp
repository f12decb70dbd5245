// Dispatch, help, manual page and completion read this table.
#include "commands/commands.h"

#include "std.h"

namespace carom {

const vector<Command>& commands() {
  // Made at the first call, after main has begun: the commands are objects of other files.
  static const vector<Command> all = {run_command,     check_command,  sweep_command,  gather_command, submit_command,
                                      compare_command, diff_command,   render_command, plot_command,   bench_command,
                                      new_command,     schema_command, explain_command};
  return all;
}

}  // namespace carom
