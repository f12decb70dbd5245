// carom compare and carom diff, by the real program.
#include <gtest/gtest.h>
#include <signal.h>

#include <nlohmann/json.hpp>
#include <regex>
#include <sstream>

#include "commands/program.h"
#include "paths.h"
#include "slow_with_sanitizers.h"
#include "std.h"

namespace carom::testing {
namespace {

using Json = nlohmann::json;

/// Runs a, b and c that differ in the red ball's restitution.
void make_runs(const Workplace& here, const string& more = tables) {
  here.write("balls.yaml", two_balls(more));
  for (const auto& [name, e] : {pair("a", "0.5"), pair("b", "0.75"), pair("c", "1")})
    ASSERT_EQ(here.carom({"run", "balls.yaml", "-o", string("runs/") + name, "--set",
                          string("balls.red.restitution=") + e, "-q"})
                  .code,
              0);
}

TEST(CompareCommand, FindsWhatVariedAndWritesTableWorkbookAndManifest) {
  const Workplace here;
  make_runs(here);
  const Finished run = here.carom({"compare", "runs/a", "runs/b", "runs/c", "--measures", "balls.red.speed_m_per_s"});
  ASSERT_EQ(run.code, 0) << run.err;
  EXPECT_EQ(run.err, "");
  EXPECT_EQ(run.out,
            "Comparison of a, b and c\n"
            "  runs        3\n"
            "  varied      balls.red.restitution\n"
            "  measures    balls.red.speed_m_per_s\n"
            "  found       balls.red.speed_m_per_s from 1.4 (a) to 1.9 (c)\n"
            "  wrote       output/comparison: comparison.xlsx, index.html, manifest.json and summary.csv\n");

  const auto files = here.files("output/comparison");
  ASSERT_EQ(files.size(), 4u);

  const string& table = files.at("summary.csv");
  EXPECT_NE(
      table.find(",resting,frames,stepped_contact_s,removed_J,ended_by,energy_absorbed_J,contact_made_J,appeared_J,"
                 "balls.red.restitution,balls.red.speed_m_"
                 "per_s\na,Two balls,exact,done,1,"),
      string::npos)
      << table;
  EXPECT_NE(table.find("\nc,"), string::npos);
  EXPECT_TRUE(files.at("comparison.xlsx").starts_with("PK"));

  const Json manifest = Json::parse(files.at("manifest.json"));
  EXPECT_EQ(manifest["files"].size(), 3u);
}

TEST(CompareCommand, ListsNumbersOfLetAndNotWhatFollowsFromThem) {
  const Workplace here;
  here.write("ramp.yaml", R"(scene: 1
let: {tilt: 20, r: 0.1, n: 3, height: '= 2 * r'}
defaults: {ball: {radius: = r, mass: 1}}
balls:
  row: {repeat: = n, position: ['= -3 * i * r * cos(tilt)', '= 3 * i * r * sin(tilt) + height', 0]}
  red: {radius: 0.05, position: [0, 3, 0]}
planes: {ramp: {point: [0, 0, 0], normal: ['= sin(tilt)', '= cos(tilt)', 0]}}
simulate: {duration: 0.1}
output: {collisions: true}
)");

  const auto run = [&](const string& name, const string& set) {
    ASSERT_EQ(here.carom({"run", "ramp.yaml", "-o", "runs/" + name, "--set", set, "-q"}).code, 0);
  };
  run("a", "let.tilt=20");
  run("b", "let.tilt=30");
  run("c", "let.r=0.08");
  run("d", "let.n=5");
  run("e", "balls.row.position.z=1");
  run("f", "balls.red.radius=0.06");

  const auto varied = [&](const vector<string>& runs) {
    vector<string> words = {"compare", "--force"};
    for (const string& name : runs) words.push_back("runs/" + name);
    const string out = here.carom(words).out;
    const size_t at = out.find("varied      ");
    return at == string::npos ? out : out.substr(at + 12, out.find('\n', at) - at - 12);
  };

  EXPECT_EQ(varied({"a", "b"}), "let.tilt");
  EXPECT_EQ(varied({"a", "b", "c", "d"}), "let.tilt, let.r and let.n");
  // A value that no expression made is listed, also beside an expression of the defaults.
  EXPECT_EQ(varied({"a", "e"}), "balls.row.0.position.z, balls.row.1.position.z and balls.row.2.position.z");
  EXPECT_EQ(varied({"a", "f"}), "balls.red.radius");
}

TEST(CompareCommand, IsUpToDateUntilARunOrTheRequestChanges) {
  const Workplace here;
  make_runs(here);
  const vector<string> words = {"compare", "runs/a", "runs/b"};
  ASSERT_EQ(here.carom(words).code, 0);
  const auto before = here.files("output");

  EXPECT_EQ(here.carom(words).out, "output/comparison: up to date\n");
  EXPECT_EQ(here.carom({"compare", "runs/a", "runs/b", "--force"}).code, 0);
  EXPECT_EQ(here.files("output"), before) << "the same bytes";

  // Another request.
  ASSERT_EQ(here.carom({"compare", "runs/a", "runs/b", "--measures", "collisions"}).code, 0);
  EXPECT_NE(here.files("output"), before);

  // A file that is missing.
  ASSERT_EQ(here.carom(words).code, 0);
  here.shell("rm output/comparison/summary.csv");
  EXPECT_NE(here.carom(words).out.find("wrote"), string::npos);
  EXPECT_EQ(here.files("output"), before);
}

TEST(CompareCommand, OverwritesNothingElse) {
  const Workplace here;
  make_runs(here);
  const auto before = here.files("runs");
  const Finished refused = here.carom({"compare", "runs/a", "runs/b", "-o", "runs/c"});
  EXPECT_EQ(refused.code, 2);
  EXPECT_NE(refused.err.find("the folder runs/c holds something else\n  write elsewhere with -o"), string::npos);
  EXPECT_EQ(here.carom({"compare", "runs/a", "runs/b", "-o", "runs/../runs/b", "--force"}).code, 2);
  here.write("mine/notes.txt", "mine");
  EXPECT_EQ(here.carom({"compare", "runs/a", "runs/b", "-o", "mine"}).code, 2);
  EXPECT_EQ(here.files("runs"), before);
  EXPECT_EQ(here.carom({"compare", "runs/a", "runs/b"}).code, 0);
  EXPECT_EQ(here.carom({"run", "balls.yaml", "-o", "output/comparison"}).code, 2);
}

TEST(CompareCommand, TakesASweepsRunsAndNamesRunsApart) {
  const Workplace here;
  make_runs(here);
  ASSERT_EQ(here.shell("mkdir -p one two && cp -r runs one/runs && cp -r runs two/runs").code, 0);
  ASSERT_EQ(here.carom({"compare", "one", "two", "runs/a", "--json"}).code, 0);
  const string table = here.read("output/comparison/summary.csv");
  for (const char* id : {"\none/a,", "\none/b,", "\ntwo/c,"}) EXPECT_NE(table.find(id), string::npos) << table;
}

TEST(CompareCommand, OfASweepGivesTheSweepsTable) {
  const Workplace here;
  here.write("balls.yaml", two_balls(tables));
  here.write("sweep.yaml",
             "sweep: 1\nbase: balls.yaml\ngrid: {balls.red.restitution: [0.5, 1], balls.blue.position.z: [0, 0.1]}\n"
             "repeat: {seeds: 2}\ncompare: {measures: [energy_lost_J, balls.red.speed_m_per_s]}\n");
  const Finished sweep = here.carom({"sweep", "sweep.yaml", "-o", "swept"});
  ASSERT_EQ(sweep.code, 0) << sweep.err;
  const Finished run = here.carom({"compare", "swept"});
  ASSERT_EQ(run.code, 0) << run.err;
  for (const char* file : {"summary.csv", "repeats.csv", "comparison.xlsx"})
    EXPECT_EQ(here.read(string("output/comparison/") + file), here.read(string("swept/") + file)) << file;
  // The page's links to the runs are relative.
  const string page = here.read("output/comparison/index.html");
  EXPECT_NE(page.find("\"../../swept/runs/r0001/\""), string::npos);
  EXPECT_EQ(std::regex_replace(page, std::regex("\\.\\./\\.\\./swept/"), ""), here.read("swept/index.html"));
}

TEST(CompareCommand, TakesASweepsRunsInTheOrderOfTheirNumbers) {
  const Workplace here;
  make_runs(here);
  ASSERT_EQ(
      here.shell("mkdir -p one/runs && for n in r9999 r10000 r0010 r002 last; do cp -r runs/a one/runs/$n; done").code,
      0);
  ASSERT_EQ(here.carom({"compare", "one"}).code, 0);
  std::istringstream rows(here.read("output/comparison/summary.csv"));
  string ids;
  for (string row; std::getline(rows, row);) ids += row.substr(0, row.find(',') + 1);
  EXPECT_EQ(ids, "run,last,r002,r0010,r9999,r10000,");
}

TEST(CompareCommand, TakesRunsThatDifferInTheSeedAsRepeats) {
  const Workplace here;
  here.write("gas.yaml",
             "scene: 1\ngravity: [0, 0, 0]\nroom: {min: [-1, -1, -1], max: [1, 1, 1]}\n"
             "groups: {gas: {count: 4, ball: {mass: 1, radius: 0.1}, in: {min: [-1, -1, -1], max: [1, 1, 1]}, speed: "
             "1}}\nsimulate: {duration: 0.5}\noutput: {collisions: true}\n");
  for (const char* seed : {"1", "2", "3"})
    ASSERT_EQ(here.carom({"run", "gas.yaml", "--seed", seed, "-o", string("gas/") + seed, "-q"}).code, 0);
  ASSERT_EQ(here.carom({"compare", "gas/1", "gas/2", "gas/3"}).code, 0);
  EXPECT_TRUE(here.read("output/comparison/repeats.csv").starts_with("n,energy_lost_J.mean,energy_lost_J.sd,"));
  ASSERT_EQ(here.carom({"compare", "gas/1"}).code, 0);
  EXPECT_FALSE(here.has("output/comparison/repeats.csv")) << "of the former comparison";
}

TEST(CompareCommand, ReportsErrorsOfFoldersAndWords) {
  const Workplace here;
  make_runs(here);
  here.write("no/run.txt", "");

  const auto error = [&](const vector<string>& words) {
    vector<string> line = {"compare", "runs/a"};
    line.insert(line.end(), words.begin(), words.end());
    const Finished run = here.carom(line);
    EXPECT_EQ(run.code, 2) << run.err;
    EXPECT_EQ(run.out, "");
    EXPECT_FALSE(here.has("output"));
    return run.err;
  };

  EXPECT_EQ(error({"no", "nowhere"}),
            "carom: no: it holds no whole run: run its scene again\n"
            "  nowhere: there is no such folder\n");
  EXPECT_EQ(error({"runs/b", "--measures", "energy_lost"}),
            "carom: no measure `energy_lost`; did you mean `energy_lost_J`?\n");
  EXPECT_EQ(error({"--measures", "balls.rde.x_m"}),
            "carom: `balls.rde.x_m`: balls has no `rde`; did you mean `red`?\n");
  EXPECT_NE(
      error({"runs/b", "--charts", "balls.red.restitutio:collisions"}).find("did you mean `balls.red.restitution`"),
      string::npos);
  EXPECT_NE(error({"--charts", "collisions"}).find("--charts takes x:y or x:y:by"), string::npos);
  EXPECT_EQ(error({"runs/b", "--video"}),
            "carom: runs/a has no film: run its scene again with the output `video` (--only video)\n");

  EXPECT_EQ(here.carom({"compare"}).code, 2);
  here.write("runs/b/collisions.csv", "cut");
  EXPECT_EQ(error({"runs/b"}), "carom: runs/b: collisions.csv has changed since the run: run its scene again\n");
}

TEST(CompareCommand, JsonHasTheSameContent) {
  const Workplace here;
  make_runs(here);
  const Json done = Json::parse(here.carom({"compare", "runs/a", "runs/b", "--json"}).out);
  EXPECT_EQ(done["command"], "compare");
  EXPECT_EQ(done["status"], "done");
  EXPECT_EQ(done["runs"], 2);
  EXPECT_EQ(done["parameters"], Json({"balls.red.restitution"}));
  EXPECT_EQ(done["files"], Json({"comparison.xlsx", "index.html", "manifest.json", "summary.csv"}));
  EXPECT_EQ(Json::parse(here.carom({"compare", "runs/a", "runs/b", "--json"}).out)["status"], "up to date");
}

TEST(CompareCommand, FilmShowsRunsSideBySideAndInStep) {
  SLOW_WITH_SANITIZERS();
  const Workplace here;
  here.write("balls.yaml", two_balls("camera: {eye: [0, 3, -5], target: [0, 0, 0]}\n"
                                     "output: {video: {fps: 10, size: [64, 48]}}\n"));
  ASSERT_EQ(here.carom({"run", "balls.yaml", "-q", "-o", "runs/first"}).code, 0);
  ASSERT_EQ(here.carom({"run", "balls.yaml", "-q", "-o", "runs/longer", "--set", "simulate.duration=1.5"}).code, 0);
  ASSERT_EQ(here.carom({"run", "balls.yaml", "-q", "-o", "runs/other", "--set", "output.video.fps=20", "--set",
                        "output.video.size=[32, 48]", "--set", "output.video.from=0.5"})
                .code,
            0);
  const vector<string> words = {"compare", "runs/first", "runs/longer", "runs/other", "--video"};

  const Finished run = here.carom(words);
  ASSERT_EQ(run.code, 0) << run.err;
  const Finished probe = here.shell(
      "ffprobe -v error -count_packets -show_entries stream=width,height,r_frame_rate,nb_read_packets -of csv=p=0 "
      "output/comparison/comparison.mp4");
  EXPECT_EQ(probe.out, "128,156,20/1,32\n")
      << "1.5 s and the frame of 0, twice as often; three tiles of 64 x 48 in a square, two lines of 8 "
         "pixels and their margins above each";

  // The same bytes again.
  const string film = here.read("output/comparison/comparison.mp4");
  ASSERT_EQ(here.carom({"compare", "runs/first", "runs/longer", "runs/other", "--video", "--force"}).code, 0);
  EXPECT_EQ(here.read("output/comparison/comparison.mp4"), film);

  // A comparison without a film removes it.
  ASSERT_EQ(here.carom({"compare", "runs/first", "runs/longer"}).code, 0);
  EXPECT_FALSE(here.has("output/comparison/comparison.mp4"));
}

TEST(CompareCommand, FilmsThatSlowDownAreOutOfStep) {
  const Workplace here;
  here.write("balls.yaml", two_balls("camera: {eye: [0, 3, -5], target: [0, 0, 0]}\n"
                                     "output: {video: {fps: 10, size: [64, 48], slow: auto, sound: true}}\n"));
  ASSERT_EQ(here.carom({"run", "balls.yaml", "-q", "-o", "runs/first"}).code, 0);
  ASSERT_EQ(here.carom({"run", "balls.yaml", "-q", "-o", "runs/second", "--set", "simulate.duration=1.5"}).code, 0);
  const Finished refused = here.carom({"compare", "runs/first", "runs/second", "--video"});
  EXPECT_EQ(refused.code, 2);
  EXPECT_EQ(refused.err,
            "carom: runs/first has a film that slows down around a collision, out of step with the others: draw it at "
            "an even speed (carom render runs/first --set output.video.slow=none)\n");

  for (const string run : {"runs/first", "runs/second"})
    ASSERT_EQ(here.carom({"render", run, "-q", "--set", "output.video.slow=none"}).code, 0);
  EXPECT_EQ(here.carom({"compare", "runs/first", "runs/second", "--video"}).code, 0);
}

// A caption is at the top left of a film, where a label on the film would be too.
TEST(CompareCommand, LabelsOfTheFilmStandAboveTheFilms) {
  const Workplace here;
  here.write("balls.yaml", two_balls("camera: {eye: [0, 3, -5], target: [0, 0, 0]}\ncaption: \"WWWWWW\"\n"
                                     "output: {video: {fps: 10, size: [320, 240], crf: 1}}\n"));
  ASSERT_EQ(here.carom({"run", "balls.yaml", "-q", "-o", "runs/first"}).code, 0);
  ASSERT_EQ(here.carom({"run", "balls.yaml", "-q", "-o", "runs/second"}).code, 0);

  // A font in a folder with characters that have a meaning in ffmpeg's filter graphs.
  ASSERT_EQ(here.shell("mkdir -p \"a [b], 'c;/fonts\" && cp \"$(find /usr/share/fonts /usr/local/share/fonts -name "
                       "DejaVuSans.ttf 2>/dev/null | head -n 1)\" \"a [b], 'c;/fonts\"")
                .code,
            0);

  const Finished run = here.shell(
      "XDG_DATA_HOME= HOME= XDG_DATA_DIRS=\"$PWD/a [b], 'c;\" $CAROM compare runs/first runs/second --video");
  ASSERT_EQ(run.code, 0) << run.err;

  // One line of 10 pixels, two margins of 5 above and below.
  constexpr int strip = 24;
  const auto grey = [&](const string& film, const string& cut) {
    return here
        .shell("ffmpeg -v error -i " + film + " -vf crop=" + cut + " -frames:v 1 -f rawvideo -pix_fmt gray pipe:1")
        .out;
  };

  const string compared = grey("output/comparison/comparison.mp4", "320:240:0:" + to_string(strip));
  const string own = grey("runs/first/animation.mp4", "320:240:0:0");
  ASSERT_EQ(compared.size(), 320u * 240);
  ASSERT_EQ(own.size(), compared.size());

  int most = 0;
  for (size_t i = 0; i < own.size(); ++i)
    most = std::max(most, std::abs(static_cast<unsigned char>(compared[i]) - static_cast<unsigned char>(own[i])));
  EXPECT_LT(most, 60) << "the film below its label is unchanged, but for the second encoding";

  const string label = grey("output/comparison/comparison.mp4", "320:" + to_string(strip) + ":0:0");
  const auto letters = ranges::count_if(label, [](char c) { return (c & 0x80) != 0; });
  EXPECT_GT(letters, 20) << "the run's name in white";
  EXPECT_EQ(
      here.shell("XDG_DATA_HOME= HOME= XDG_DATA_DIRS=$PWD $CAROM compare runs/first runs/second --video -o other").err,
      "carom: the text of a film needs the typeface DejaVu Sans, and no folder of fonts has DejaVuSans.ttf\n"
      "  install it (on Debian: apt install fonts-dejavu-core), or leave --video out\n");
}

// The first ball goes 1 m, the other one 4 m: by cameras of their own the first would be larger.
TEST(CompareCommand, FilmsThatFrameTheirMotionsHaveOneCamera) {
  SLOW_WITH_SANITIZERS();
  const Workplace here;
  here.write("ball.yaml",
             "scene: 1\ntitle: A ball\nsimulate: {duration: 1}\ngravity: [0, 0, 0]\nbackground: black\n"
             "balls: {red: {mass: 1, radius: 0.2, position: [0, 0, 0], velocity: [1, 0, 0], color: white}}\n"
             "output: {video: {fps: 4, size: [160, 90], crf: 1, title: true}}\n");
  ASSERT_EQ(here.carom({"run", "ball.yaml", "-q", "-o", "runs/near"}).code, 0);
  ASSERT_EQ(here.carom({"run", "ball.yaml", "-q", "-o", "runs/far", "--set", "balls.red.velocity.x=4"}).code, 0);
  const Finished run = here.carom({"compare", "runs/near", "runs/far", "--video"});
  ASSERT_EQ(run.code, 0) << run.err;
  EXPECT_EQ(here.files("output/comparison").size(), 5u) << "nothing but the comparison is left";

  // 1 s at 4 pictures a second, without the title cards.
  EXPECT_EQ(here.shell("ffprobe -v error -count_packets -show_entries stream=width,nb_read_packets -of csv=p=0 "
                       "output/comparison/comparison.mp4")
                .out,
            "320,5\n");

  // The numbers of light pixels in the two pictures of time 0, and in those of the runs' own films.
  const auto light = [&](const string& film, const string& filter) {
    const string grey =
        here.shell("ffmpeg -v error -i " + film + " -vf '" + filter + "' -frames:v 1 -f rawvideo -pix_fmt gray pipe:1")
            .out;
    return double(ranges::count_if(grey, [](char c) { return static_cast<unsigned char>(c) > 120; }));
  };
  const string film = "output/comparison/comparison.mp4";
  const double near = light(film, "crop=160:90:0:ih-90"), far = light(film, "crop=160:90:160:ih-90");
  EXPECT_GT(near, 20);
  EXPECT_NEAR(near, far, 0.15 * far);
  EXPECT_GT(light("runs/near/animation.mp4", "select=gte(n\\,8)"), 2 * near);
}

TEST(CompareCommand, FilmOfSlowMotionStaysInStep) {
  const Workplace here;
  here.write("balls.yaml", two_balls("camera: {eye: [0, 3, -5], target: [0, 0, 0]}\n"
                                     "output: {video: {fps: 10, size: [64, 48], speed: 0.5}}\n"));
  ASSERT_EQ(here.carom({"run", "balls.yaml", "-q", "-o", "runs/first"}).code, 0);
  ASSERT_EQ(here.carom({"run", "balls.yaml", "-q", "-o", "runs/later", "--set", "output.video.from=0.5"}).code, 0);
  const Finished run = here.carom({"compare", "runs/first", "runs/later", "--video"});
  ASSERT_EQ(run.code, 0) << run.err;
  EXPECT_EQ(here.shell("ffprobe -v error -count_packets -show_entries stream=r_frame_rate,nb_read_packets -of csv=p=0 "
                       "output/comparison/comparison.mp4")
                .out,
            "10/1,21\n")
      << "1 s of motion in 2 s, for both";
}

TEST(CompareCommand, FilmMixesGifsAndNamesTheRemedyForOthers) {
  const Workplace here;
  here.write("balls.yaml", two_balls("camera: {eye: [0, 3, -5], target: [0, 0, 0]}\n"
                                     "output: {video: {fps: 10, size: [64, 48]}}\n"));
  const auto make = [&](const string& folder, const string& setting) {
    ASSERT_EQ(here.carom({"run", "balls.yaml", "-q", "-o", folder, "--set", setting}).code, 0);
  };
  make("runs/first", "output.video.fps=10");
  make("runs/gif", "output.video.file=film.gif");
  make("runs/webp", "output.video.file=film.webp");
  make("runs/slow", "output.video.speed=0.5");

  const Finished run = here.carom({"compare", "runs/first", "runs/gif", "--video"});
  ASSERT_EQ(run.code, 0) << run.err;
  EXPECT_EQ(here.shell("ffprobe -v error -count_packets -show_entries stream=width,nb_read_packets -of csv=p=0 "
                       "output/comparison/comparison.mp4")
                .out,
            "128,11\n");
  EXPECT_EQ(here.carom({"compare", "runs/first", "runs/webp", "--video", "--force"}).err,
            "carom: runs/webp has a film that ffmpeg cannot read, film.webp: draw it as .mp4 (carom render runs/webp "
            "--set output.video.file=animation.mp4)\n");
  EXPECT_EQ(here.carom({"compare", "runs/first", "runs/slow", "--video", "--force"}).err,
            "carom: the films of runs/first and runs/slow have the speeds 1 and 0.5: draw one of them again (carom "
            "render runs/slow --set output.video.speed=1)\n");
}

// A sweep would refuse runs that were drawn again in their own folders.
TEST(CompareCommand, RemedyForTheFilmsOfASweepWorksAndLeavesTheSweepAsItIs) {
  const Workplace here;
  here.write("balls.yaml", two_balls("camera: {eye: [0, 3, -5], target: [0, 0, 0]}\n"
                                     "output: {video: {file: film.webp, fps: 4, size: [64, 48]}}\n"));
  here.write("pair.yaml", "sweep: 1\nbase: balls.yaml\ngrid: {balls.red.restitution: [0.5, 1]}\n");
  ASSERT_EQ(here.carom({"sweep", "pair.yaml", "-o", "pair", "-q"}).code, 0);

  EXPECT_EQ(here.carom({"compare", "pair", "--video"}).err,
            "carom: pair/runs/r0001 has a film that ffmpeg cannot read, film.webp: draw it as .mp4 (carom render "
            "pair/runs/* -o OTHER --set output.video.file=animation.mp4, then carom compare OTHER/* --video)\n");

  const Finished remedy = here.shell(
      "$CAROM render pair/runs/* -o OTHER -q --set output.video.file=animation.mp4 && $CAROM compare OTHER/* --video");
  EXPECT_EQ(remedy.code, 0) << remedy.err;
  EXPECT_TRUE(here.has("output/comparison/comparison.mp4"));
  EXPECT_NE(here.carom({"sweep", "pair.yaml", "-o", "pair"}).out.find("up to date"), string::npos);
}

TEST(CompareCommand, FilmOfTooManyRunsIsRefused) {
  const Workplace here;
  make_runs(here);
  vector<string> words = {"compare", "--video"};
  for (int i = 0; i < 17; ++i) words.push_back("runs/a");
  const Finished run = here.carom(words);
  EXPECT_EQ(run.code, 2);
  EXPECT_NE(run.err.find("a film shows at most 16 runs side by side, not 17"), string::npos) << run.err;
}

TEST(DiffCommand, ReportsWhereRunsPartAndHowFarApartTheyEnd) {
  const Workplace here;
  make_runs(here);
  ASSERT_EQ(here.carom({"run", "balls.yaml", "-q", "-o", "runs/aside", "--set", "balls.red.position.x=-1.5"}).code, 0);

  const Finished outcome = here.carom({"diff", "runs/a", "runs/b"});
  EXPECT_EQ(outcome.code, 0) << outcome.err;
  EXPECT_EQ(outcome.out,
            "a and b\n"
            "  scenes      1 value differs\n"
            "                             a     b\n"
            "    balls.red.restitution  0.5  0.75\n"
            "  collisions  1, the same in both\n"
            "  outcome     collision 1, red and blue at 0.44499999999999995 s (body-body), differs: they leave at\n"
            "              2.8 m/s in a, 3.3 m/s in b\n"
            "  end         at most 0.13875000000000004 m apart: red\n");

  // The same speeds with another impulse.
  ASSERT_EQ(here.shell("$CAROM run balls.yaml -q -o runs/heavy --set balls.red.restitution=0.5 --set balls.red.mass=20 "
                       "--set balls.blue.mass=20")
                .code,
            0);
  const Finished heavy = here.carom({"diff", "runs/a", "runs/heavy"});
  EXPECT_NE(heavy.out.find("differs: impulse_N_s"), string::npos) << heavy.out;
  EXPECT_EQ(heavy.out.find("they leave at"), string::npos) << heavy.out;

  const Json part = Json::parse(here.carom({"diff", "runs/b", "runs/aside", "--json"}).out);
  EXPECT_EQ(part["equal"], false);
  EXPECT_EQ(part["collisions"]["part"]["number"], 1);
  EXPECT_EQ(part["collisions"]["part"]["a"]["time_s"], 0.44499999999999995);
  EXPECT_NEAR(part["collisions"]["part"]["b"]["time_s"].get<double>(), (2.5 - 0.22) / 4, 1e-15);
  EXPECT_EQ(part["values"].size(), 2u);

  const Finished same = here.carom({"diff", "runs/a", "runs/a"});
  EXPECT_EQ(same.code, 0);
  EXPECT_NE(same.out.find("\n  equal       scenes, collisions and final positions\n"), string::npos);
}

TEST(DiffCommand, CountsCollisionsAsTheReportOfARunDoes) {
  const Workplace here;
  for (const string run : {"run", "same"})
    ASSERT_EQ(
        here.carom({"run", SCENES_DIR "/bouncing_ball.yaml", "-q", "-o", run, "--only", "collisions,trajectory"}).code,
        0);
  ASSERT_EQ(here.carom({"run", SCENES_DIR "/bouncing_ball.yaml", "-q", "-o", "heavy", "--only", "collisions,trajectory",
                        "--set", "defaults.ball.mass=2"})
                .code,
            0);
  // Columns: run,title,engine,status,duration_s,bodies,collisions.
  string row = here.read("run/summary.csv");
  row.erase(0, row.find('\n') + 1);
  for (int k = 0; k < 6; ++k) row.erase(0, row.find(',') + 1);
  const string count = row.substr(0, row.find(','));
  ASSERT_NE(here.read("run/collisions.csv").find(",rest,"), string::npos);
  const Json same = Json::parse(here.carom({"diff", "run", "same", "--json"}).out);
  EXPECT_EQ(to_string(same["collisions"]["a"].get<int>()), count);
  EXPECT_EQ(to_string(same["collisions"]["same"].get<int>()), count);
  EXPECT_EQ(same["equal"], true);
}

TEST(DiffCommand, ReportsWhatIsMissing) {
  const Workplace here;
  make_runs(here, "output: {energy: {every: 0.1}}\n");
  const Finished run = here.carom({"diff", "runs/a", "runs/b"});
  EXPECT_EQ(run.code, 2);
  EXPECT_EQ(run.err,
            "carom: runs/a has no collisions.csv: run its scene again with the output `collisions` (--only "
            "collisions,trajectory)\n");
  EXPECT_EQ(here.carom({"diff", "runs/a"}).code, 2);
  EXPECT_EQ(here.carom({"diff", "runs/a", "runs/b", "runs/c"}).code, 2);
  EXPECT_EQ(here.carom({"diff", "runs/a", "nowhere"}).code, 2);

  ASSERT_EQ(here.carom({"run", "balls.yaml", "-q", "-o", "x", "--only", "collisions"}).code, 0);
  ASSERT_EQ(here.carom({"run", "balls.yaml", "-q", "-o", "y", "--only", "collisions,trajectory"}).code, 0);
  const Finished no_end = here.carom({"diff", "x", "y"});
  EXPECT_EQ(no_end.code, 0);
  EXPECT_NE(no_end.out.find("  end         not known: x has no trajectory.csv;"), string::npos) << no_end.out;
}

}  // namespace
}  // namespace carom::testing
