// The schema is made from the table of fields at each call. A stored file could belong to another version.
#include "commands/commands.h"

#include <fmt/format.h>

#include "commands/option_table.h"
#include "commands/terminal.h"
#include "commands/text.h"
#include "scene/fields.h"
#include "scene/scene.h"
#include "scene/schema.h"
#include "std.h"
#include "yaml/diagnostics.h"

namespace carom {

namespace {

int print_schema(const Options& options) {
  const string name = options.operands.empty() ? "scene" : options.operands.front();
  vector<string> known;
  for (const auto family : families()) known.emplace_back(family.front().name);
  if (!contains(known, name)) {
    throw UsageError(fmt::format("no kind of file {}{}; the kinds are {}", in_backticks(name),
                                 did_you_mean(name, known), listed(known, known.size())));
  }
  write_out(json_schema(name));
  return 0;
}

}  // namespace

const Command schema_command = {
    "schema",
    print_schema,
    "prints the JSON Schema of scene files, for editors and other programs",
    "  carom schema > scene.schema.json                      beside a scene whose first line is\n"
    "                                                        # yaml-language-server: $schema=scene.schema.json\n"
    "  carom schema sweep > sweep.schema.json                the same for sweep files\n",
    "Draft-07, made from the loader's table of keys. Exit codes: 0 done, 2 the command line is wrong.",
    {},
    "KIND",
    "of files: scene (the default) or sweep",
    "",
    0,
    1};

}  // namespace carom
