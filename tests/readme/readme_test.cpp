// The pages against the program: their commands run, their printed output printed, their tables complete, their numbers
// measured.
#include <fmt/format.h>
#include <gtest/gtest.h>
#include <png.h>
#include <sys/wait.h>

#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <nlohmann/json.hpp>
#include <regex>
#include <sstream>

#include "bench/bench.h"
#include "engine/engine.h"
#include "export/run_charts.h"
#include "paths.h"
#include "physics/energy.h"
#include "physics/restitution.h"
#include "physics/world.h"
#include "readme/pages.h"
#include "scene/fields.h"
#include "scene/load.h"
#include "scene/scene.h"
#include "simulate/book.h"
#include "slow_with_sanitizers.h"
#include "std.h"

namespace carom::testing {
namespace {

namespace fs = std::filesystem;

bool is_of_the_program(const string& command) {
  return command.find("build/release/carom ") != string::npos || command.starts_with("./dev run ");
}

vector<string> lines_of(const string& text) {
  vector<string> lines;
  std::istringstream in(text);
  for (string line; std::getline(in, line);) lines.push_back(line);
  return lines;
}

/// Commands of a page, in order.
vector<string> commands(const Page& page) {
  vector<string> all;
  for (const string& block : page.blocks("sh"))
    for (const string& line : lines_of(block)) all.push_back(line);
  return all;
}

/// Whether `shown` is the start of `printed`, but that its last line may be "...".
bool shows(string shown, const string& printed) {
  if (shown.ends_with("\n...\n"))
    shown.resize(shown.size() - 4);
  else if (shown != printed)
    return false;
  return printed.starts_with(shown);
}

/// The root of a clone for the pages' commands: scenes/ is a copy, output/ is separate.
class Clone {
 public:
  Clone() {
    string pattern = (fs::temp_directory_path() / "carom-readme-XXXXXX").string();
    root_ = ::mkdtemp(pattern.data());
    fs::copy(SCENES_DIR, root_ / "scenes", fs::copy_options::recursive);
    fs::create_directories(root_ / "build/release");
    fs::create_symlink(CAROM_PROGRAM, root_ / "build/release/carom");
  }
  ~Clone() { fs::remove_all(root_); }
  fs::path operator/(const string& name) const { return root_ / name; }

  /// Runs a command of a page; `./dev run` is the program's run (./dev itself is run by tests/bare_debian.sh).
  int run(string command) const {
    if (command.starts_with("./dev run ")) command.replace(0, 6, "build/release/carom ");
    std::ofstream(root_ / "command") << command << "\n";
    command = "cd '" + root_.string() + "' && bash command > out 2> err < /dev/null";
    const int status = std::system(command.c_str());
    return WIFEXITED(status) ? WEXITSTATUS(status) : -1;
  }
  string out() const { return read_file(root_ / "out"); }
  string err() const { return read_file(root_ / "err"); }

