#pragma once
// carom bench: what accuracy costs, scene by scene, by every engine, integrator and step.
#include "commands/command_line.h"

namespace carom {

const CommandText& bench_text();
/// The program's exit code. Throws UsageError, Interrupted.
int bench_command(const Options& options);

}  // namespace carom
