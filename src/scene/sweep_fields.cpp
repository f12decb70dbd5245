// The rows of the table of fields for sweep files.
#include "scene/fields.h"
#include "std.h"

namespace carom {
namespace {

// clang-format off
constexpr Field grid = row("grid", "Every combination of the values; the last path varies fastest.", "{balls.red.mass: {from: 1, to: 2, count: 3}, balls.red.position.z: [-0.025, 0, 0.025]}", {.type = Type::axes, .of = "range"});
constexpr Field zip = row("zip", "Values in step: as many for each path.", "{balls.red.mass: [1, 2], balls.blue.mass: [2, 1]}", {.type = Type::axes, .of = "range"});
constexpr Field list = row("list", "Combinations, listed one by one.", "[{balls.red.mass: 1}, {balls.red.mass: 2, simulate.duration: 5}]", {.type = Type::cases});
constexpr Field skip = row("skip", "Runs to leave out: those with all values of an entry. A list of numbers or words matches any of them.", "[{balls.red.mass: [1, 2], balls.blue.mass: 2}]", {.type = Type::cases});
constexpr Field random = row("random", "So many runs, with a number drawn at random from each range of `over`.", "100", {.type = Type::whole, .range = {1, 1e6}, .one_of = "random|latin", .with = "over"});
constexpr Field latin = row("latin", "The same as a Latin hypercube: each range is divided into as many equal parts, and a number is drawn from each part.", "50", {.type = Type::whole, .range = {1, 1e6}, .one_of = "random|latin", .with = "over"});
constexpr Field over = row("over", "The ranges that random or latin draws from.", "{balls.red.mass: {from: 1, to: 2}, balls.red.position.z: {from: -0.1, to: 0.1}}", {.type = Type::spans, .of = "span", .spared_by = "latin", .with = "random"});

constexpr Field sweep_fields[] = {
    row("sweep", "Kind of file and version of the format.", "1", {.type = Type::whole, .range = {1, 1}, .needed = true}),
    row("title", "Title of the sweep, one line.", "Masses", {.type = Type::text, .initial = "\"\""}),
    row("base", "The scene file to vary, relative to the folder of the sweep file.", "two_bowling_balls.yaml", {.type = Type::text, .needed = true}),
    row("set", "Values that differ from the base in every run.", "{simulate.duration: 5}", {.type = Type::settings}),
    grid, zip, list, random, latin, over, skip,
    row("runs", "A list of blocks, each with grid, zip, list, random, latin, over and skip of its own, instead of these keys.", "[{grid: {balls.red.mass: [1, 2]}}, {list: [{balls.red.mass: 9}]}]", {.type = Type::list, .of = "block"}),
    row("seed", "The seed of what random and latin draw. It is not that of the scene.", "1", {.type = Type::whole, .range = {.min = 0}, .initial = "0"}),
    row("skip_invalid", "Leaves out the runs whose scene is invalid, instead of refusing the sweep.", "true", {.type = Type::flag, .initial = "false"}),
    row("repeat", "Runs each combination several times, with other seeds.", "{seeds: 10}", {.type = Type::part, .of = "repeat"}),
    row("only", "The outputs to write. Default: those of the base.", "[collisions, energy]", {.type = Type::names, .of = "trajectory|collisions|energy|contacts|regions|frames|video|sheet|vtk|xyz|gltf|flights|plots|report"}),
    row("compare", "What the comparison shows.", "{measures: [energy_lost_J]}", {.type = Type::part, .of = "compare"}),
};

constexpr Field block_fields[] = {
    grid, zip, list, random, latin, over, skip,
};

constexpr Field range_fields[] = {
    row("from", "The first value.", "0.5", {.needed = true}),
    row("to", "The last value; with step, no value lies beyond it.", "1", {.needed = true}),
    row("count", "Number of values, evenly spaced, both ends included.", "6", {.type = Type::whole, .range = {1, 1e6}, .one_of = "count|step", .needed = true}),
    row("step", "Difference between one value and the next.", "0.1", {.one_of = "count|step"}),
};

constexpr Field span_fields[] = {
    row("from", "The lower end.", "1", {.needed = true}),
    row("to", "The upper end.", "2", {.needed = true}),
    row("log", "Whether the logarithm is uniform, not the number.", "true", {.type = Type::flag, .initial = "false"}),
};

constexpr Field repeat_fields[] = {
    row("seeds", "Number of consecutive seeds.", "10", {.type = Type::whole, .range = {1, 1e6}, .needed = true}),
    row("first", "The first seed. Default: the scene's.", "1", {.type = Type::whole, .range = {.min = 0}}),
};

constexpr Field compare_fields[] = {
    row("measures", "Columns of summary.csv, and quantities of bodies at the end, such as balls.red.speed_m_per_s.", "[energy_lost_J, balls.red.speed_m_per_s]", {.type = Type::names}),
    row("charts", "Charts of the workbook. Default: each measure over the first path.", "[{x: balls.red.mass, y: energy_lost_J}]", {.type = Type::list, .of = "chart"}),
    row("collisions", "Whether the workbook has a sheet with the first collisions of each run.", "true", {.type = Type::flag, .initial = "false"}),
};

constexpr Field chart_fields[] = {
    row("x", "A swept path, or a measure.", "balls.red.mass", {.type = Type::text, .needed = true}),
    row("y", "A measure.", "energy_lost_J", {.type = Type::text, .needed = true}),
    row("by", "A swept path: a line for each of its values.", "balls.blue.mass", {.type = Type::text}),
};
// clang-format on

constexpr Kind kinds_of_sweeps[] = {
    {"sweep", "the", "Many runs of one scene with other values.", sweep_fields},
    {"block", "a", "A block of runs with other values.", block_fields, nullptr, "", "", "", true},
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