 private:
  fs::path root_;
};

struct Pixels {
  png_image image{};
  vector<uint8_t> rgb;
};

Pixels read_png(const fs::path& path) {
  Pixels pixels;
  pixels.image.version = PNG_IMAGE_VERSION;
  if (!png_image_begin_read_from_file(&pixels.image, path.c_str())) return pixels;
  pixels.image.format = PNG_FORMAT_RGB;
  pixels.rgb.resize(PNG_IMAGE_SIZE(pixels.image));
  png_image_finish_read(&pixels.image, nullptr, pixels.rgb.data(), 0, nullptr);
  return pixels;
}

State run_to(const Scene& scene, double time) {
  const auto simulator = make_simulator(scene);
  while (simulator->time() < time) simulator->advance_to(time);
  return simulator->state();
}

Scene scene_of(const string& yaml) {
  string path = (fs::temp_directory_path() / "carom-readme-XXXXXX.yaml").string();
  close(mkstemps(path.data(), 5));
  std::ofstream(path) << yaml;
  Scene scene = load_scene(path);
  fs::remove(path);
  return scene;
}

nlohmann::json slips() {
  return nlohmann::json::parse(std::ifstream(DATA_DIR "/references/book_slips.json"));
}

/// Column names in the first line of a CSV file.
set<string> header_of(const fs::path& path) {
  const string text = read_file(path), line = text.substr(0, text.find('\n'));
  const std::regex name("[^,\r]+");
  return set<string>(std::sregex_token_iterator(line.begin(), line.end(), name), {});
}

/// Column names in the first cells of the table with this beginning.
set<string> columns_in(const Page& page, const string& head) {
  set<string> found;
  bool inside = false;
  for (const string& line : lines_of(page.text)) {
    inside = line == head || (inside && line.starts_with("|"));
    if (!inside || line == head) continue;
    const string cell = line.substr(1, line.find('|', 1) - 1);
    const std::regex name("[A-Za-z_]+");
    found.insert(std::sregex_token_iterator(cell.begin(), cell.end(), name), {});
  }
  return found;
}

/// A command adapted for the test: the longest pictures are smaller, and `man` need not be installed.
string shortened(string command) {
  if (command == "./dev run scenes/two_bowling_balls.yaml") command += " --set output.frames.size=[64,64]";
  if (command.ends_with(" --only video,flights")) command += " --set output.video.size=[64,64]";
  return command.substr(0, command.find(" | man "));
}

/// Runs the program's commands in a block of a page, and returns how many there are.
int run_commands(const Clone& clone, const Page& page, const PageBlock& block) {
  int run = 0;
  for (const string& command : lines_of(block.text)) {
    if (!is_of_the_program(command)) continue;
    EXPECT_EQ(clone.run(shortened(command)), 0) << page.path << ": " << command << "\n" << clone.err();
    ++run;
  }
  return run;
}

TEST(PageCommands, SucceedAndPrintWhatThePagesShow) {
  SLOW_WITH_SANITIZERS();
  const Clone clone;
  int run = 0, compared = 0, scripts = 0;

  for (const Page& page : pages()) {
    bool printed = false;  // by a command of this page
    for (const PageBlock& block : page.blocks()) {
      if (block.language == "sh") {
        const int commands = run_commands(clone, page, block);
        printed |= commands > 0;
        run += commands;

      } else if (block.language == "python") {
        EXPECT_EQ(clone.run("/usr/bin/python3 - << 'END'\n" + block.text + "END"), 0) << page.path << "\n"
                                                                                      << clone.err();
        printed = true;
        ++scripts;

      } else if (block.language == "text") {
        ASSERT_TRUE(printed) << page.path << " shows what no command has printed: " << block.text;
        EXPECT_TRUE(shows(block.text, clone.out())) << page.path << " shows\n" << block.text << "not\n" << clone.out();
        ++compared;
      }
    }
  }

  EXPECT_EQ(run, 34);
  EXPECT_EQ(scripts, 2);
  EXPECT_EQ(compared, 4);

  // What the commands have left.
  for (const char* file :
       {"two_bowling_balls/animation.mp4", "two_bowling_balls/frames/frame_00084.png",
        "two_bowling_balls/still_1.25s.png", "half/collisions.csv", "two_bowling_balls.sweep/summary.csv",
        "two_bowling_balls.sweep/comparison.xlsx", "two_bowling_balls.sweep/index.html", "pins/index.html",
        "two_bowling_balls.sweep/runs/r0006/energy.csv", "billiard_break/animation.mp4", "pi_by_collisions/energy.csv",
        "raindrops.bench/bench.svg", "gas_2/energy.csv", "gas/plots/speeds.png", "charts/plots/collisions.svg",
        "comparison/comparison.xlsx", "rest/bouncing_ball/trajectory.csv", "first.yaml", "scene.schema.json"}) {
    EXPECT_TRUE(fs::exists(clone / (string("output/") + file))) << file;
  }

  EXPECT_FALSE(fs::exists(clone / "output/two_bowling_balls.sweep/runs/r0007"));
  for (const char* file : {"scene.schema.json", "sweep.schema.json", "format.md"})
    EXPECT_EQ(read_file(clone / (string("scenes/") + file)), read_file(SCENES_DIR "/" + string(file)))
        << "scenes/" << file << " is not made anew";

  EXPECT_EQ(header_of(clone / "output/raindrops.bench/bench.csv"),
            columns_in(page_at("src/bench/README.md"), "| column of `bench.csv` | content |"));
}

TEST(PageCommands, OfDevAreThoseOfDev) {
  const string script = read_file(SOURCE_DIR "/dev"), usage = script.substr(0, script.find("\nEND\n"));
  const std::regex row("\\| `\\./dev (\\w+)"), line("\n  (\\w+)  *(\\[|[A-Z]|  )"), named("\\./dev ([a-z]\\w*)");
  const auto all = [](const string& text, const std::regex& what) {
    return set<string>(std::sregex_token_iterator(text.begin(), text.end(), what, 1), {});
  };

  const set<string> known = all(usage, line);
  EXPECT_EQ(all(page_at("tests/README.md").section("All commands of ./dev"), row), known);

  for (const Page& page : pages()) {
    string code;  // sh blocks, and text in backticks
    for (const string& block : page.blocks("sh")) code += block;

    const std::regex ticks("`[^`\n]+`");
    for (std::sregex_iterator i(page.text.begin(), page.text.end(), ticks), end; i != end; ++i) code += i->str();
    for (const string& command : all(code, named)) EXPECT_TRUE(known.contains(command)) << page.path << ": " << command;
  }
}

TEST(PageCommands, OfCmakeUsePresetsThatAreThere) {
  const auto presets = nlohmann::json::parse(std::ifstream(SOURCE_DIR "/CMakePresets.json"));
  const auto names = [&](const char* kind) {
    set<string> all;
    for (const auto& preset : presets[kind]) all.insert(preset["name"].get<string>());
    return all;
  };
  const auto all = commands(page_at("README.md"));
  EXPECT_TRUE(ranges::count(all, "cmake --preset release && cmake --build --preset release") == 1);
  EXPECT_TRUE(names("configurePresets").contains("release"));
  EXPECT_TRUE(names("buildPresets").contains("release"));
}

TEST(ReadmeFirstScene, IsTheFileWithoutItsComment) {
  string body;
  for (const string& line : lines_of(read_file(SCENES_DIR "/two_bowling_balls.yaml")))
    if (!line.starts_with('#')) body += line + "\n";
  EXPECT_EQ(page_at("README.md").blocks("yaml"), vector<string>{body});
}

TEST(ReadmeFirstScene, NumbersAreTheRuns) {
  const Scene scene = load_scene(SCENES_DIR "/two_bowling_balls.yaml");
  const auto simulator = make_simulator(scene, {.collisions = true});
  const double start = kinetic_energy(scene.world, simulator->state());
  simulator->advance_to(scene.simulate.duration);
  ASSERT_EQ(simulator->collisions().size(), 1u);
  EXPECT_EQ(simulator->collisions()[0].time, stated("(3 - 0.11 √2) / 2 = "));
  EXPECT_EQ(scene.world.mass[0], stated("Each ball of "));
  EXPECT_EQ(scene.world.impulse[1].norm(), stated("receives an impulse of "));
  EXPECT_EQ(scene.world.impulse[1].norm() / scene.world.mass[1], stated("at time 0 and leaves at "));
  EXPECT_NEAR(2 * scene.world.radius[0], stated("when their centres are "), 1e-16);
  EXPECT_NEAR(start, stated("The impulses supply "), 1e-13);
  EXPECT_NEAR(simulator->tally().energy_lost, stated("(1 - e²)/2 of that, "), 1e-13);
}

/// Loosely: another light or another edge may shift a shade, another scene may not.
void expect_alike(const Pixels& kept, const Pixels& drawn) {
  ASSERT_EQ(kept.image.width, drawn.image.width);
  ASSERT_EQ(kept.rgb.size(), drawn.rgb.size());
  size_t far_off = 0;
  for (size_t i = 0; i < kept.rgb.size(); ++i) far_off += std::abs(kept.rgb[i] - drawn.rgb[i]) > 24;
  EXPECT_LT(far_off, kept.rgb.size() / 100);  // measured: 0
}

TEST(Gallery, HasASmallPictureOfEachSceneAsItsCommandDrawsIt) {
  const string page = read_file(SCENES_DIR "/gallery.md");
  uintmax_t bytes = fs::file_size(SCENES_DIR "/billiard_break.png");
  for (const auto& entry : fs::directory_iterator(SCENES_DIR)) {
    if (entry.path().extension() != ".yaml") continue;
    const string name = entry.path().stem().string();
    EXPECT_NE(page.find("![" + name + "](gallery/" + name + ".png)"), string::npos) << name;
    bytes += fs::file_size(SCENES_DIR "/gallery/" + name + ".png");
  }
  EXPECT_LT(bytes, 1'500'000u);

  const Clone clone;
  fs::create_directory(clone / "tests");
  fs::copy(SOURCE_DIR "/tests/gallery.py", clone / "tests");
  ASSERT_EQ(clone.run("rm scenes/gallery/c*.png && tests/gallery.py build/release/carom clay comet"), 0) << clone.err();
  for (const char* name : {"clay", "comet"})
    expect_alike(read_png(string(SCENES_DIR "/gallery/") + name + ".png"),
                 read_png(clone / ("scenes/gallery/" + string(name) + ".png")));
}

TEST(ReadmePicture, IsWhatTheProgramDraws) {
  ASSERT_LT(fs::file_size(SCENES_DIR "/billiard_break.png"), 200'000u);
  const Clone clone;
  const auto all = commands(page_at("README.md"));
  const auto command = ranges::find_if(all, [](const auto& c) { return c.ends_with("-o output/picture"); });
  ASSERT_NE(command, all.end());
  ASSERT_EQ(clone.run(*command), 0) << clone.err();
  const Pixels kept = read_png(SCENES_DIR "/billiard_break.png");
  const Pixels drawn = read_png(clone / "output/picture/frames/frame_00012.png");  // 12 / 30 s = 0.4 s
  expect_alike(kept, drawn);
}

BenchResult bench(const string& scene, double longest, double shortest) {
  BenchOptions options;
  options.longest = longest;
  options.shortest = shortest;
  options.repeat = 1;
  options.budget = 1e6;
  return run_bench(load_scene(SCENES_DIR "/" + scene), options, {[] {}, [](double, const string&) {}});
}

// All except the times, which depend on the machine, to the given digits.
TEST(ReadmeBench, TableHasTheErrorsThatAreMeasured) {
  SLOW_WITH_SANITIZERS();
  const BenchResult result = bench("raindrops.yaml", 0x1p-4, 0x1p-10);
  const std::regex line(
      R"(\| (exact|euler|verlet|rk4) \| (?:1/(\d+) s)? ?\| \S+ ms \| (\S+) m \| (\S+) m/s \| (\S+) J \|)");

  int lines = 0;
  const string& text = page_at("src/bench/README.md").text;
  for (std::sregex_iterator i(text.begin(), text.end(), line), end; i != end; ++i, ++lines) {
    const string name = (*i)[1], per_second = (*i)[2];

    const auto row = ranges::find_if(result.rows, [&](const BenchRow& r) {
      if (r.method.engine == Engine::exact) return name == "exact";
      return name == name_of(r.method.integrator) &&
             per_second == to_string(std::lround(1 / r.method.steps.length.value_or(1e9)));
    });
    ASSERT_NE(row, result.rows.end()) << name << " 1/" << per_second;

    const Differences& errors = *row->errors;
    for (const auto& [stated, measured] :
         {pair((*i)[3], errors.position), pair((*i)[4], errors.velocity), pair((*i)[5], errors.energy)})
      EXPECT_NEAR(std::stod(stated), measured, 0.05 * measured) << name << " 1/" << per_second;
  }
  EXPECT_EQ(lines, 7);
}

TEST(ReadmeBench, DeviationsAreMeasured) {
  SLOW_WITH_SANITIZERS();
  const BenchResult result = bench("gas_in_a_room.yaml", 0x1p-4, 0x1p-4);
  ASSERT_TRUE(result.chaotic);
  EXPECT_NEAR(result.rows[1].deviation.value, stated("and steps of 1/16 s it is "), 0.05);
  EXPECT_NEAR(result.rows.back().deviation.value, stated("by the stepped engine and "), 5);
  EXPECT_NEAR(result.rows.back().statistics.collision_rate / result.mean.collision_rate, 0.25, 0.02);
}

TEST(ReadmeScenes, DescribeEveryKey) {
  string table;
  for (const char* page : {"README", "numbers", "motion", "pictures"})
    table += page_at(string("scenes/") + page + ".md").text;

  for (const Kind& kind : kinds()) {
    for (const Field& field : kind.fields) {
      const string name = "`" + string(field.key) + "`";
      EXPECT_NE(table.find(name), string::npos) << kind.name << "." << field.key;
      if (field.type != Type::choice || kind.name == "restitution") continue;
      for (const string_view choice : choices(field)) {
        EXPECT_NE(table.find(field.key == "samples" ? "`samples`" : "`" + string(choice) + "`"), string::npos)
            << field.key << ": " << choice;
      }
    }
  }
}

TEST(ReadmeScenes, TheExampleOfColoursAndTextIsAScene) {
  const vector<string> blocks = page_at("scenes/pictures.md").blocks("yaml");
  const auto block = ranges::find_if(blocks, [](const string& text) { return text.find("caption:") != string::npos; });
  ASSERT_NE(block, blocks.end());
  const Scene scene = scene_of("scene: 1\nsimulate: {duration: 1}\nballs: {red: {position: [0, 0, 0]}}\n" + *block);
  EXPECT_EQ(scene.overlay.caption, "{title}, t = {time} s, e = 1");
  EXPECT_EQ(scene.roster.bodies[0].coloring->by, ColorQuantity::speed);
}

TEST(ReadmeScenes, RulesOfRestitutionGiveTheTablesNumbers) {
  const map<string, Combine> rules = {{"| `average` (default) | ", Combine::average},
                                      {"| `minimum` | ", Combine::minimum},
                                      {"| `maximum` | ", Combine::maximum},
                                      {"| `product` | ", Combine::product},
                                      {"| `geometric_mean` | ", Combine::geometric_mean},
                                      {"here 1 kg and 3 kg | ", Combine::mass_weighted},
                                      {"| `book`, e1 e2 / 2 | ", Combine::book}};
  for (const auto& [row, rule] : rules)
    EXPECT_NEAR(combine_restitution(rule, 0.9, 1, 0.5, 3), stated(row), 1e-15) << row;
}

TEST(ReadmeFiles, HaveTheHeadersItShows) {
  const Clone clone;
  ASSERT_EQ(clone.run("./dev run scenes/two_bowling_balls.yaml --only trajectory,collisions,energy,sheet --set "
                      "output.sheet.columns=1"),
            0)
      << clone.err();

  const fs::path folder = clone / "output/two_bowling_balls";
  const Page& files = page_at("output/README.md");
  for (const auto& entry : fs::directory_iterator(folder)) {
    const string name = entry.path().filename().string();
    EXPECT_NE(files.text.find("`" + name + "`"), string::npos) << name;

    if (entry.path().extension() != ".csv" || name == "summary.csv") continue;
    const string text = read_file(entry.path());
    EXPECT_NE(files.text.find("| `" + name + "` | `" + text.substr(0, text.find('\n')) + "` |"), string::npos) << name;
  }

  EXPECT_EQ(header_of(folder / "summary.csv"), columns_in(files, "| columns of `summary.csv` | meaning |"));
}

TEST(ReadmeFiles, TheResolvedSceneGivesTheSameBytes) {
  const Clone clone;
  ASSERT_EQ(clone.run("./dev run scenes/billiard_break.yaml --only trajectory,collisions -o first"), 0);
  ASSERT_EQ(clone.run("./dev run first/scene.yaml --only trajectory,collisions -o second"), 0) << clone.err();
  for (const char* name : {"/trajectory.csv", "/collisions.csv"}) {
    EXPECT_EQ(read_file(clone / (string("first") + name)), read_file(clone / (string("second") + name)));
  }
}

TEST(ReadmeCharts, HaveTheLimitsOfTheProgram) {
  const string text = page_at("output/README.md").section("Charts of a run");
  for (const RunChart& chart : run_charts())
    EXPECT_NE(text.find("| `" + string(chart.name) + "` | "), string::npos) << chart.name;
  for (const string& stated :
       {fmt::format("SVG\nof {} x {} pixels", plot_width, plot_height),
        fmt::format("at most {} bodies", HeightsChart::most_lines),
        fmt::format("otherwise {} equal steps", plot_instants - 1), fmt::format("in {} columns", ThinnedLine::columns),
        fmt::format("fewer than {} bodies", SpeedsChart::least_bodies)})
    EXPECT_NE(text.find(stated), string::npos) << stated;
}

TEST(ReadmeOptions, AreThoseOfTheHelp) {
  const Clone clone;
  ASSERT_EQ(clone.run("build/release/carom run --help"), 0);
  const std::regex option("--[a-z]+");
  const auto all = [&](const string& text) {
    return set<string>(std::sregex_token_iterator(text.begin(), text.end(), option), {});
  };
  string rows;
  for (const string& line : lines_of(page_at("output/README.md").section("Options and exit codes")))
    if (line.starts_with("| `--")) rows += line + "\n";
  EXPECT_EQ(all(rows), all(clone.out()));
}

TEST(ReadmeExitCodes, AreWhatTheProgramGives) {
  const Clone clone;
  EXPECT_EQ(clone.run("./dev run scenes/billiard_break.yaml --only energy"), 0);
  EXPECT_EQ(clone.run("./dev run scenes/billiard_break.yaml --only energy"), 0) << "up to date";
  EXPECT_EQ(clone.run("./dev run scenes/billiard_break.yaml --only energy --set simulate.max_collisions=3 -o x"), 1);
  EXPECT_EQ(clone.run("./dev run scenes/billiard_break.yaml --only energy --set balls.white.mass=0 -o y"), 2);
  EXPECT_EQ(clone.run("./dev run scenes/bouncing_ball.yaml --only energy -o output/billiard_break"), 2)
      << "another's folder";
  EXPECT_EQ(clone.run("./dev run --nonsense"), 2);
}

TEST(ReadmeRules, ThreeTouchingBallsPartAtTheStatedVelocities) {
  const Scene scene = scene_of(R"(
scene: 1
gravity: [0, 0, 0]
defaults: {ball: {mass: 1, radius: 0.5, restitution: 0.5}}
balls:
  a: {position: [-1, 0, 0], velocity: [1, 0, 0]}
  b: {position: [0, 0, 0]}
  c: {position: [1, 0, 0], velocity: [-1, 0, 0]}
simulate: {duration: 0.001}
)");

  const State end = run_to(scene, scene.simulate.duration);
  EXPECT_EQ(end.velocity[0].x(), -0.5);
  EXPECT_EQ(end.velocity[1].x(), 0);
  EXPECT_EQ(end.velocity[2].x(), 0.5);
}

TEST(ReadmeRules, TheBouncingBallRestsAtTheStatedTime) {
  const Scene scene = load_scene(SCENES_DIR "/bouncing_ball.yaml");
  const double rest = 4.064406801766088;  // s, by the closed form
  const double still = scene.initial.position[0].y() - 1;
  EXPECT_GT(run_to(scene, rest - 0.01).position[0].y() - still, 1e-6);
  EXPECT_NEAR(run_to(scene, rest).position[0].y(), still, 1e-15);
}

TEST(ReadmeRules, ABallLeavesABallWhereItShould) {
  const Scene scene = scene_of(R"(
scene: 1
gravity: [0, -10, 0]
balls:
  ball: {mass: 1, radius: 0.1, position: [0.168, 0.576, 0], restitution: 0}
obstacles:
  globe: {radius: 0.5, position: [0, 0, 0]}
simulate: {duration: 0.5}
)");
  // It leaves at y = 2/3 of its first height, 0.384 m, with v^2 = 2 g (0.576 - 0.384), level with the tangent there.
  // From then on the path is a parabola: its vertex gives the start.
  const State end = run_to(scene, 0.5);
  const double g = 10, y0 = 0.384, x0 = sqrt(0.36 - y0 * y0), v = sqrt(2 * g * (0.576 - y0));
  const double vx = v * y0 / 0.6, vy = -v * x0 / 0.6;
  EXPECT_NEAR(end.velocity[0].x(), vx, 1e-8);
  const double t = (end.position[0].x() - x0) / vx;
  EXPECT_NEAR(end.position[0].y(), y0 + vy * t - g * t * t / 2, 1e-9);
}

TEST(ReadmeAccuracy, IsMeasured) {
  const Scene scene = load_scene(SCENES_DIR "/gas_in_a_room.yaml");
  const auto simulator = make_simulator(scene);
  while (simulator->time() < scene.simulate.duration) simulator->advance_to(scene.simulate.duration);

  EXPECT_EQ(scene.world.body_count(), 200u);
  EXPECT_EQ(simulator->tally().collisions(), 2771u);
  EXPECT_EQ(scene.simulate.duration, 6);

  const double energy = kinetic_energy(scene.world, scene.initial);
  EXPECT_LT(std::abs(kinetic_energy(scene.world, simulator->state()) / energy - 1), 1e-14);
  EXPECT_LT(simulator->tally().max_overlap / 0.1, 1e-14);

  const Scene pi = load_scene(SCENES_DIR "/pi_to_six_digits.yaml");
  const auto counter = make_simulator(pi);
  while (counter->time() < pi.simulate.duration) counter->advance_to(pi.simulate.duration);
  EXPECT_EQ(counter->tally().collisions(), 314159u);
}

TEST(ReadmeBook, ScenesGiveTheNumbersItNames) {
  const auto last = [](const char* file) {
    const Scene scene = load_scene(string(SCENES_DIR "/") + file);
    const auto simulator = make_simulator(scene, {.collisions = true});
    while (simulator->time() < scene.simulate.duration) simulator->advance_to(scene.simulate.duration);
    return pair(simulator->tally(), kinetic_energy(scene.world, simulator->state()));
  };

  const auto text = last("book_bowling_balls.yaml"), exact = last("two_bowling_balls.yaml"),
             printed = last("book_as_printed.yaml");
  EXPECT_NEAR(text.first.first_collision * 60, stated("collides in frame "), 1e-12);
  EXPECT_NEAR(text.first.first_collision - exact.first.first_collision, stated("in frame 86, "), 5e-7);
  EXPECT_NEAR(100 * text.first.max_overlap / 0.22, stated("late, overlapping by "), 0.05);
  EXPECT_NEAR(printed.second, stated("`scenes/book_as_printed.yaml` makes "), 1e-9);
  EXPECT_EQ(1 / BookOptions().step, stated("x += v dt, "));
}

TEST(ReadmeBook, TheSlipsTableIsTheReferences) {
  const auto table = slips()["closed_form_single_call"];

  const auto row = [](const string& start, const nlohmann::json& velocity, const nlohmann::json& energy) {
    std::ostringstream line;
    line.precision(10);
    line << " | " << velocity[0].get<double>() << ", " << velocity[1].get<double>() << " | " << energy.get<double>()
         << " |";

    const string words = one_line(page_at("src/simulate/README.md").section("The book's engine"));
    const size_t at = words.find(start);
    ASSERT_NE(at, string::npos) << start;
    EXPECT_NE(words.find(line.str(), at), string::npos) << start << line.str();
  };

  const auto& velocity = table["right_angle"];
  const auto& energy = table["KE_ratio"]["right_angle"];
  row("| exact", velocity["exact"], energy["exact"]);
  row("| slip 1", velocity["slip1"], energy["slip1"]);
  row("| slip 3", velocity["slip3B"], energy["slip3B"]);
  row("| slips 1 and 3", velocity["slip1_3B"], energy["slip1_3B"]);
  EXPECT_EQ(table["e_listing"].get<double>(), stated("slip 1: e = e1 e2 / 2 = "));
}

TEST(ReadmeBook, TheRadiusSlipsDistancesAndTheRepeatedHandlingAreTheReferences) {
  const nlohmann::json all = slips();
  const auto& radius = all["slip2_radius"];
  EXPECT_EQ(radius[1]["r0"].get<double>(), stated("Radii of "));
  EXPECT_EQ(radius[1]["r1"].get<double>(), stated("Radii of 0.11 and "));
  EXPECT_EQ(radius[1]["contact_distance_true"].get<double>(), stated("m touch at "));
  EXPECT_EQ(radius[1]["contact_distance_listing"].get<double>(), stated("but are seen at "));
  EXPECT_EQ(radius[2]["contact_distance_listing"].get<double>(), stated("exchanged at "));
  for (const auto& run : all["simulated"]) {
    if (run["scene"] != "head" || run["variant"] != "slips 1+3B+4") continue;
    EXPECT_NEAR(100 * run["fraction_multiple_calls"].get<double>(), stated("Head on, at 5 m/s, "), 1e-12);
  }
}

}  // namespace
}  // namespace carom::testing
