// The rows of the table of fields for sweep files.
#include "scene/fields.h"
#include "std.h"

namespace carom {
namespace {

// clang-format off
constexpr Field grid{.key = "grid", .type = Type::axes, .of = "range", .doc = "Every combination of the values; the last path varies fastest.", .example = "{balls.red.mass: {from: 1, to: 2, count: 3}, balls.red.position.z: [-0.025, 0, 0.025]}"};
constexpr Field zip{.key = "zip", .type = Type::axes, .of = "range", .doc = "Values in step: as many for each path.", .example = "{balls.red.mass: [1, 2], balls.blue.mass: [2, 1]}"};
constexpr Field list{.key = "list", .type = Type::cases, .doc = "Combinations, listed one by one.", .example = "[{balls.red.mass: 1}, {balls.red.mass: 2, simulate.duration: 5}]"};
constexpr Field skip{.key = "skip", .type = Type::cases, .doc = "Runs to leave out: those with all values of an entry. A list of numbers or words matches any of them.", .example = "[{balls.red.mass: [1, 2], balls.blue.mass: 2}]"};
constexpr Field random{.key = "random", .type = Type::whole, .range = {1, 1e6}, .one_of = "random|latin", .doc = "So many runs, with a number drawn at random from each range of `over`.", .example = "100", .with = "over"};
constexpr Field latin{.key = "latin", .type = Type::whole, .range = {1, 1e6}, .one_of = "random|latin", .doc = "The same as a Latin hypercube: each range is divided into as many equal parts, and a number is drawn from each part.", .example = "50", .with = "over"};
constexpr Field over{.key = "over", .type = Type::spans, .of = "span", .spared_by = "latin", .doc = "The ranges that random or latin draws from.", .example = "{balls.red.mass: {from: 1, to: 2}, balls.red.position.z: {from: -0.1, to: 0.1}}", .with = "random"};

constexpr Field sweep_fields[] = {
    {.key = "sweep", .type = Type::whole, .range = {1, 1}, .needed = true, .doc = "Kind of file and version of the format.", .example = "1"},
    {.key = "title", .type = Type::text, .initial = "\"\"", .doc = "Title of the sweep, one line.", .example = "Masses"},
    {.key = "base", .type = Type::text, .needed = true, .doc = "The scene file to vary, relative to the folder of the sweep file.", .example = "two_bowling_balls.yaml"},
    {.key = "set", .type = Type::settings, .doc = "Values that differ from the base in every run.", .example = "{simulate.duration: 5}"},
    grid, zip, list, random, latin, over, skip,
    {.key = "runs", .type = Type::list, .of = "block", .doc = "A list of blocks, each with grid, zip, list, random, latin, over and skip of its own, instead of these keys.", .example = "[{grid: {balls.red.mass: [1, 2]}}, {list: [{balls.red.mass: 9}]}]", .needs_entries = true},
    {.key = "seed", .type = Type::whole, .range = {.min = 0}, .initial = "0", .doc = "The seed of what random and latin draw. It is not that of the scene.", .example = "1"},
    {.key = "skip_invalid", .type = Type::flag, .initial = "false", .doc = "Leaves out the runs whose scene is invalid, instead of refusing the sweep.", .example = "true"},
    {.key = "repeat", .type = Type::part, .of = "repeat", .doc = "Runs each combination several times, with other seeds.", .example = "{seeds: 10}"},
    {.key = "only", .type = Type::names, .of = "trajectory|collisions|energy|contacts|regions|frames|video|sheet|vtk|xyz|gltf|flights|plots", .doc = "The outputs to write. Default: those of the base.", .example = "[collisions, energy]"},
    {.key = "compare", .type = Type::part, .of = "compare", .doc = "What the comparison shows.", .example = "{measures: [energy_lost_J]}"},
};

constexpr Field block_fields[] = {
    grid, zip, list, random, latin, over, skip,
};

constexpr Field range_fields[] = {
    {.key = "from", .type = Type::number, .needed = true, .doc = "The first value.", .example = "0.5"},
    {.key = "to", .type = Type::number, .needed = true, .doc = "The last value; with step, no value lies beyond it.", .example = "1"},
    {.key = "count", .type = Type::whole, .range = {1, 1e6}, .one_of = "count|step", .needed = true, .doc = "Number of values, evenly spaced, both ends included.", .example = "6"},
    {.key = "step", .type = Type::number, .one_of = "count|step", .doc = "Difference between one value and the next.", .example = "0.1"},
};

constexpr Field span_fields[] = {
    {.key = "from", .type = Type::number, .needed = true, .doc = "The lower end.", .example = "1"},
    {.key = "to", .type = Type::number, .needed = true, .doc = "The upper end.", .example = "2"},
    {.key = "log", .type = Type::flag, .initial = "false", .doc = "Whether the logarithm is uniform, not the number.", .example = "true"},
};

constexpr Field repeat_fields[] = {
    {.key = "seeds", .type = Type::whole, .range = {1, 1e6}, .needed = true, .doc = "Number of consecutive seeds.", .example = "10"},
    {.key = "first", .type = Type::whole, .range = {.min = 0}, .doc = "The first seed. Default: the scene's.", .example = "1"},
};

constexpr Field compare_fields[] = {
    {.key = "measures", .type = Type::names, .doc = "Columns of summary.csv, and quantities of bodies at the end, such as balls.red.speed_m_per_s.", .example = "[energy_lost_J, balls.red.speed_m_per_s]"},
    {.key = "charts", .type = Type::list, .of = "chart", .doc = "Charts of the workbook. Default: each measure over the first path.", .example = "[{x: balls.red.mass, y: energy_lost_J}]"},
    {.key = "collisions", .type = Type::flag, .initial = "false", .doc = "Whether the workbook has a sheet with the first collisions of each run.", .example = "true"},
};

constexpr Field chart_fields[] = {
    {.key = "x", .type = Type::text, .needed = true, .doc = "A swept path, or a measure.", .example = "balls.red.mass"},
    {.key = "y", .type = Type::text, .needed = true, .doc = "A measure.", .example = "energy_lost_J"},
    {.key = "by", .type = Type::text, .doc = "A swept path: a line for each of its values.", .example = "balls.blue.mass"},
};
// clang-format on

constexpr Kind kinds_of_sweeps[] = {
    {"sweep", "the", "Many runs of one scene with other values.", sweep_fields},
    {"block", "a", "A block of runs with other values.", block_fields},
    {"range", "a", "Evenly spaced numbers, computed as decimals.", range_fields},
    {"span", "a", "A range to draw numbers from.", span_fields},
    {"repeat", "", "Repeats with other seeds.", repeat_fields},
    {"compare", "", "Measures and charts that summary.csv and the workbook have in addition.", compare_fields},
    {"chart", "a", "A chart of the workbook.", chart_fields},
};

}  // namespace

span<const Kind> sweep_rows() {
  return kinds_of_sweeps;
}

}  // namespace carom
